"""The recently opened files, the newest first; shared by all windows of a user.

Each change reads the list's file again and rewrites it, so that two windows keep each other's
entries.
"""

from __future__ import annotations

import contextlib
from pathlib import Path

import msgspec

from lucida.app.state.paths import restored, stored
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

MOST = 12
LARGEST_BYTES = 1 << 18
LONGEST = 4096  # characters of a path


class RecentFiles:
    """The list of recent files. entries: absolute paths.

    folder: the folder of the list's file; None keeps the list for this run only.
    """

    def __init__(self, folder: Path | None) -> None:
        self._file = folder / "recent.json" if folder is not None else None
        self.entries: tuple[Path, ...] = ()
        self.look()

    def add(self, path: str) -> None:
        """Put a file at the top of the list."""
        self.look()
        others = (other for other in self.entries if other != Path(path))
        self._write((Path(path), *others)[:MOST])

    def clear(self) -> None:
        self._write(())

    def look(self) -> None:
        """Read the list again, because another window may have changed it."""
        if self._file is not None:
            self.entries = _read(self._file)

    def _write(self, entries: tuple[Path, ...]) -> None:
        self.entries = entries
        if self._file is not None:
            with contextlib.suppress(LucidaError, OSError):
                self._file.parent.mkdir(parents=True, exist_ok=True)
                with atomic_write(self._file) as file:
                    file.write(msgspec.json.encode([stored(str(path)) for path in entries]))


def _read(file: Path) -> tuple[Path, ...]:
    """Return the paths in the list's file; none if the file is unusable."""
    try:
        paths = msgspec.json.decode(read_file(file, LARGEST_BYTES), type=list[str])
    except (LucidaError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return ()
    listed = (restored(path) for path in paths[:MOST])
    return tuple(Path(path) for path in listed if 0 < len(path) <= LONGEST and "\0" not in path)
