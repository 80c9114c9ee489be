"""Compose a lecture's HTML page: texts, formulas, pictures, exercises, and the script.

Everything is in the one file. Its Content-Security-Policy lets only its own script and style run,
and nothing be loaded.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.lecture.model import Lecture, Step
from app.lecture.step_options import state_of
from app.lecture_page import exercises, mistakes
from app.lecture_page.described import alternative, title_of
from app.lecture_page.pictures import data_uri
from app.lecture_page.shell import BAR, DIALOGS, overview
from app.lecture_page.text import Links, blocks_html, plain
from app.mistakes.options import MistakesOptions
from app.page.bundle import bundle
from app.state.app_state import AppState


@dataclass(frozen=True, eq=False)
class Still:
    """A picture of a view in a step. link: the link of the text that shows it, or "".

    pixels: uint8 (height, width, 3).
    """

    view: str
    link: str
    pixels: NDArray[np.uint8]


def page(lecture: Lecture, stills: Sequence[Sequence[Still]], answers: bool = True) -> str:
    """Return the page. stills: of each step. answers: with answers and solutions."""
    steps: list[str] = []
    tasks: dict[str, Any] = {}
    for number, (step, pictures) in enumerate(zip(lecture.steps, stills, strict=True), start=1):
        written = _Step(number, step, lecture.explaining(step), answers)
        steps.append(written.html(pictures))
        if written.task is not None:
            tasks[str(number)] = written.task
    script = bundle("slides.js")
    style = files("app.page").joinpath("modules", "lecture.css").read_text(encoding="utf-8")
    title = plain(lecture.title)
    author = f' <span class="author">{plain(lecture.author)}</span>' if lecture.author else ""
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{_policy(script, style)}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{style}</style>\n</head>\n<body>\n"
        f'<header class="bar"><h1>{title}{author}</h1>\n{BAR}</header>\n'
        f"<main>\n{''.join(steps)}</main>\n{overview(lecture)}{DIALOGS}"
        f'<script type="application/json" id="data">'
        f"{_json({'title': lecture.title, 'exercises': tasks})}</script>\n"
        f'<script type="module">{script}</script>\n</body>\n</html>\n'
    )


def _policy(script: str, style: str) -> str:
    def digest(text: str) -> str:
        return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()

    return (
        f"default-src 'none'; script-src 'sha256-{digest(script)}'; "
        f"style-src 'sha256-{digest(style)}'; img-src data: blob:; worker-src blob:; "
        "base-uri 'none'; form-action 'none'"
    )


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")


class _Step:
    """Writes a step. task: the data of its exercise, or None. answers: with answers."""

    def __init__(self, number: int, step: Step, explained_by: str, answers: bool) -> None:
        self._number, self._step, self._answers = number, step, answers
        self._state = state_of(step, AppState.for_scene(step.scene, step.view))
        self._notation = self._state.options.notation
        self.task = exercises.data_of(step, explained_by)

    def html(self, stills: Sequence[Still]) -> str:
        """Return the step. stills: its pictures."""
        number, step = self._number, self._step
        links = Links(number, (still.link for still in stills if still.link))
        text = blocks_html(step.blocks, self._notation, links, self._answers)
        asked, live = "", ""
        if step.exercise is not None:
            asked = exercises.form(number, step.exercise, self.task, self._notation, self._answers)
        elif "mistakes" in step.views:
            asked, live = self._mistakes()
        part = f'<p class="part">{plain(step.part)}</p>\n' if step.part else ""
        pictures = "".join(self._figure(still, live != "") for still in stills)
        return (
            f'<section class="step" id="{number}" aria-labelledby="title-{number}">\n'
            f'<div class="words">\n{part}<h2 id="title-{number}" tabindex="-1">'
            f'{plain(step.title)}</h2>\n<div class="text">{text}</div>\n{asked}</div>\n'
            f'<div class="views">\n{live}{pictures}</div>\n</section>\n'
        )

    def _mistakes(self) -> tuple[str, str]:
        """Return the quiz below the text, or the laboratory among the views."""
        if self._state.of(MistakesOptions).mode == "laboratory":
            return "", mistakes.laboratory(self._number, self._state)
        found = mistakes.quiz(self._step, self._state)
        if found is None:
            return "", ""
        html, data = found
        self.task = exercises.with_replies(data)
        return exercises.form_of(self._number, html, self.task, self._notation), ""

    def _figure(self, still: Still, has_live: bool) -> str:
        step, state, of_link, name = self._step, self._state, "", "view"
        if still.link:
            state = state.with_options(**step.links[still.link])
            of_link = f' data-of-link="{self._number}-{plain(still.link)}" hidden'
        if still.view == "mistakes" and has_live:
            name = "view printed"  # for prints: on the screen it is live
        height, width = still.pixels.shape[:2]
        return (
            f'<figure class="{name}"{of_link}><img src="{data_uri(still.pixels)}" '
            f'width="{width}" height="{height}" '
            f'alt="{plain(alternative(still.view, step, state))}">'
            f"<figcaption>{plain(title_of(still.view))}</figcaption></figure>\n"
        )
