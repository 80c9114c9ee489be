"""Whether the file has been saved, looked at while nobody draws: the user is in an editor.

Owns a thread that looks at the file now and then, and says so by waking the window.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path

from app.storage.watching import FilesWatch
from renderer.scene.noting import stamp

LOOK_S = 0.1


class FileFollower:
    """wake: called when the file was saved, and at each look while is_busy(). version: of the file,
    another one each time that it was saved.

    tick: called in the thread at each look.
    """

    def __init__(
        self, wake: Callable[[], None], is_busy: Callable[[], bool], tick: Callable[[], None]
    ) -> None:
        self._wake, self._is_busy, self._tick = wake, is_busy, tick
        self._watch: FilesWatch | None = None
        self._path = ""
        self._looking, self._closed = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name="lucida-follow", daemon=True)
        self._thread.start()
        self.version = 0

    def follow(self, path: str) -> None:
        """Looks at this file from now on; "" for none. Not while nobody sees what came of it."""
        if path != self._path and path:
            self._watch = FilesWatch({Path(path): stamp(Path(path))})
            self._path = path
            self.version += 1
        if path:
            self._looking.set()
        else:
            self._looking.clear()

    def forget(self) -> None:
        """Another version is followed next, whatever it is."""
        self._looking.clear()
        self._watch, self._path = None, ""

    def again(self) -> None:
        """As if the file had been saved."""
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
