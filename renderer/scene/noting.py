"""Which files a reading has looked for, and as what it found them: to know when to read again.

Knows nothing of what is in them, nor of who reads.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from contextvars import ContextVar
from pathlib import Path

Stamp = tuple[int, int, int]  # what tells a version of a file from another
Noted = dict[Path, Stamp | None]  # by absolute path; None: it was not there

_notes: ContextVar[tuple[Noted, ...]] = ContextVar("what is read", default=())


def stamp(path: Path) -> Stamp | None:
    """A file's time, size and number; None where it is not there."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino


@contextlib.contextmanager
def noting() -> Iterator[Noted]:
    """Gives what is looked for inside it, in this thread, each as it was just before that."""
    noted: Noted = {}
    token = _notes.set((*_notes.get(), noted))
    try:
        yield noted
    finally:
        _notes.reset(token)


def noted_so_far() -> frozenset[Path]:
    """Return the files that the present reading has looked for."""
    return frozenset(path for notes in _notes.get() for path in notes)


def note(path: Path) -> None:
    """Whoever reads a file, or looks whether there is one, says so first."""
    if _notes.get():
        note_all({path.absolute(): stamp(path)})


def note_all(noted: Mapping[Path, Stamp | None]) -> None:
    """What was noted elsewhere, by a process that reads for this one."""
    for notes in _notes.get():
        for path, found in noted.items():
            notes.setdefault(path, found)
