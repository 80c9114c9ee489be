"""The view "Results": which mistakes a class makes, by step and over time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import moderngl
from imgui_bundle import ImVec2, imgui

from app.host.view import DockedView, Host
from app.lecture.model import Lecture
from app.lecture.reading import BUILTIN
from app.lecture.slide import Slides
from app.lecture.view import LectureView
from app.results.model import ClassAnswer, ClassResults, class_results
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
    "and drop the file here, with results of lucida check --json, if there are any; or\n\n"
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
        self,
        results: ClassResults,
        lecture: Lecture,
        path: Path,
        leave: Callable[[], None] | None = None,
    ) -> None:
        """Show results. lecture: the one that was answered, and its file. leave: called before a
        step of it is shown.
        """
        self.results, self._of, self._leave = results, (lecture, path), leave

    def take(
        self, host: Host, answers: Sequence[ClassAnswer], unread: Sequence[str], builtin: Lecture
    ) -> None:
        """Show answers to the open lecture; to the built-in one if none is open."""
        session = self._lecture.session
        of = (builtin, BUILTIN) if session is None else (session.lecture, session.path)
        titles = [step.title for step in of[0].steps]
        self.give(class_results(answers, titles, unread), *of)
        host.show(RESULTS)

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
            number = results.numbers[asked] - 1
            session = self._lecture.session
            if session is not None and session.lecture is lecture:  # the class goes on with it
                self._lecture.go(host, number)
            else:
                self._lecture.give(lecture, path, number)
            host.animate()


def _save(results: ClassResults, path: str) -> str:
    with atomic_write(path) as file:
        file.write(page(results).encode())
    return f"saved {path}"
