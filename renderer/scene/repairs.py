"""What readers of models mend without a word: kept for whoever asks what is odd in a file.

Knows nothing of what is done about it.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Repair:
    """Of one geometry. name: its own. flat_faces: left out, as they have no area; repeated_faces:
    left out, as another has the same corners; lost_normals: those of no direction, or NaN;
    lost_places: texture coordinates that are NaN, or too far from the image."""

    name: str
    flat_faces: int = 0
    repeated_faces: int = 0
    lost_normals: int = 0
    lost_places: int = 0


_found: ContextVar[list[Repair] | None] = ContextVar("what was mended", default=None)


@contextlib.contextmanager
def repairs() -> Iterator[list[Repair]]:
    """Gives what is mended inside it, in this thread."""
    found: list[Repair] = []
    token = _found.set(found)
    try:
        yield found
    finally:
        _found.reset(token)


def note_repair(repair: Repair) -> None:
    """Whoever has mended something says so; nothing is kept of what was sound."""
    found = _found.get()
    if found is not None and repair != Repair(repair.name):
        found.append(repair)
