"""The instruments of the window, in the order of app/state/rooms.py, and all of their views."""

from __future__ import annotations

from app.state.rooms import ROOMS, Room
from app.ui.instrument import Instrument
from app.ui.view import DockedView


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
    assert not missing, f"app/state/rooms.py: there is no view {missing}"
    return views
