"""The instruments, one line for each. To add one, add its folder and its line here.

An instrument is a room: a package with files of fixed names (docs/architecture.md). Here they are
only listed, and imported on demand. The order is that of the views in menus and tabs. The camera's
panel comes first, so that the images show its changes in the same frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType


@dataclass(frozen=True)
class Room:
    """A room.

    package: its full name.
    views: the views that lectures can show, in small letters; the views' own names are capitalised.
    """

    package: str
    views: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name of its options in sessions and lectures."""
        return self.package.rpartition(".")[2]

    def file(self, name: str) -> ModuleType | None:
        """Return one of its files, imported; None if there is no file of that name."""
        full = f"{self.package}.{name}"
        return None if find_spec(full) is None else import_module(full)


ROOMS: tuple[Room, ...] = (
    Room("app.cameras.camera_panel"),
    Room("app.images.photograph"),
    Room("app.images.pair", ("raster", "ray")),
    Room("app.images.compare", ("compare",)),
    Room("app.instruments.outside", ("outside",)),
    Room("app.instruments.objects", ("objects", "inspector")),
    Room("app.instruments.probe", ("probe",)),
    Room("app.instruments.stepper", ("stepper",)),
    Room("app.instruments.costs", ("costs",)),
    Room("app.instruments.laboratory", ("laboratory",)),
    Room("app.instruments.mistakes", ("mistakes",)),
    Room("app.checking.your_code", ("your-code",)),
    Room("app.instruments.poses", ("poses",)),
    Room("app.lecture"),
)
