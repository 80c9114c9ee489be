"""The list of the scene's objects, and the inspector: two views that can be docked.

Keeps what is not in the state. outliner.py and inspector.py draw.
"""

from __future__ import annotations

from collections.abc import Sequence

from lucida.app.images.pair.view import RasterView
from lucida.app.instruments.objects.actions import CHOOSING, SCENE
from lucida.app.instruments.objects.in_views import InViews
from lucida.app.instruments.objects.inspector import Inspector, PanelSetting, inspector_panel
from lucida.app.instruments.objects.listed import Outliner
from lucida.app.instruments.objects.outliner import outliner_panel
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.ui import layout
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.renderer.editing.changing import has_default_lights

OBJECTS, INSPECTOR = "Objects", "Inspector"


class ObjectsView(Instrument):
    name = OBJECTS
    title = OBJECTS
    actions = (*SCENE, *CHOOSING)
    mouse = (("double-click an object", "select it; V: by a click; Shift: one more"),)
    synonyms = {
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
    space = layout.CAMERA_SPACE

    def __init__(self, views: Sequence[Instrument]) -> None:
        guest = InViews()
        view_of(views, RasterView).linked.guest = guest
        view_of(views, OutsideView).hosted.guest = guest
        self.outliner = Outliner()

    def draw(self, host: Host) -> None:
        listed = outliner_panel(self.outliner, host.state, host.focus)
        self.outliner = listed.outliner
        if listed.problem:
            host.files.message = listed.problem
        if listed.changed is not None:
            host.change(listed.changed)
        if listed.chosen is not None:
            host.amend(listed.chosen)
        if listed.model:
            host.files.add_model_dialog()


class InspectorView(Instrument):
    name = INSPECTOR
    title = INSPECTOR
    space = layout.INSTRUMENTS

    def __init__(self, views: Sequence[Instrument]) -> None:
        self.inspector = Inspector()

    def draw(self, host: Host) -> None:
        around = PanelSetting(host.fonts, host.focus, has_default_lights(host.state.scene))
        self.inspector, state = inspector_panel(self.inspector, host.state, around)
        host.apply(state)
