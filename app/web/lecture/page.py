"""Compose a lecture's HTML page: texts, formulas, pictures, live figures, exercises."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

from lucida.app.instruments.laboratory.page import Page
from lucida.app.lecture.model import Lecture, Step
from lucida.app.lecture.step_options import state_of
from lucida.app.lecture.text import Question
from lucida.app.state.app_state import AppState
from lucida.app.web.document import document
from lucida.app.web.formulas import templates
from lucida.renderer.files.views import view_table
from lucida.renderer.images.display import Bytes

from . import exercises
from .described import SIZE, alternative, title_of
from .figures import Figures, is_live
from .pictures import Form, data_uri, drawing
from .shell import BAR, DIALOGS, overview
from .text import blocks_html, plain


@dataclass(frozen=True, eq=False)
class Still:
    """A picture of a view in a build.

    pixels: (height, width, 3), in the light theme. drawn: the input of the laboratory's drawing, in
    the light and the dark theme; None for other views. dark: as pixels, in the dark theme, for
    views in the theme's colours.
    """

    view: str
    pixels: Bytes
    drawn: tuple[Page, Page] | None = None
    dark: Bytes | None = None


def page(
    lecture: Lecture,
    stills: Sequence[Sequence[Still]],
    answers: bool = True,
    for_print: bool = False,
) -> str:
    """Return the page.

    stills: the pictures of each build. answers: include answers and solutions. for_print: leave out
    live figures, and builds that only lead to the next one.
    """
    steps: list[str] = []
    tasks: dict[str, Any] = {}
    shown: dict[str, Any] = {}
    figures = None if for_print else Figures()
    builds = [one for one in lecture.builds if answers or not is_answer(one, lecture)]
    last = {one.number: one for one in builds}
    for place, step in enumerate(builds):
        after = builds[place + 1] if step is not last[step.number] else None
        printed = is_printed(step, after)
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
    indexing = lecture.steps[0].options.indexing
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
    style = files("lucida.app.web").joinpath("lecture.css").read_text(encoding="utf-8")
    return document(lecture.title, "slides.js", body, {"lucida-data": data}, style)


def is_printed(step: Step, after: Step | None) -> bool:
    """Return True unless a build only leads to the next one.

    after: the next build of the step, None for its last one.
    """
    if after is None or (step.blocks and not after.before):  # the next one replaces the text
        return True
    one, other = _settings(step), _settings(after)
    return sum(one.get(name) != other.get(name) for name in one | other) > 1


def _settings(step: Step) -> dict[str, Any]:
    """Return the settings that a build's pictures depend on, by name."""
    tables = {"view": view_table(step.view)} | step.changes
    return {"scene": id(step.scene), "views": step.views, "pixel": step.pixel} | {
        f"{name}.{key}": value
        for name, table in tables.items()
        for key, value in (table if isinstance(table, dict) else {"": table}).items()
    }


def is_answer(step: Step, lecture: Lecture) -> bool:
    """Return True for a build that comes after a question to the class in its step."""
    before = lecture.builds[lecture.place(step.number) : lecture.place(step.number, step.build)]
    return any(isinstance(block, Question) for one in before for block in one.blocks)


class _Step:
    """A step at a build, as HTML. name: its address. kind: additional CSS classes.

    task, figure: the data of its exercise and of its live figure, or None.
    answers: include answers. figures: None for a print.
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
        size = self._state.images.resolution or SIZE
        self.task = exercises.data_of(step, explained_by, size)
        self.figure = figures.of(step, self._state) if figures else None
        self._form: Form = "webp" if figures else "jpeg"

    def html(self, stills: Sequence[Still]) -> str:
        """Return the step. stills: its pictures."""
        number, step = self._name, self._step
        text = blocks_html(step.blocks)
        asked = figure = ""
        if step.exercise is not None and self.task is not None:
            asked = exercises.form(number, step.exercise, self.task, self._answers)
        if self.figure is not None:
            figure = f'<div class="live-figure" data-step="{number}" hidden></div>\n'
            if not self.figure["open"]:
                figure = f'<details class="try"><summary>Try it</summary>{figure}</details>\n'
        if step.notes and self._answers:
            notes = blocks_html(step.notes)
            asked += f'<div class="notes" hidden>{notes}</div>\n'
        part = f'<p class="part">{plain(step.part)}</p>\n' if step.part else ""
        pictures = "".join(map(self._still, stills))
        is_open = self.figure is not None and self.figure["open"]
        views = figure + pictures if is_open else pictures + figure
        return (
            f'<section class="step{self._kind}" id="{number}" data-number="{step.number + 1}" '
            f'aria-labelledby="title-{number}">\n'
            f'<div class="words">\n{part}<h2 id="title-{number}" tabindex="-1">'
            f'{plain(step.title)}</h2>\n<div class="text">{text}</div>\n{asked}</div>\n'
            f'<div class="views">\n{views}</div>\n</section>\n'
        )

    def _still(self, still: Still) -> str:
        """Return a picture, or a drawing."""
        name = f"view of-{still.view}"
        if self.figure and self.figure["open"] and is_live(still.view, self.figure["shows"]):
            name += " still"  # for print, and for browsers without WebGL
        seen = plain(alternative(still.view, self._step, self._state))
        height, width = still.pixels.shape[:2]
        size = f'width="{width}" height="{height}" alt="{seen}"'
        picture = f'<img src="{data_uri(still.pixels, self._form)}" {size}>'
        if still.dark is not None and self._form == "webp":
            picture += f'<img class="dark" src="{data_uri(still.dark)}" {size}>'
        if still.drawn is not None:
            width, height = still.drawn[0].size
            picture = (
                f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{seen}">'
                f"{drawing(still.drawn, self._form)}</svg>"
            )
        caption = f"<figcaption>{plain(title_of(still.view))}</figcaption>"
        return f'<figure class="{name}">{picture}{caption}</figure>\n'
