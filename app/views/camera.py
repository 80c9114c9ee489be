"""The camera's panel as a view.

Owns the draft of numbers that are no camera yet. The panel itself is panels/camera.py.
"""

from __future__ import annotations

from app.editing import Draft
from app.panels.camera import Surroundings, camera_panel
from app.views.base import Host, View

CAMERA = "Camera"


class CameraView(View):
    name = CAMERA
    title = "Camera"

    def __init__(self) -> None:
        self._draft: Draft | None = None

    def draw(self, host: Host) -> None:
        around = Surroundings(host.fonts, host.renderers.camera(host.state), host.focus)
        draft = self._draft or Draft.of(host.state.camera)
        state, self._draft = camera_panel(host.state, draft, around)
        host.apply(state)
