"""A step's exercise as a form, and the data to judge its answers.

The replies are in templates, so that a page's script never turns text into HTML.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.lecture.exercises import (
    CORRECT,
    ChoiceExercise,
    RayExercise,
    TypedExercise,
    VectorExercise,
    hint,
)
from lucida.app.lecture.hidden_pixels import ids_seen
from lucida.app.lecture.hiding import HideExercise
from lucida.app.lecture.inheriting import changed_view
from lucida.app.lecture.model import Exercise, Step
from lucida.app.lecture.text import Math, Paragraph, escaped, parse
from lucida.app.state.kept_lecture import Judgement
from lucida.app.ui.explaining import symbols
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.views import view_table

from .drawn import paper
from .mathml import VECTORS
from .text import plain, written

BOLD = frozenset("uvwepdx")


def data_of(step: Step, explained_by: str, size: Size) -> dict[str, Any] | None:
    """Return modules/exercise.js's data to judge answers; None for a step without an exercise.

    explained_by: the earlier step that explains the exercise. size: of the step's images.
    """
    match step.exercise:
        case RayExercise() as task:
            data = _ray(task)
        case VectorExercise() as task:
            data = _vectors(task) | {"paper": paper(step.view.camera)}
        case ChoiceExercise() as task:
            data = _choice(task, step)
        case HideExercise() as task:
            data = _hiding(task, size)
        case _:
            return None
    data |= {"step": step.title, "read": explained_by}
    return data | {"replies": {text: n for n, text in enumerate(dict.fromkeys(_texts(data)))}}


def _choice(task: ChoiceExercise, step: Step) -> dict[str, Any]:
    """Return the options, each with the step's camera as it changes it."""
    options = [_option(task.check(place)) for place in range(len(task.options))]
    for data, option in zip(options, task.options, strict=True):
        if option.camera is not None:
            data["camera"] = view_table(changed_view(step.view, option.camera))
    return {"options": options}


def _hiding(task: HideExercise, size: Size) -> dict[str, Any]:
    ids = ids_seen(task.without, task.view.for_size(size), size)
    return {
        "hiding": {
            "moved": task.ids(task.moved),
            "hidden": task.ids(task.hidden),
            "name": escaped(task.hidden),
            "behind": task.middle(task.hidden).tolist(),
            "alone": task.pixels(task.without, ids),
            "atMost": task.at_most,
            "size": size,
            "camera": view_table(task.view),
        },
        "texts": task.told,
    }


def _option(verdict: Judgement) -> dict[str, Any]:
    names = ("right", "text", "mistake", "read")
    return {name: getattr(verdict, name) for name in names}


def _texts(data: Any) -> Iterator[str]:
    """Yield all replies in an exercise's data."""
    if isinstance(data, dict):
        if "text" in data:
            yield data["text"]
        yield from data.get("texts", {}).values()
        data = list(data.values())
    if isinstance(data, list):
        for one in data:
            yield from _texts(one)


def _ray(task: RayExercise) -> dict[str, Any]:
    ray = task.camera.ray(*task.pixel, task.size)
    wrong = [
        {
            "origin": numbers(one.origin),
            "direction": numbers(one.direction),
            "mistake": mistake.name,
            "text": hint(mistake),
            "read": mistake.part,
        }
        for mistake, one in task.wrong_rays()
    ]
    return {
        "ray": {"origin": numbers(ray.origin), "direction": numbers(ray.direction)},
        "fields": list(task.fields),
        "scaled": task.scaled,
        "tolerance": task.tolerance,
        "wrong": wrong,
        "texts": {"right": CORRECT} | task.replies,
        "paper": paper(task.camera),
    }


def _vectors(task: VectorExercise) -> dict[str, Any]:
    answers = [
        {
            "name": wanted.name,
            "value": numbers(wanted.value),
            "scaled": wanted.scaled,
            "draw": wanted.drawn,
            "wrong": [{"value": numbers(one.value), "text": one.feedback} for one in wanted.wrong],
            "texts": wanted.replies,
        }
        for wanted in task.answers
    ]
    return {
        "answers": answers,
        "fields": list(task.fields),
        "tolerance": task.tolerance,
        "texts": {"right": CORRECT},
    }


def numbers(values: ArrayLike) -> list[float | None]:
    """Return numbers for JSON, with None for those that are not finite."""
    return [one if math.isfinite(one) else None for one in np.ravel(values).astype(float).tolist()]


def form(number: str, task: Exercise, data: dict[str, Any], answers: bool) -> str:
    """Return an exercise of a step as HTML.

    data: as data_of() returns it. answers: with its solution.
    """
    asked = f'<div class="asked">{written(task.question)}</div>\n'
    if isinstance(task, ChoiceExercise):
        options = (
            f'<li><button type="button" data-option="{place}" aria-pressed="false"'
            f"{_name(option.text)}>"
            f"{_inside(written(option.text))}</button></li>\n"
            for place, option in enumerate(task.options)
        )
        asked += f'<ol class="options">{"".join(options)}</ol>\n'
    elif not isinstance(task, HideExercise):
        asked += _fields(number, task)
    solution = ""
    if answers:
        solution = (
            '<details class="solution"><summary>Show the solution</summary>'
            f"{written(task.solution())}</details>\n"
        )
    replies = "".join(
        f'<template data-reply="{place}">{written(text)}</template>\n'
        for text, place in data["replies"].items()
    )
    return (
        f'<form class="exercise" data-step="{number}" novalidate>\n'
        f'{asked}<div class="reply" role="status"></div>\n<div class="drawing"></div>\n'
        f"{replies}{solution}</form>\n"
    )


def _fields(number: str, task: TypedExercise) -> str:
    rows = []
    for place, name in enumerate(task.fields):
        shown = symbols.answer(name)
        word, _, letter = shown.rpartition(" ")
        if letter in BOLD and word in ("", "origin", "direction"):
            color = f' class="vector-{letter}"' if letter in VECTORS else ""
            label = f"{plain(word)} <strong{color}>{plain(letter)}</strong>"
        else:
            label = plain(shown)
        field = f"field-{number}-{place}"
        rows.append(
            f'<label for="{field}">{label}</label><input id="{field}" name="{plain(name)}" '
            'type="text" maxlength="200" placeholder="( , , )" autocomplete="off" '
            'autocapitalize="off" spellcheck="false">\n'
        )
    return f'<div class="fields">{"".join(rows)}<button>Check</button></div>\n'


def _name(text: str) -> str:
    """Return an attribute that names a button of formulas, which browsers cannot name
    themselves.
    """
    blocks = parse(text)
    if not all(isinstance(block, Paragraph) for block in blocks):
        return ""
    spans = [span for block in blocks if isinstance(block, Paragraph) for span in block.line]
    if not all(isinstance(span, Math) for span in spans):
        return ""
    return (
        f' aria-label="{plain(" ".join(span.latex for span in spans if isinstance(span, Math)))}"'
    )


def _inside(html: str) -> str:
    """Return a paragraph's content, because a button holds no paragraphs."""
    return html.replace("<p>", "<span>").replace("</p>", "</span>")
