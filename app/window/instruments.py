"""The list of instruments, one line each, in the order of their views in menus and tabs.

The camera's panel comes first, so that the images show its changes in the same frame. An instrument
that draws into another one's view, or shares its mouse input, comes after that one.
"""

from __future__ import annotations

from lucida.app.cameras.camera_panel.view import CameraView
from lucida.app.checking.your_code.view import YourCode
from lucida.app.images.compare.view import CompareView
from lucida.app.images.pair.view import RasterView, RayView
from lucida.app.instruments.costs.view import CostsView
from lucida.app.instruments.laboratory.view import LaboratoryView
from lucida.app.instruments.mistakes.view import MistakesView
from lucida.app.instruments.objects.view import InspectorView, ObjectsView
from lucida.app.instruments.outside.instrument import Outside
from lucida.app.instruments.poses.view import PosesView
from lucida.app.instruments.probe.view import ProbeView
from lucida.app.instruments.stepper.view import StepperView
from lucida.app.lecture.instrument import LectureInstrument
from lucida.app.ui.instrument import Instrument

INSTRUMENTS: tuple[type[Instrument], ...] = (
    CameraView,
    RasterView,
    RayView,
    CompareView,
    Outside,
    ObjectsView,
    InspectorView,
    ProbeView,
    StepperView,
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
