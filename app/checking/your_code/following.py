"""The user's text editor, and a watch on the file while it is edited there and nothing is drawn."""

from __future__ import annotations

import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

from lucida.app.ui.watching import FilesWatch
from lucida.renderer.system.file_dependencies import stamp

LOOK_S = 0.1


class FileFollower:
    """A thread that watches files.

    wake: called when a file was saved, and at each check while is_busy().
    version: of the files; changes each time one was saved.
    """

    def __init__(self, wake: Callable[[], None], is_busy: Callable[[], bool]) -> None:
        self._wake, self._is_busy = wake, is_busy
        self._watch = FilesWatch({})
        self._files: tuple[str, ...] = ()
        self._watched: tuple[str, ...] = ()
        self._looking, self._closed = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name="lucida-follow", daemon=True)
        self._thread.start()
        self.version = 0

    def follow(self, files: tuple[str, ...], modules: tuple[str, ...] = ()) -> None:
        """Watch these files from now on. Other files are a new version; other modules, on which the
        newest version depends, are not.
        """
        if files != self._files:
            self._watch, self._files, self._watched = FilesWatch({}), files, ()
            self.version += 1
        if (*files, *modules) != self._watched:
            self._watched = *files, *modules
            self._watch.follow({Path(path): stamp(Path(path)) for path in self._watched})
        self._looking.set()

    def rest(self) -> None:
        """Stop checking until follow() is called, because the results are hidden."""
        self._looking.clear()

    def forget(self) -> None:
        """Stop watching. Whatever is followed next counts as a new version."""
        self._looking.clear()
        self._files = ()

    def again(self) -> None:
        """Behave as if the file had been saved."""
        self.version += 1

    def close(self) -> None:
        self._closed.set()
        self._looking.set()
        self._thread.join(1.0)

    def _run(self) -> None:
        while self._looking.wait() and not self._closed.wait(LOOK_S):
            is_saved = self._watch.changed(time.monotonic())
            self.version += is_saved
            if is_saved or self._is_busy():
                self._wake()


def editor_command(path: str) -> list[str] | None:
    """Return the command that opens a text file in the user's editor; None if there is none.

    Never a program that would run it: Windows runs Python files that are opened.
    """
    if sys.platform == "darwin":
        return ["open", "-t", path]
    if sys.platform == "win32":
        return ["notepad.exe", path]
    return ["xdg-open", path] if shutil.which("xdg-open") else None


def open_in_editor(path: str) -> bool:
    """Open a file in the user's editor. Return True if there was one."""
    command = editor_command(path)
    if command is None:
        return False
    quiet = subprocess.DEVNULL
    try:
        subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True)
    except OSError:
        return False
    return True
