"""All options, as one immutable value in AppState: what all instruments share, and the own ones of
each, by the name of its room.

Knows no instrument by its name: the registry does (app/state/rooms.py).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar

from app.state.options import SharedOptions
from app.state.rooms import ROOMS

T = TypeVar("T")


def _options() -> dict[str, type]:
    """The class of each instrument's options, by its room's name, of those that have any."""
    files = {room.name: room.file("options") for room in ROOMS}
    return {name: file.OPTIONS for name, file in files.items() if file is not None}


KINDS = _options()
_NAMES = {kind: name for name, kind in KINDS.items()}


def _with_kinds(cls: type) -> type:
    """The class as a dataclass that has a field for each instrument."""
    cls.__annotations__ = dict(KINDS)
    for name, kind in KINDS.items():
        setattr(cls, name, field(default_factory=kind))
    return dataclass(frozen=True)(cls)


@_with_kinds
class AllOptions(SharedOptions):
    """The shared options and each instrument's; session and lecture files name them
    `stepper.canvas`.
    """

    def of(self, kind: type[T]) -> T:
        """One instrument's own, by their class."""
        own: T = getattr(self, _NAMES[kind])
        return own
