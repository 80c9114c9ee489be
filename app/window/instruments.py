"""The list of instruments, one line each, in the order of their views in menus and tabs.

The camera's panel comes first, so that the images show its changes in the same frame. An instrument
that draws into another one's view, or shares its mouse, comes after that one.
"""

from __future__ import annotations

from app.cameras.camera_panel.view import CameraView
from app.checking.your_code.instrument import YourCode
from app.images.compare.view import CompareView
from app.images.pair.view import RasterView, RayView
from app.instruments.costs.view import CostsView
from app.instruments.laboratory.view import LaboratoryView
from app.instruments.mistakes.view import MistakesView
from app.instruments.objects.view import InspectorView, ObjectsView
from app.instruments.outside.instrument import Outside
from app.instruments.poses.view import PosesView
from app.instruments.probe.view import ProbeView
from app.instruments.stepper.instrument import Stepper
from app.lecture.instrument import LectureInstrument
from app.ui.instrument import Instrument

INSTRUMENTS: tuple[type[Instrument], ...] = (
    CameraView,
    RasterView,
    RayView,
    CompareView,
    Outside,
    ObjectsView,
    InspectorView,
    ProbeView,
    Stepper,
    CostsView,
    LaboratoryView,
    MistakesView,
    YourCode,
    PosesView,
    LectureInstrument,
)


def make_views() -> list[Instrument]:
    """Return all instruments, in the order in which they are drawn."""
    views: list[Instrument] = []
    for kind in INSTRUMENTS:
        views.append(kind(views))
    return views
