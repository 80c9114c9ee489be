"""Compose a lecture's HTML page: texts, formulas, pictures, live figures, exercises."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from app.lecture.model import Lecture, Step
from app.lecture.step_options import state_of
from app.lecture_page import exercises, mistakes
from app.lecture_page.described import SIZE, alternative, title_of
from app.lecture_page.figures import Figures, is_live
from app.lecture_page.pictures import data_uri
from app.lecture_page.shell import BAR, DIALOGS, overview
from app.lecture_page.text import Links, blocks_html, plain
from app.mistakes.options import MistakesOptions
from app.page.document import document
from app.page.formulas import templates
from app.state.all_options import AllOptions
from app.state.app_state import AppState
from renderer.pixels import Indexing


@dataclass(frozen=True, eq=False)
class Still:
    """A picture of a view in a step. link: the link of the text that shows it, or "".

    pixels: uint8 (height, width, 3).
    """

    view: str
    link: str
    pixels: NDArray[np.uint8]


def page(
    lecture: Lecture,
    stills: Sequence[Sequence[Still]],
    answers: bool = True,
    for_print: bool = False,
) -> str:
    """Return the page.

    stills: of each step. answers: with answers and solutions. for_print: without live figures.
    """
    steps: list[str] = []
    tasks: dict[str, Any] = {}
    shown: dict[str, Any] = {}
    figures = None if for_print else Figures()
    for number, (step, pictures) in enumerate(zip(lecture.steps, stills, strict=True), start=1):
        written = _Step(number, step, lecture.explaining(step), answers, figures)
        steps.append(written.html(pictures))
        if written.task is not None:
            tasks[str(number)] = written.task
        if written.figure is not None:
            shown[str(number)] = written.figure
    options = lecture.steps[0].options
    indexing = Indexing(int(options.get("one_based", AllOptions().one_based)))
    title = plain(lecture.title)
    author = f' <span class="author">{plain(lecture.author)}</span>' if lecture.author else ""
    body = (
        f'<header class="bar"><h1>{title}{author}</h1>\n{BAR}</header>\n'
        f"<main>\n{''.join(steps)}</main>\n{overview(lecture)}{DIALOGS}"
        f"{templates(indexing)}"
    )
    data = {
        "title": lecture.title,
        "exercises": tasks,
        "figures": shown,
        "scenes": figures.scenes if figures else [],
        "shaders": figures.shaders if figures else [],
    }
    style = files("app.page").joinpath("lecture.css").read_text(encoding="utf-8")
    return document(lecture.title, "slides.js", body, {"lucida-data": data}, style)


class _Step:
    """Writes a step. task, figure: the data of its exercise and of its live figure, or None.
    answers: with answers. figures: None for a print.
    """

    def __init__(
        self, number: int, step: Step, explained_by: str, answers: bool, figures: Figures | None
    ) -> None:
        self._number, self._step, self._answers = number, step, answers
        self._state = state_of(step, AppState.for_scene(step.scene, step.view))
        self._notation = self._state.options.notation
        size = self._state.images.resolution or SIZE
        self.task = exercises.data_of(step, explained_by, size)
        self.figure = figures.of(step, self._state) if figures else None
        self._form: Literal["webp", "jpeg"] = "webp" if figures else "jpeg"

    def html(self, stills: Sequence[Still]) -> str:
        """Return the step. stills: its pictures."""
        number, step = self._number, self._step
        links = Links(number, (still.link for still in stills if still.link))
        text = blocks_html(step.blocks, self._notation, links, self._answers)
        asked = live = figure = ""
        if step.exercise is not None:
            asked = exercises.form(number, step.exercise, self.task, self._notation, self._answers)
        elif "mistakes" in step.views and self._form == "webp":
            asked, live = self._mistakes()
        if self.figure is not None:
            figure = f'<div class="live-figure" data-step="{number}" hidden></div>\n'
            if self.figure["folded"]:
                figure = f'<details class="try"><summary>Try it</summary>{figure}</details>\n'
        if step.notes and self._answers:
            notes = blocks_html(step.notes, self._notation)
            asked += f'<div class="notes" hidden>{notes}</div>\n'
        part = f'<p class="part">{plain(step.part)}</p>\n' if step.part else ""
        pictures = "".join(map(self._still, stills))
        is_folded = self.figure is not None and self.figure["folded"]
        views = pictures + figure if is_folded else figure + pictures
        return (
            f'<section class="step" id="{number}" aria-labelledby="title-{number}">\n'
            f'<div class="words">\n{part}<h2 id="title-{number}" tabindex="-1">'
            f'{plain(step.title)}</h2>\n<div class="text">{text}</div>\n{asked}</div>\n'
            f'<div class="views">\n{live}{views}</div>\n</section>\n'
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
        return "", exercises.form_of(self._number, html, self.task, self._notation)

    def _still(self, still: Still) -> str:
        step, state, of_link, name = self._step, self._state, "", "view"
        if still.link:
            state = state.with_options(**step.links[still.link])
            of_link = f' data-of-link="{self._number}-{plain(still.link)}" hidden'
        elif still.view == "mistakes":
            name += " printed"  # on the screen it is live
        elif (
            self.figure and not self.figure["folded"] and is_live(still.view, self.figure["shows"])
        ):
            name += " still"  # for prints, and where there is no WebGL
        name += f" of-{still.view}"
        height, width = still.pixels.shape[:2]
        return (
            f'<figure class="{name}"{of_link}><img src="{data_uri(still.pixels, self._form)}" '
            f'width="{width}" height="{height}" '
            f'alt="{plain(alternative(still.view, step, state))}">'
            f"<figcaption>{plain(title_of(still.view))}</figcaption></figure>\n"
        )
