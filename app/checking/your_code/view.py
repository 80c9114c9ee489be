"""The view "Your code": a student's file, run for the window's camera while it is being edited.

It decides which files may run, what they are asked, and what the outside view shows. See model.py
for the questions, panel.py for the layout, code_pictures.py for the pictures.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import moderngl
from imgui_bundle import imgui

from lucida.app.checking.own_words import starter
from lucida.app.checking.your_code import panel
from lucida.app.checking.your_code.code_pictures import CodePictures, PicturesShown, marked_pixel
from lucida.app.checking.your_code.following import FileFollower, open_in_editor
from lucida.app.checking.your_code.model import RAY, CodeContent, CodeQuestion, CodeReport, asked_of
from lucida.app.checking.your_code.outside_items import outside_items
from lucida.app.checking.your_code.panel import CodeWish
from lucida.app.checking.your_code.runs import CodeRuns
from lucida.app.checking.your_code.words import ToldLine, told_of
from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.options.shared import Pixel
from lucida.app.state.paths import restored, stored
from lucida.app.ui import layout, theme
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.messages import wrapped
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import one_line
from lucida.renderer.system.memo import Memo

YOUR_CODE = "Your-code"
STARTER = "rays.py"


class YourCodeView(Instrument):
    """The view "Your code"."""

    name = YOUR_CODE
    title = "Your code"

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self.runs = CodeRuns(lambda: Background.wake_window())
        self._follower: FileFollower | None = None
        self._pictures: PicturesShown | None = None
        self._agreed: set[str] = set()  # files that the user has opened in this window
        self._written: list[str] = []  # files to begin with that have been written
        self._items = Memo(outside_items)
        self._seen = False
        self._opened_for: tuple[str, str] | None = None  # the outside view, for a wrong answer
        self._asked: CodeWish = ""
        self.told: list[ToldLine] = []
        self._words = Memo(told_of)

    @property
    def report(self) -> CodeReport | None:
        """The report on the open file; None before the first."""
        return self.runs.report

    @property
    def pictures(self) -> CodePictures | None:
        """The pictures on screen; None for none."""
        return self._pictures.pictures if self._pictures is not None else None

    def open(self, window: Host, path: str) -> None:
        """Open a file for the user. It is run now, and whenever it is saved."""
        self._agreed.add(path)
        options = replace(window.state.options.your_code, file=stored(path), task="")
        if window.state.options.your_code.file != options.file:
            window.change(window.state.with_options(options))
        elif self._follower is not None:
            self._follower.again()
        window.show_in(YOUR_CODE, layout.LOOPS)

    def open_tasks(self, window: Host, path: str) -> None:
        """Open a course's file of tasks for the user; "" for the built-in ones."""
        asked = replace(window.state.options.your_code, tasks=stored(path), task="")
        window.change(window.state.with_options(asked))
        window.show_in(YOUR_CODE, layout.LOOPS)

    def ask(self, wish: CodeWish) -> None:
        """Ask for what a button would do, in the next frame."""
        self._asked = wish

    @property
    def settled(self) -> bool:
        if not self._seen or self._pictures is None:
            return True
        return not (self.runs.busy or self._pictures.busy)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._follower = FileFollower(host.animate, lambda: self.runs.busy)
        self._pictures = PicturesShown(host, context)

    def end(self) -> None:
        if self._follower is not None:
            self._follower.close()
        self.runs.close()
        if self._pictures is not None:
            self._pictures.close()

    def unseen(self, host: Host) -> None:
        self.runs.poll()
        if not self._seen:
            return
        assert self._follower is not None and self._pictures is not None
        self._seen = False
        self._follower.rest()
        if self.runs.busy:
            self.runs.forget()  # nothing runs while hidden
        self._pictures.forget()
        self._outside.show(YOUR_CODE, ())

    def draw(self, host: Host) -> None:
        assert self._pictures is not None
        self._pictures.begin_frame()
        self._seen = True
        host.renderers.need_size(host.state.images)
        path = restored(host.state.options.your_code.file)
        if self._written:
            self._open_written(host)
        wish: CodeWish
        if not path:
            self._rest()
            tasks = restored(host.state.options.your_code.tasks)
            wish = panel.invitation(Path(tasks).name, host.fonts)
        elif not self._may_run(host, path):
            self._rest()
            wish = self._untrusted(host, path)
        else:
            wish = self._of_file(host, path)
        self._grant(host, self._asked or wish, path)
        self._asked = ""

    def _rest(self) -> None:
        """Run nothing, and show nothing of earlier runs."""
        assert self._follower is not None and self._pictures is not None
        self._follower.forget()
        self._pictures.forget()
        self.runs.poll()
        if self.runs.report is not None:
            self.runs.forget()
        self.told = []
        self._outside.show(YOUR_CODE, ())

    def _may_run(self, host: Host, path: str) -> bool:
        """Return True if the user has opened the file, in this window or earlier: it is a recent
        file then.
        """
        if path in self._agreed:
            return True
        return Path(path) in host.files.recent.entries

    def _of_file(self, host: Host, path: str) -> CodeWish:
        assert self._follower is not None and self._pictures is not None
        runs, options = self.runs, host.state.options.your_code
        tasks = restored(options.tasks)
        self._follower.follow(tuple(one for one in (path, tasks) if one), runs.files)
        runs.poll()
        camera = host.state.view.for_size(options.canvas)
        content = CodeContent(path, tasks, self._follower.version)
        runs.follow(CodeQuestion(content, options.task, camera, options.canvas))
        report = runs.report
        if report is not None and not report.question.content.is_of_files(content):
            report = None
        wish, canvas = panel.head(Path(path), options, runs, host.fonts)
        if canvas != options.canvas:
            host.edit(replace(host.options.your_code, canvas=canvas))
        if report is None:
            imgui.text_colored(theme.DIM, "running ...")
            return wish
        clicked = panel.tasks(report, report.chosen)
        if clicked is not None:
            host.edit(replace(host.options.your_code, task=clicked.name))
        self._pictures.follow(host, report)
        marked = marked_pixel(host, report)
        room = imgui.get_content_region_avail()
        for_pictures, for_words, beside = panel.rooms(room, self._pictures.expected)
        if self._pictures.expected:
            self._pictures.draw(host, report, for_pictures, marked)
        if beside:
            imgui.same_line()
        self.told = self._words(report, marked)
        left = imgui.get_content_region_avail()  # pictures may need less than they may have
        panel.words(self.told, for_words if beside else left, host.fonts)
        self._show_outside(host, report, marked)
        return wish

    # In the outside view.

    def _show_outside(self, host: Host, report: CodeReport, marked: Pixel | None) -> None:
        """Show the student's camera if it is wrong, and the marked pixel's rays."""
        rays = report.rays
        if rays is None or not rays.wrong.any():
            self._outside.show(YOUR_CODE, ())
            return
        end = end_parameter(rays.camera, host.focus.framed)
        first = f"pixel {host.state.options.indexing.text((0, 0))}"
        items = self._items(rays, marked, end, first)
        self._outside.show(YOUR_CODE, items)
        place = report.question.content.path, rays.task.name
        if place != self._opened_for:  # once: the user may close it again
            self._opened_for = place
            host.show(self._outside.name)

    # Requests of the user.

    def _untrusted(self, host: Host, path: str) -> CodeWish:
        """Draw a file that a lecture has named, which the user may read and run."""
        options = host.state.options.your_code
        wish, _ = panel.head(Path(path), options, None, host.fonts)
        wrapped(panel.TRUST)
        if imgui.button("Run it"):
            self._agree(host, path)
        return wish

    def _agree(self, host: Host, path: str) -> None:
        self._agreed.add(path)
        host.files.recent.add(path)
        host.animate()

    def _grant(self, host: Host, wish: CodeWish, path: str) -> None:
        assert self._follower is not None
        if wish == "open":
            host.files.open_code_dialog()
        elif wish == "starter":
            tasks = host.state.options.your_code.tasks
            host.files.save_as_dialog(
                "Write a file to begin with",
                STARTER,
                ("Python files", ".py"),
                lambda path: self.write_starter(path, tasks),
            )
        elif wish == "edit" and path and not open_in_editor(path):
            host.files.message = f"No editor was found. The file is {one_line(path)}."
        elif wish == "run" and path and self._may_run(host, path):
            self.runs.forget()
            self._follower.again()
            host.animate()
        elif wish == "stop":
            self.runs.stop()
        elif wish == "tasks":
            host.files.open_tasks_dialog()
        elif wish == "built-in":
            host.edit(replace(host.options.your_code, tasks="", task=""))

    def write_starter(self, path: str, tasks: str = "") -> str:
        """Write a starter file, on a thread. Raises LucidaError.

        tasks: those whose functions it should have, as in the options.
        """
        asked = asked_of(restored(tasks)).tasks
        wanted = asked if tasks else [task for task in asked if task.kind == RAY]
        with atomic_write(Path(path)) as file:
            file.write(starter(wanted).encode())
        self._written.append(path)
        return one_line(f"Wrote {path}.")

    def _open_written(self, host: Host) -> None:
        path = str(Path(self._written.pop()).absolute())
        self._agree(host, path)
        host.edit(replace(host.options.your_code, file=stored(path), task=""))
