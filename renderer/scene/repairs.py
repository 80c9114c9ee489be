"""The silent repairs of model readers, kept for reports on what is odd in a file."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Repair:
    """The repairs of one geometry.

    name: its own. flat_faces: dropped, because they have no area; repeated_faces: dropped, because
    another has the same corners; lost_normals: those of no direction, or NaN; lost_places: texture
    coordinates that are NaN, or too far from the image.
    """

    name: str
    flat_faces: int = 0
    repeated_faces: int = 0
    lost_normals: int = 0
    lost_places: int = 0


_found: ContextVar[list[Repair] | None] = ContextVar("what was mended", default=None)


@contextlib.contextmanager
def repairs() -> Iterator[list[Repair]]:
    """Collect the repairs made inside this context, on this thread."""
    found: list[Repair] = []
    token = _found.set(found)
    try:
        yield found
    finally:
        _found.reset(token)


def note_repair(repair: Repair) -> None:
    """Record a repair; nothing is kept of what was sound."""
    found = _found.get()
    if found is not None and repair != Repair(repair.name):
        found.append(repair)
