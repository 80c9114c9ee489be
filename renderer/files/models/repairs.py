"""The silent repairs of model readers, kept for reports on what is odd in a file."""

from __future__ import annotations

from contextlib import AbstractContextManager
from contextvars import ContextVar
from dataclasses import dataclass

from renderer.system.cancelling import during


@dataclass(frozen=True)
class Repair:
    """The repairs of one geometry.

    name: its own.
    flat_faces: dropped, because they have no area.
    repeated_faces: dropped, because another face has the same corners.
    lost_normals: normals without a direction, or NaN.
    lost_places: texture coordinates that are NaN, or too far from the image.
    """

    name: str
    flat_faces: int = 0
    repeated_faces: int = 0
    lost_normals: int = 0
    lost_places: int = 0


_found: ContextVar[list[Repair]] = ContextVar("repairs")


def repairs() -> AbstractContextManager[list[Repair]]:
    """Collect the repairs made during the block, on this thread."""
    return during(_found, [])


def note_repair(repair: Repair) -> None:
    """Record a repair, unless nothing was repaired."""
    found = _found.get(None)
    if found is not None and repair != Repair(repair.name):
        found.append(repair)
