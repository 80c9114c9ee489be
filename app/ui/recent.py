"""The recently opened files, the newest first; shared by all windows of a user.

Each change reads the list's file again and rewrites it, so that two windows keep each other's
entries.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import msgspec

from lucida.app.state.paths import restored, stored
from lucida.app.ui.background import Background
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError, one_line

MOST = 12
LAST_S = 5.0  # at the end, for what is being written
LARGEST_BYTES = 1 << 18
LONGEST = 4096  # characters of a path

Change = Callable[[list[str]], list[str]]


@dataclass(frozen=True)
class Recent:
    """A recent file. path: absolute. missing: it did not exist when it was last checked."""

    path: str
    missing: bool = False

    @property
    def name(self) -> str:
        """The file's name for display."""
        return one_line(Path(self.path).name)

    @property
    def folder(self) -> str:
        return one_line(str(Path(self.path).parent))


class RecentFiles:
    """The list of recent files.

    folder: of the list's file; None keeps the list for this run only.
    wake: called from a thread.
    The list is read, written and checked on a thread, so that a sleeping disk delays no frame.
    """

    def __init__(self, folder: Path | None, wake: Callable[[], None]) -> None:
        self._file = folder / "recent.json" if folder is not None else None
        self._work: Background[tuple[Recent, ...]] = Background("lucida-recent", wake, every=True)
        self._entries: tuple[Recent, ...] = ()
        self._paths: list[str] = []  # without a file; used on the thread only
        self.look()

    @property
    def entries(self) -> tuple[Recent, ...]:
        while (outcome := self._work.poll()) is not None:
            if outcome.value is not None and not self._work.busy:  # otherwise it is out of date
                self._entries = outcome.value
        return self._entries

    def add(self, path: str) -> None:
        """Put a file at the top of the list."""
        self._change(lambda paths: [path, *(other for other in paths if other != path)][:MOST])

    def clear(self) -> None:
        self._change(lambda paths: [])

    def look(self) -> None:
        """Read the list again, and check which files exist."""
        self._work.submit(lambda: self._changed(None))

    def close(self) -> None:
        self._work.close(LAST_S)

    def _change(self, change: Change) -> None:
        """Show the changed list at once, and store it on the thread."""
        self._entries = tuple(Recent(path) for path in change([e.path for e in self.entries]))
        self._work.submit(lambda: self._changed(change))

    def _changed(self, change: Change | None) -> tuple[Recent, ...]:
        """Read the list from its file again, apply the change, and write it."""
        paths = _read(self._file) if self._file is not None else self._paths
        if change is not None:
            self._paths = paths = change(paths)
            if self._file is not None:
                with contextlib.suppress(LucidaError, OSError):
                    self._file.parent.mkdir(parents=True, exist_ok=True)
                    with atomic_write(self._file) as file:
                        file.write(msgspec.json.encode([stored(path) for path in paths]))
        return tuple(Recent(path, not _exists(path)) for path in paths)


def _read(file: Path) -> list[str]:
    """Return the paths in the list's file; none if it is unusable: it is only a convenience."""
    try:
        paths = msgspec.json.decode(read_file(file, LARGEST_BYTES), type=list[str])
    except (LucidaError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return []
    paths = [restored(path) for path in paths[:MOST]]
    return [path for path in paths if 0 < len(path) <= LONGEST and "\0" not in path]


def _exists(path: str) -> bool:
    try:
        return Path(path).exists()
    except (OSError, ValueError):
        return False
