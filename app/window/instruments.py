"""The instruments of the window, in the order of app/instruments.py, and all of their views."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import DockedView
from app.instruments import ROOMS, Room


def _of(room: Room) -> Instrument:
    file = room.file("instrument")
    assert file is not None, f"{room.package} has no instrument.py"
    instrument: Instrument = file.INSTRUMENT
    return instrument


INSTRUMENTS = {room.name: _of(room) for room in ROOMS}


def make_views() -> list[DockedView]:
    """All views, in the order in which they are drawn."""
    views: list[DockedView] = []
    for instrument in INSTRUMENTS.values():
        views += instrument.make(views)
    missing = {name for room in ROOMS for name in room.views} - {
        view.name.lower() for view in views
    }
    assert not missing, f"app/instruments.py: there is no view {missing}"
    return views
