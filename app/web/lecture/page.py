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
from app.lecture.text import Question
from app.state.app_state import AppState
from app.state.options import Options
from app.web.document import document
from app.web.formulas import templates
from app.web.lecture import exercises, mistakes
from app.web.lecture.described import SIZE, alternative, title_of
from app.web.lecture.figures import Figures, is_live
from app.web.lecture.pictures import data_uri
from app.web.lecture.shell import BAR, DIALOGS, overview
from app.web.lecture.text import blocks_html, plain
from renderer.images.pixels import Indexing


@dataclass(frozen=True, eq=False)
class Still:
    """A picture of a view in a build. pixels: uint8 (height, width, 3)."""

    view: str
    pixels: NDArray[np.uint8]


def page(
    lecture: Lecture,
    stills: Sequence[Sequence[Still]],
    answers: bool = True,
    for_print: bool = False,
) -> str:
    """Return the page.

    stills: of each build. answers: with answers and solutions. for_print: without live figures, and
    only with builds that show more than another text before them.
    """
    steps: list[str] = []
    tasks: dict[str, Any] = {}
    shown: dict[str, Any] = {}
    figures = None if for_print else Figures()
    builds = [one for one in lecture.builds if answers or not is_answer(one)]
    last = {one.number: one for one in builds}
    for place, step in enumerate(builds):
        after = builds[place + 1] if step is not last[step.number] else None
        printed = after is None or not shows_as(step, after)
        if for_print and not printed:
            continue
        name = f"{step.number + 1}.{step.build + 1}" if step.build else str(step.number + 1)
        explained = lecture.explaining(step)
        written = _Step(name, step, explained, answers, figures, "" if printed else " passing")
        steps.append(written.html(stills[lecture.place(step.number, step.build)]))
        if written.task is not None:
            tasks[name] = written.task
        if written.figure is not None:
            shown[name] = written.figure
    options = lecture.steps[0].options
    indexing = Indexing(int(options.get("one_based", Options().one_based)))
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
    style = files("app.web").joinpath("lecture.css").read_text(encoding="utf-8")
    return document(lecture.title, "slides.js", body, {"lucida-data": data}, style)


def shows_as(step: Step, after: Step) -> bool:
    """Return True if two builds of a step differ in their texts only."""
    names = ("scene", "view", "views", "options", "pixel")
    return all(getattr(step, name) == getattr(after, name) for name in names)


def is_answer(step: Step) -> bool:
    """Return True for a build that comes after a question to the class in its step."""
    return any(isinstance(block, Question) for block in step.before)


class _Step:
    """Writes a step at a build. name: its address. kind: more classes of it.

    task, figure: the data of its exercise and of its live figure, or None.
    answers: with answers. figures: None for a print.
    """

    def __init__(
        self,
        name: str,
        step: Step,
        explained_by: str,
        answers: bool,
        figures: Figures | None,
        kind: str,
    ) -> None:
        self._name, self._step, self._answers, self._kind = name, step, answers, kind
        self._state = state_of(step, AppState.for_scene(step.scene, step.view))
        self._notation = self._state.options.notation
        size = self._state.images.resolution or SIZE
        self.task = exercises.data_of(step, explained_by, size)
        self.figure = figures.of(step, self._state) if figures else None
        self._form: Literal["webp", "jpeg"] = "webp" if figures else "jpeg"

    def html(self, stills: Sequence[Still]) -> str:
        """Return the step. stills: its pictures."""
        number, step = self._name, self._step
        text = blocks_html(step.blocks, self._notation)
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
            f'<section class="step{self._kind}" id="{number}" data-number="{step.number + 1}" '
            f'aria-labelledby="title-{number}">\n'
            f'<div class="words">\n{part}<h2 id="title-{number}" tabindex="-1">'
            f'{plain(step.title)}</h2>\n<div class="text">{text}</div>\n{asked}</div>\n'
            f'<div class="views">\n{live}{views}</div>\n</section>\n'
        )

    def _mistakes(self) -> tuple[str, str]:
        """Return the quiz below the text, or the laboratory among the views."""
        if self._state.options.mistakes.mode == "laboratory":
            return "", mistakes.laboratory(self._name, self._state)
        found = mistakes.quiz(self._step, self._state)
        if found is None:
            return "", ""
        html, data = found
        self.task = exercises.with_replies(data)
        return "", exercises.form_of(self._name, html, self.task, self._notation)

    def _still(self, still: Still) -> str:
        step, state, name = self._step, self._state, "view"
        if still.view == "mistakes":
            name += " printed"  # on the screen it is live
        elif (
            self.figure and not self.figure["folded"] and is_live(still.view, self.figure["shows"])
        ):
            name += " still"  # for prints, and where there is no WebGL
        name += f" of-{still.view}"
        height, width = still.pixels.shape[:2]
        return (
            f'<figure class="{name}"><img src="{data_uri(still.pixels, self._form)}" '
            f'width="{width}" height="{height}" '
            f'alt="{plain(alternative(still.view, step, state))}">'
            f"<figcaption>{plain(title_of(still.view))}</figcaption></figure>\n"
        )
