"""The list of the scene's objects, and the inspector: two views that can be docked.

This module keeps values that are not in the state. outliner.py and inspector.py draw the views.
"""

from __future__ import annotations

from collections.abc import Sequence

from lucida.app.images.pair.view import RasterView
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.ui import layout
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.renderer.editing.changing import Item

from .actions import CHOOSING, SCENE
from .in_views import InViews
from .inspector import Inspector, PanelSetting, inspector_panel
from .outliner import outliner_panel

OBJECTS, INSPECTOR = "Objects", "Inspector"


class ObjectsView(Instrument):
    name = OBJECTS
    title = OBJECTS
    actions = (*SCENE, *CHOOSING)
    mouse = (("double-click an object", "select it (with V, one click does); Shift adds"),)
    space = layout.CAMERA_SPACE

    def __init__(self, views: Sequence[Instrument]) -> None:
        guest = InViews()
        view_of(views, RasterView).linked.guest = guest
        view_of(views, OutsideView).hosted.guest = guest
        self._seen: Item | None = None  # the item that the list has scrolled to

    def draw(self, host: Host) -> None:
        self._seen = outliner_panel(host, self._seen)


class InspectorView(Instrument):
    name = INSPECTOR
    title = INSPECTOR
    space = layout.INSTRUMENTS

    def __init__(self, views: Sequence[Instrument]) -> None:
        self.inspector = Inspector()

    def draw(self, host: Host) -> None:
        around = PanelSetting(host.fonts, host.focus)
        self.inspector, state = inspector_panel(self.inspector, host.state, around)
        host.apply(state)
