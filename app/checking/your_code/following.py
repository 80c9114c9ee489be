"""The user's text editor, and a watch on the file while it is edited there and nothing is drawn.

A thread checks it now and then, and wakes the window when it was saved.
"""

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
    tick: called on the thread at each check.
    version: of the files; changes each time one was saved.
    """

    def __init__(
        self, wake: Callable[[], None], is_busy: Callable[[], bool], tick: Callable[[], None]
    ) -> None:
        self._wake, self._is_busy, self._tick = wake, is_busy, tick
        self._watch: FilesWatch | None = None
        self._paths: tuple[str, ...] = ()
        self._others: tuple[str, ...] = ()
        self._looking, self._closed = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name="lucida-follow", daemon=True)
        self._thread.start()
        self.version = 0

    def follow(self, *paths: str) -> None:
        """Watch these files from now on."""
        if paths != self._paths:
            self._watch = FilesWatch({Path(path): stamp(Path(path)) for path in paths})
            self._paths, self._others = paths, ()
            self.version += 1
        self._looking.set()

    def follow_too(self, paths: tuple[str, ...], read_s: float) -> None:
        """Also watch these other files, on which the newest version depends.

        read_s: the time of reading, on time.time()'s clock. Anything saved later makes another
        version.
        """
        if self._watch is not None and paths != self._others:
            found = {Path(path): stamp(Path(path)) for path in (*self._paths, *paths)}
            self._watch.follow(found)
            self._others = paths
            others = (found[Path(path)] for path in paths)
            if any(one is not None and one[0] > read_s * 1e9 for one in others):
                self.version += 1

    def rest(self) -> None:
        """Stop checking until follow() is called, because the results are hidden."""
        self._looking.clear()

    def forget(self) -> None:
        """Stop watching. Whatever is followed next counts as a new version."""
        self._looking.clear()
        self._watch, self._paths, self._others = None, (), ()

    def again(self) -> None:
        """Behave as if the file had been saved."""
        self.version += 1

    def close(self) -> None:
        self._closed.set()
        self._looking.set()
        self._thread.join(1.0)

    def _run(self) -> None:
        while self._looking.wait() and not self._closed.wait(LOOK_S):
            self._tick()
            watch = self._watch
            if watch is not None and watch.changed(time.monotonic()):
                self.version += 1
                self._wake()
            elif self._is_busy():
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
