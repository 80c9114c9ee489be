"""The positions of formulas in a lecture's file, for messages about a wrong one."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate
from typing import Any

from app.lecture import text as texts
from app.lecture.model import Written
from renderer.files.places import Places

_SOLID = re.compile(r"[^\s>]+")


def formulas_written(
    step: dict[str, Any], field: str, places: Places, source: str
) -> Iterator[Written]:
    """Yield all formulas of a step.

    step: its table, already checked.
    field: its path.
    source: the file's name.
    """
    for name, text in _texts_of(step):
        formulas = texts.formulas(texts.parse(text))
        first = places.line(f"{field}.{name}")
        for latex, line in zip(formulas, _lines(formulas, text), strict=True):
            yield Written(latex, f"{field}.{name}", source, first + line)


def pieces_written(step: dict[str, Any]) -> int:
    """Count the pieces of a step's texts. step: as for formulas_written."""
    return sum(texts.pieces(texts.parse(text)) for _, text in _texts_of(step))


def _lines(formulas: tuple[str, ...], text: str) -> Iterator[int]:
    """Yield the line of the text, from 0, in which each formula begins.

    Text and formulas are compared without white space and without `>`, because a formula may
    continue on the next line. Each search starts after the previous formula, in one pass.
    """
    pieces = list(_SOLID.finditer(text))
    solid = "".join(piece[0] for piece in pieces)
    ends = list(accumulate(len(piece[0]) for piece in pieces))  # of the pieces, in `solid`
    at = line = counted = 0
    for latex in formulas:
        bare = f"${''.join(_SOLID.findall(latex))}$"
        start = solid.find(bare, at)
        if start >= 0:
            here = pieces[bisect_right(ends, start + 1)].start()
            line += text.count("\n", counted, here)
            counted, at = here, start + len(bare)
        yield line


def _texts_of(step: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield the texts of a step, each after its field."""
    if "text" in step:
        yield "text", step["text"]
    for name in ("answer", "notes"):
        if step.get(name):
            yield name, step[name]
    for number, build in enumerate(step.get("builds", ())):
        for name in ("text", "instead"):
            if build.get(name):
                yield f"builds[{number}].{name}", build[name]
    exercise = step.get("exercise")
    if exercise is None:
        return
    yield "exercise.question", exercise["question"]
    for number, option in enumerate(exercise.get("options", ())):
        yield f"exercise.options[{number}].text", option["text"]
        yield f"exercise.options[{number}].feedback", option["feedback"]
    for number, answer in enumerate(exercise.get("answers", ())):
        for place, wrong in enumerate(answer.get("wrong", ())):
            field = f"exercise.answers[{number}].wrong[{place}].feedback"
            yield field, wrong["feedback"]
