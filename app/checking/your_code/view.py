"""The view "Your code": a student's file, run for the window's camera while it is being edited.

The view decides which files may run, their questions, and the drawing in the outside view. See
model.py for the questions, panel.py for the layout, code_pictures.py for the pictures.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path

import moderngl
import numpy as np
from imgui_bundle import imgui

from lucida.app.checking.own_words import starter
from lucida.app.checking.task_file import BUILTIN
from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Item
from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.second_camera import GivenRay, corner_rays, second_camera
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.lecture.view import LectureView
from lucida.app.state.options.shared import Pixel
from lucida.app.state.paths import restored, stored
from lucida.app.ui import layout, theme
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.messages import wrapped
from lucida.app.ui.watching import MOST, FilesWatch
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import one_line
from lucida.renderer.system.file_dependencies import stamp
from lucida.renderer.system.memo import Memo

from . import panel
from .code_pictures import PicturesShown, marked_pixel
from .model import RAY, CodeQuestion, CodeRays, CodeReport
from .panel import CodeWish
from .runs import CodeRuns
from .words import ToldLine, told_of

YOUR_CODE = "Your-code"
STARTER = "rays.py"


class YourCode(Instrument):
    """The view "Your code"."""

    name = YOUR_CODE
    title = "Your code"

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self.runs = CodeRuns()
        self.pictures: PicturesShown | None = None
        self._watch = FilesWatch({})
        self._watched = ""  # the file; the Python files next to it are watched, too
        self._version = 0  # of these files
        self._agreed: set[str] = set()  # files that the user has opened in this window
        self._written: list[str] = []  # starter files that have been written
        self._items = Memo(_outside_items)
        self.seen = False
        self._opened_for: tuple[str, str] | None = None  # the outside view, for a wrong answer
        self.told: list[ToldLine] = []
        self._words = Memo(told_of)

    def open(self, host: Host, path: str) -> None:
        """Open a file for the user. It is run now, and whenever it is saved."""
        self._agreed.add(path)
        self._version += 1
        options = replace(host.state.options.your_code, file=stored(path))
        if host.state.options.your_code.file != options.file:
            host.change(host.state.with_options(options))
        host.show_in(YOUR_CODE, layout.LOOPS)

    @property
    def settled(self) -> bool:
        if not self.seen or self.pictures is None:
            return True
        return not (self.runs.busy or self.pictures.busy)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self.pictures = PicturesShown(host, context)

    def end(self) -> None:
        self.runs.close()
        if self.pictures is not None:
            self.pictures.close()

    def unseen(self, host: Host) -> None:
        self.runs.poll()
        if not self.seen:
            return
        assert self.pictures is not None
        self.seen = False
        if self.runs.busy:
            self.runs.forget()  # nothing runs while hidden
        self.pictures.forget()
        self._outside.show(YOUR_CODE, ())

    def draw(self, host: Host) -> None:
        assert self.pictures is not None
        self.pictures.begin_frame()
        self.seen = True
        host.renderers.need_size(host.state.images)
        path = restored(host.state.options.your_code.file)
        if self._written:
            self._open_written(host)
        if path and self._may_run(host, path):
            wish = self._of_file(host, path)
        else:
            self._rest()
            wish = self._untrusted(host, path) if path else panel.invitation(host.fonts)
        self._grant(host, wish, path)

    def _rest(self) -> None:
        """Run nothing, and show nothing of earlier runs."""
        assert self.pictures is not None
        self.pictures.forget()
        self.runs.poll()
        if self.runs.report is not None:
            self.runs.forget()
        self.told, self._watched = [], ""
        self._outside.show(YOUR_CODE, ())

    def _may_run(self, host: Host, path: str) -> bool:
        """Return True if the user has opened the file, in this window or, as the recent files show,
        earlier.
        """
        return path in self._agreed or Path(path) in host.files.recent.entries

    def _saved_version(self, host: Host, path: str) -> int:
        """Return the number of the file's version, which changes when the file or a Python file
        next to it is saved.
        """
        if self._watch.changed(time.monotonic()) or path != self._watched:
            self._watched, self._version = path, self._version + 1
            beside = islice(Path(path).parent.glob("*.py"), MOST)
            self._watch.follow({name: stamp(name) for name in (Path(path), *beside)})
        if self._watch.waiting:
            host.animate()
        return self._version

    def _of_file(self, host: Host, path: str) -> CodeWish:
        assert self.pictures is not None
        runs, options = self.runs, host.state.options.your_code
        version = self._saved_version(host, path)
        camera = host.state.view.for_size(options.canvas)
        runs.follow(CodeQuestion(path, version, camera, options.canvas))
        if runs.busy:
            host.animate()
        report = runs.report
        if report is not None and report.question.path != path:
            report = None
        wish, canvas = panel.head(Path(path), options, runs, host.fonts)
        if canvas != options.canvas:
            host.edit(replace(host.options.your_code, canvas=canvas))
        if report is None:
            imgui.text_colored(theme.DIM, "running ...")
            return wish
        self.pictures.follow(host, report)
        marked = marked_pixel(host, report)
        if self.pictures.expected:
            self.pictures.draw(host, report, panel.pictures_room(), marked)
        self.told = self._words(report, marked)
        title = panel.words(self.told, host.fonts)
        if title:
            host.view(LectureView).read_again(host, title)
        self._show_outside(host, report, marked)
        return wish

    def _show_outside(self, host: Host, report: CodeReport, marked: Pixel | None) -> None:
        """Show the student's camera in the outside view if it is wrong, and a pixel's rays."""
        rays = report.rays
        if rays is None or not rays.wrong.any():
            self._outside.show(YOUR_CODE, ())
            return
        end = end_parameter(rays.camera, host.focus.framed)
        first = f"pixel {host.state.options.indexing.text((0, 0))}"
        items = self._items(rays, marked, end, first)
        self._outside.show(YOUR_CODE, items)
        place = report.question.path, rays.task.name
        if place != self._opened_for:  # only once, because the user may close it
            self._opened_for = place
            host.show(self._outside.name)

    # User requests.

    def _untrusted(self, host: Host, path: str) -> CodeWish:
        """Draw a file that a lecture has named, which the user may read and run."""
        options = host.state.options.your_code
        wish, _ = panel.head(Path(path), options, None, host.fonts)
        wrapped(panel.TRUST.format(one_line(path)))
        if imgui.button("Run it"):
            self._agree(host, path)
        return wish

    def _agree(self, host: Host, path: str) -> None:
        self._agreed.add(path)
        host.files.recent.add(path)
        host.animate()

    def _grant(self, host: Host, wish: CodeWish, path: str) -> None:
        if wish == "open":
            host.files.open_dialog()
        elif wish == "starter":
            host.files.save_as_dialog(
                "Write a file to begin with",
                STARTER,
                ("Python files", ".py"),
                self.write_starter,
            )
        elif wish == "run" and path and self._may_run(host, path):
            self.runs.forget()
            host.animate()
        elif wish == "stop":
            self.runs.stop()

    def write_starter(self, path: str) -> str:
        """Write a starter file, on a thread. Raises LucidaError."""
        with atomic_write(Path(path)) as file:
            tasks = [task for task in BUILTIN if task.kind == RAY]
            file.write(starter(tasks).encode())
        self._written.append(path)
        return one_line(f"Wrote {path}.")

    def _open_written(self, host: Host) -> None:
        path = str(Path(self._written.pop()).absolute())
        self._agree(host, path)
        host.edit(replace(host.options.your_code, file=stored(path)))


def _outside_items(rays: CodeRays, marked: Pixel | None, end: float, first: str) -> list[Item]:
    """Return a wrong answer's drawing for the outside view: the student's camera, and the rays of
    the marked pixel, or else of the first wrong one.

    end: the ray parameter at which the scene ends. first: the name of the first pixel.
    """
    camera = rays.camera
    middle = (rays.size[1] - 1) / 2, (rays.size[0] - 1) / 2
    reach = end * float(np.linalg.norm(camera.ray(*middle, rays.size).direction))
    corners = corner_rays(rays.given[..., 0, :], rays.given[..., 1, :])
    items = second_camera(*corners, reach, "yours", first)
    pixel = marked if marked is not None else tuple(np.argwhere(rays.wrong)[0].tolist())
    if rays.came[pixel]:
        items += answers.ray(GivenRay(*rays.given[pixel]), GivenRay(*rays.right[pixel]), reach)
    return items
