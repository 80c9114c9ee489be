"""The instruments: a line for each. Whoever adds one adds its folder, and its line here.

An instrument is a room: a package with files of fixed names, which docs/architecture.md tells.
Here they are only named; their files are imported by whoever needs them. The order is that of the
views in menus and tabs; the camera's panel comes first, so that images show in the same frame what
it changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType


@dataclass(frozen=True)
class Room:
    """package: its full name. views: what lectures can show of it, in small letters; the views
    themselves have these names with a capital."""

    package: str
    views: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """What sessions and lectures call its options."""
        return self.package.rpartition(".")[2]

    def file(self, name: str) -> ModuleType | None:
        """One of its files, imported; None where it has none of that name."""
        full = f"{self.package}.{name}"
        return None if find_spec(full) is None else import_module(full)


ROOMS: tuple[Room, ...] = (
    Room("app.camera_panel"),
    Room("app.photograph"),
    Room("app.pair", ("raster", "ray")),
    Room("app.compare", ("compare",)),
    Room("app.outside", ("outside",)),
    Room("app.objects", ("objects", "inspector")),
    Room("app.probe", ("probe",)),
    Room("app.stepper", ("stepper",)),
    Room("app.costs", ("costs",)),
    Room("app.laboratory", ("laboratory",)),
    Room("app.mistakes", ("mistakes",)),
    Room("app.your_code", ("your-code",)),
    Room("app.poses", ("poses",)),
    Room("app.detective", ("detective",)),
    Room("app.lecture"),
)
