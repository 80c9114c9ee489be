"""Record which files a reading depends on, and their versions, to know when to read again."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from pathlib import Path

from .cancelling import during

Stamp = tuple[int, int, int]  # differs between two versions of a file
Noted = dict[Path, Stamp | None]  # by absolute path; None for a missing file

_notes: ContextVar[tuple[Noted, ...]] = ContextVar("notes", default=())


def stamp(path: Path) -> Stamp | None:
    """Return a file's time, size and number; None if it does not exist."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino


@contextlib.contextmanager
def noting() -> Iterator[Noted]:
    """Return the files looked for during the block, on this thread, as they were before that."""
    noted: Noted = {}
    with during(_notes, (*_notes.get(), noted)):
        yield noted


def note(path: Path) -> None:
    """Record a file dependency. Call this before reading the file, or looking whether it exists."""
    if _notes.get():
        found = stamp(path)
        for notes in _notes.get():
            notes.setdefault(path.absolute(), found)
