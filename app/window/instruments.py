"""The list of instruments, one line each, in the order of their views in menus and tabs.

The camera's panel comes first, so that the images show its changes in the same frame. An instrument
that draws into another one's view, or shares its mouse, comes after that one.
"""

from __future__ import annotations

from app.cameras.camera_panel.instrument import INSTRUMENT as CAMERA_PANEL
from app.checking.your_code.instrument import INSTRUMENT as YOUR_CODE
from app.images.compare.instrument import INSTRUMENT as COMPARE
from app.images.pair.instrument import INSTRUMENT as PAIR
from app.images.photograph.instrument import INSTRUMENT as PHOTOGRAPH
from app.instruments.costs.instrument import INSTRUMENT as COSTS
from app.instruments.laboratory.instrument import INSTRUMENT as LABORATORY
from app.instruments.mistakes.instrument import INSTRUMENT as MISTAKES
from app.instruments.objects.instrument import INSTRUMENT as OBJECTS
from app.instruments.outside.instrument import INSTRUMENT as OUTSIDE
from app.instruments.poses.instrument import INSTRUMENT as POSES
from app.instruments.probe.instrument import INSTRUMENT as PROBE
from app.instruments.stepper.instrument import INSTRUMENT as STEPPER
from app.lecture.instrument import INSTRUMENT as LECTURE
from app.ui.instrument import Instrument
from app.ui.view import DockedView

# By the names of their options.
INSTRUMENTS: dict[str, Instrument] = {
    "camera_panel": CAMERA_PANEL,
    "photograph": PHOTOGRAPH,
    "pair": PAIR,
    "compare": COMPARE,
    "outside": OUTSIDE,
    "objects": OBJECTS,
    "probe": PROBE,
    "stepper": STEPPER,
    "costs": COSTS,
    "laboratory": LABORATORY,
    "mistakes": MISTAKES,
    "your_code": YOUR_CODE,
    "poses": POSES,
    "lecture": LECTURE,
}


def make_views() -> list[DockedView]:
    """Return all views, in the order in which they are drawn."""
    views: list[DockedView] = []
    for instrument in INSTRUMENTS.values():
        views += instrument.make(views)
    return views
