"""Open and save files from the window: dialogs, dropped files, loading in the background.

The dialogs are the system's, or a box for a path if there are none. Threads load and save.
"""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import portable_file_dialogs as dialogs

from lucida.app.images.photograph.reading import PHOTO_ENDINGS
from lucida.app.instruments.poses.reading import CAMERA_ENDINGS
from lucida.app.ui.background import Background
from lucida.app.ui.dialog import FileDialog, FileQuestion
from lucida.app.ui.recent import RecentFiles
from lucida.app.ui.watching import SceneWatch
from lucida.renderer.files import SCENE_ENDINGS, SCENE_NAMES, save_view
from lucida.renderer.files.outside import LISTED, OutsideError
from lucida.renderer.files.reading import MODEL_ENDINGS
from lucida.renderer.scene import Scene, View
from lucida.renderer.system.cancelling import Cancellation, CancelledError, cancelled_by
from lucida.renderer.system.errors import describe, one_line

from .kinds import CODE_ENDING
from .opening import Opened, OpenedLecture, OpenedScene, OpenedView, open_sources, reread

LINUX_DIALOGS = ("zenity", "kdialog", "matedialog", "qarma")  # programs that draw dialogs

Paths = Callable[[list[str]], None]
Load = Callable[[frozenset[Path]], "Opened"]  # takes the files that the user has agreed to


OPEN = "Open anyway"


@dataclass(frozen=True)
class WindowQuestion:
    """A question. answers: the buttons next to Cancel, with their functions."""

    text: str
    answers: dict[str, Callable[[], None]]


class Files:
    """The files of one window.

    wake: called from another thread when something has been loaded. folder: the folder of the list
    of recent files; None keeps no list. native: True to use the system's dialogs. message: the last
    error. question: the question that the user must answer.
    """

    def __init__(
        self, wake: Callable[[], None], folder: Path | None = None, native: bool = True
    ) -> None:
        self._wake = wake
        self._loading: Background[Opened] = Background("lucida-load", wake)
        self._cancellation = Cancellation()
        self._rereading: Background[Opened] = Background("lucida-reread", wake)
        self._watch = SceneWatch()
        self._guarded: dict[str, frozenset[Path]] = {}  # by the file's name: Opened.agreed
        self._reread: Scene | None = None  # the last scene whose files were saved
        self._mistake = ""  # an error in one of its files
        self._saving: Background[str] = Background("lucida-save", wake, every=True)
        self._asking: tuple[dialogs.open_file | dialogs.save_file, Paths] | None = None
        self.native = native
        self._source = ""
        self._again: Callable[[frozenset[Path]], None] = lambda more: None  # loads with consent
        self._began_s = 0.0
        self.dialog = FileDialog()
        self.recent = RecentFiles(folder)
        self.message = ""
        self.question: WindowQuestion | None = None
        self._said: list[str] = []

    @property
    def busy(self) -> bool:
        """True if something is being loaded or saved, or a system dialog is open."""
        working = self._loading.busy or self._saving.busy or self._rereading.busy
        return working or self._asking is not None

    @property
    def loading(self) -> str:
        """The name of the source that is being loaded; empty for none."""
        return self._source if self._loading.busy else ""

    @property
    def loading_s(self) -> float:
        """The time for which it has been loading, in seconds."""
        return time.monotonic() - self._began_s if self._loading.busy else 0.0

    def open(self, source: str) -> None:
        """Load a source of any kind in the background."""
        self.open_all([source])

    def open_all(self, sources: Sequence[str], dropped: bool = False) -> None:
        """Load the first thing of each kind among several sources.

        dropped: True if the user may not know which other files the sources name.
        """
        if sources:
            self._load(sources[0], lambda agreed: open_sources(sources, dropped, agreed))

    def follow(self, scene: Scene) -> bool:
        """Read the shown scene again if its files were saved. Call once a frame; poll() returns the
        result.

        Return True if files are still changing, so that the caller should call again soon.
        """
        self._watch.shown(scene)
        if not self._loading.busy and self._watch.changed(time.monotonic()):
            assert scene.origin is not None
            source = scene.origin.source
            agreed = self._guarded.get(source)

            def read() -> Opened:
                with self._watch.reading():
                    return reread(source, scene, agreed)

            self._reread = scene
            self._rereading.submit(read)
        return self._watch.waiting

    def cancel(self) -> None:
        """End the loading: its thread stops between two parts of its work."""
        if self._loading.busy:
            self._cancellation.cancel()
            self._loading.close(0.0)
            self._cancellation = Cancellation()
            self._loading = Background("lucida-load", self._wake)
            self._said.append(f"Loading {self._source} was cancelled.")

    def open_dialog(self) -> None:
        endings = (*SCENE_ENDINGS, *CAMERA_ENDINGS, *PHOTO_ENDINGS, CODE_ENDING)
        words = "Scenes, models, lectures, cameras, photographs and Python"
        self.ask_open("Open", words, tuple(dict.fromkeys(endings)), self.open_all)

    def add_model_dialog(self) -> None:
        def add(paths: list[str]) -> None:
            self._load(paths[0], lambda agreed: open_sources(paths, True, agreed, "add"))

        self.ask_open("Add a model to the scene", "Models", MODEL_ENDINGS, add)

    def save_view_dialog(self, view: View) -> None:
        def store(path: str) -> str:
            save_view(path, view)
            return one_line(f"Saved the view as {path}.")

        self.save_as_dialog("Save the view", "view.toml", ("View files", ".toml"), store)

    def know(self, saved: Scene) -> None:
        """Record that the window itself has written a scene's file, to avoid reading it again."""
        assert saved.origin is not None
        self._watch.know(saved.origin.files)
        self._watch.take_present()
        self.recent.add(saved.origin.source)

    def poll(self) -> Opened | None:
        """Return the sources loaded since the last call, or None. Errors become the message."""
        if self._asking is not None and self._asking[0].ready(0):
            (asked, chosen), self._asking = self._asking, None
            try:
                result = asked.result()
                paths = [result] if isinstance(result, str) else list(result)
                if any(paths):
                    chosen(paths)
            except UnicodeDecodeError:  # from the binding, which requires UTF-8
                self.message = (
                    "The system's dialog cannot name this file: its name is not UTF-8; "
                    "drop it on the window, or give it on the command line."
                )
        saved = self._saving.poll()
        if saved is not None and saved.error is not None:
            self.message = describe(saved.error)
        elif saved is not None and "\n" in (text := saved.value or ""):
            self.message = text  # long texts must be read
        elif saved is not None:
            self._said.append(text)
        return self._poll_loading() or self._poll_reread()

    def _poll_loading(self) -> Opened | None:
        outcome = self._loading.poll()
        if outcome is None or isinstance(outcome.error, CancelledError):
            return None
        if isinstance(outcome.error, OutsideError):
            named, again = outcome.error.files, self._again
            text = outside_question(one_line(Path(outcome.error.source).name), named)
            self.ask(text, {OPEN: lambda: again(frozenset(named))})
        elif outcome.error is not None:
            self.message = describe(outcome.error)
        elif outcome.value is not None:
            self._note(outcome.value)
        return outcome.value

    def _poll_reread(self) -> Opened | None:
        """Return a newer version of the shown scene. The last valid one stays after an error."""
        outcome = self._rereading.poll()
        if outcome is None or not self._watch.shows_version_of(self._reread):
            return None
        if self.message == self._mistake:  # the last error is fixed, or replaced by another
            self.message = ""
        self._mistake = ""
        if outcome.error is not None:
            self.message = self._mistake = describe(outcome.error)
        return outcome.value

    def poll_said(self) -> list[str]:
        """Return messages on completed work since the last call."""
        said, self._said = self._said, []
        return said

    def ask(self, text: str, answers: dict[str, Callable[[], None]]) -> None:
        """Ask a question. answers: the buttons next to Cancel, with their functions."""
        self.question = WindowQuestion(text, answers)
        self._wake()

    def say(self, text: str) -> None:
        """Add a message that poll_said() returns."""
        self._said.append(text)
        self._wake()

    def close(self) -> None:
        self._cancellation.cancel()
        self._loading.close()
        self._rereading.close()
        self._saving.close(5.0)

    def _load(self, source: str, load: Load, agreed: frozenset[Path] = frozenset()) -> None:
        self.cancel()  # the newest request does not wait for a slow one
        self.message, self.question = "", None
        self._again = lambda more: self._load(source, load, agreed | more)
        self._source = one_line(Path(source).name)
        self._began_s = time.monotonic()
        check = self._cancellation.check

        def loaded() -> Opened:
            with cancelled_by(check):
                return load(agreed)

        self._loading.submit(loaded)

    def _note(self, opened: Opened) -> None:
        scene, view = opened.find(OpenedScene), opened.find(OpenedView)
        if scene is not None and scene.scene.origin is not None:
            source = scene.scene.origin.source
            self._watch.know(scene.scene.origin.files)
            self._guarded.pop(source, None)
            if scene.agreed is not None:
                self._guarded[source] = scene.agreed
        for source in reversed(opened.sources):
            if source not in SCENE_NAMES:
                self.recent.add(str(Path(source).absolute()))
        if view is not None and view.said:
            self.say(view.said)
        read = [found for found in (scene, opened.find(OpenedLecture)) if found is not None]
        self.message = "\n".join((*opened.problems, *(note for one in read for note in one.notes)))

    def save_as_dialog(
        self, title: str, name: str, kind: tuple[str, ...], store: Callable[[str], str]
    ) -> None:
        """Ask for a path, and save to it in the background.

        kind: as in ask_name(). store: saves to the path, and returns a message for the user.
        """
        self.ask_name(title, name, kind, lambda path: self.store(lambda: store(path)))

    def store(self, store: Callable[[], str]) -> None:
        """Save in the background. store: saves, and returns a message for the user, with several
        lines if it must be read.
        """
        self._saving.submit(store)

    def ask_name(
        self, title: str, name: str, kind: tuple[str, ...], named: Callable[[str], None]
    ) -> None:
        """Ask for a name to save under.

        kind: the kind in words, and its endings; the first is added to a name without one; "" for a
        folder. named: called with the path.
        """
        words, *endings = kind

        def chosen(paths: list[str]) -> None:
            path = paths[0]
            path = path if path.lower().endswith(tuple(endings)) else path + endings[0]
            self.message = ""
            named(path)

        question = FileQuestion(title, True, tuple(endings), name, chosen)
        self._ask(question, words)

    def ask_open(self, title: str, words: str, endings: tuple[str, ...], chosen: Paths) -> None:
        self._ask(FileQuestion(title, False, endings, "", chosen), words)

    def _ask(self, question: FileQuestion, words: str) -> None:
        """Ask for files. words: a description of files with the endings."""
        if self._asking is not None or self.dialog.is_open:
            return
        listed = " ".join(f"*{ending}" for ending in question.endings)
        filters = [words, listed, "All files", "*"]
        if not (self.native and has_dialogs()):
            self.dialog.ask(question)
        elif question.saves:
            chooser = dialogs.save_file(question.title, question.name, filters)
            self._asking = chooser, question.chosen
        else:
            several = dialogs.opt.multiselect
            self._asking = dialogs.open_file(question.title, "", filters, several), question.chosen


def outside_question(name: str, files: Sequence[Path]) -> str:
    """Return the question about files outside a folder. name: the file that names them."""
    named = [f"    {one_line(str(file))}" for file in files]
    if len(named) > LISTED:
        named[LISTED:] = [f"    and {len(named) - LISTED} more"]
    return "\n".join([f"{name} names files outside of its folder:", *named])


def has_dialogs() -> bool:
    """Return True if the system has file dialogs."""
    return not sys.platform.startswith("linux") or any(map(shutil.which, LINUX_DIALOGS))
