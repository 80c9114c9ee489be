"""The silent repairs of model readers, kept for reports on what is odd in a file."""

from __future__ import annotations

from contextlib import AbstractContextManager
from contextvars import ContextVar

from lucida.renderer.system.cancelling import during

_found: ContextVar[list[str]] = ContextVar("repairs")


def repairs() -> AbstractContextManager[list[str]]:
    """Collect the repairs made during the block, on this thread: a phrase for each geometry."""
    return during(_found, [])


def note_repairs(name: str, counts: dict[str, int]) -> None:
    """Record the repairs of one geometry, unless nothing was repaired.

    counts: how many were repaired, by a phrase such as "faces without an area, left out".
    """
    phrases = [f"{what}: {count}" for what, count in counts.items() if count]
    found = _found.get(None)
    if found is not None and phrases:
        found.append((f"{name!r}: " if name else "") + "; ".join(phrases))
