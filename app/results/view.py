"""The view "Results": which mistakes a class makes, by step and over time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import moderngl
from imgui_bundle import ImVec2, imgui

from app.host.view import DockedView, Host
from app.lecture.model import Lecture
from app.lecture.slide import Slides
from app.lecture.view import LectureView
from app.results.model import ClassResults
from app.results.page import page
from app.results.panel import panel
from app.widgets import theme
from app.widgets.messages import wrapped
from app.widgets.rows import follow
from renderer.atomic import atomic_write

RESULTS = "Results"
INVITATION = (
    "Which mistakes a class makes, by step and over time. Keep the answers of a sitting:\n\n"
    "    lucida lecture --answers answers.jsonl\n\n"
    "and draw them here, with results of lucida check --json, if there are any:\n\n"
    "    lucida lecture --results answers.jsonl results.json"
)


class ResultsView(DockedView):
    """The view "Results". results: those that are shown; None for none."""

    name = RESULTS
    title = "Results"
    padding = ImVec2(18, 14)

    def __init__(self, lecture: LectureView) -> None:
        self._lecture = lecture
        self._slides: Slides | None = None
        self._of: tuple[Lecture, Path] | None = None
        self._leave: Callable[[], None] | None = None
        self.results: ClassResults | None = None

    def give(
        self, results: ClassResults, lecture: Lecture, path: Path, leave: Callable[[], None]
    ) -> None:
        """Show results. lecture: the one that was answered, and its file. leave: called before a
        step of it is shown.
        """
        self.results, self._of, self._leave = results, (lecture, path), leave

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._slides = Slides(host.fonts)

    def draw(self, host: Host) -> None:
        assert self._slides is not None
        results = self.results
        if results is None or self._of is None:
            wrapped(INVITATION)
            return
        lecture, path = self._of
        if imgui.button("Save as a page..."):
            host.files.save_as_dialog(
                "Save the results", "results", ("web page", ".html"), lambda to: _save(results, to)
            )
        follow(imgui.calc_text_size(results.summary).x)
        imgui.align_text_to_frame_padding()
        wrapped(results.summary, theme.DIM)
        if asked := panel(results, True, self._slides, host.fonts):
            if self._leave is not None:
                self._leave()
            self._lecture.give(lecture, path, results.numbers[asked] - 1)
            host.animate()


def _save(results: ClassResults, path: str) -> str:
    with atomic_write(path) as file:
        file.write(page(results).encode())
    return f"saved {path}"
