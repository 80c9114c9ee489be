"""Camera motion by the mouse: a drag or the wheel, over the images or the outside view."""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.system.errors import LucidaError

HALF_TURN = math.pi  # a drag over the view's whole height

Point = tuple[float, float]


@dataclass(frozen=True)
class CameraDrag:
    """The start of a drag, and the camera that it has made.

    kind: "orbit", "pan", "look", or another one that moves no camera. start: the mouse, in screen
    coordinates. point: on the image plane under it. pivot, parameter: the world point that it
    turns about or drags. latest: the camera that the drag has made; if the current one differs,
    something else has changed it.
    """

    kind: str
    camera: Camera
    start: Point
    point: Point
    pivot: Vector
    parameter: float
    latest: Camera

    def moved(self, camera: Camera, mouse: ImVec2, point: Point, angle: float) -> Camera:
        """Return the camera after the drag so far, or the current one if it would leave its range.

        point: on the image plane under the mouse. angle: of one unit of dragging.
        """
        try:
            if self.kind == "pan":
                return navigation.panned(self.camera, self.point, point, self.parameter)
            right, up = mouse.x - self.start[0], self.start[1] - mouse.y
            pivot = self.camera.eye if self.kind == "look" else self.pivot
            return navigation.orbited(self.camera, pivot, right * angle, up * angle)
        except LucidaError:
            return camera


def drag_kind() -> str:
    """Return the kind of drag that the pressed buttons and keys begin."""
    io = imgui.get_io()
    if not imgui.is_mouse_down(imgui.MouseButton_.left) or io.key_shift:
        return "pan"
    return "look" if io.key_alt else "orbit"
