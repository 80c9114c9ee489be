"""The scene's objects, as an instrument of the window."""

from __future__ import annotations

from collections.abc import Sequence

from app.images.pair.view import RasterView
from app.instruments.objects.actions import CHOOSING, SCENE
from app.instruments.objects.in_views import InViews
from app.instruments.objects.view import InspectorView, ObjectsView
from app.instruments.outside.view import OutsideView
from app.ui.instrument import Instrument
from app.ui.view import DockedView, view_of

SYNONYMS = {
    "Select on click": "select pick tool",
    "Objects: move": "gizmo translate",
    "Objects: turn": "gizmo rotate",
    "Objects: scale": "gizmo size",
    "Along the object's own axes": "local world space",
    "In steps": "snap grid",
    "Objects": "outliner tree hierarchy layers",
    "Inspector": "properties material transform light",
    "Delete": "remove",
    "Duplicate": "copy clone",
}
MOUSE = (("double-click an object", "select it; V: by a click; Shift: one more"),)


def _make(views: Sequence[DockedView]) -> list[DockedView]:
    guest = InViews()
    view_of(views, RasterView).linked.guest = guest
    view_of(views, OutsideView).hosted.guest = guest
    return [ObjectsView(), InspectorView()]


INSTRUMENT = Instrument(_make, (*SCENE, *CHOOSING), MOUSE, synonyms=SYNONYMS)
