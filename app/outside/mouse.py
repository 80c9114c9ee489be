"""The mouse over the outside view: it moves the camera that looks, as it moves the others.

Owns the drag under way and the turns of the wheel. Knows nothing of what is drawn. The motions are
navigation.py's; what is turned about and dragged is the middle of what there is to see, whose
distance is known without reading an image back.
"""

from __future__ import annotations

import math
import time
from collections.abc import Hashable
from dataclasses import dataclass, replace

from imgui_bundle import ImVec2, imgui

from app.cameras import navigation
from app.host.fly import held
from renderer.camera import Camera, Vector
from renderer.errors import LucidaError

WHEEL_STEP = 1.15
WHEEL_PAUSE_S = 0.5  # turns of the wheel closer together are one step of undo
HALF_TURN = math.pi  # a drag over the view's whole height
STILL_PX = 4.0  # a press that moves less is a click


@dataclass(frozen=True)
class Scope:
    """The view at work. camera: the one that looks, as the state has it. shown: fitted to the view.
    origin: the view's upper left corner, extent: its size, in ImGui's coordinates. center, reach:
    of what there is to see, world space."""

    camera: Camera
    shown: Camera
    origin: ImVec2
    extent: ImVec2
    center: Vector
    reach: float

    def part(self, mouse: ImVec2) -> tuple[float, float]:
        """The mouse's position as a fraction of the view's width and height."""
        column = (mouse.x - self.origin.x) / max(self.extent.x, 1.0)
        return column, (mouse.y - self.origin.y) / max(self.extent.y, 1.0)

    def image_point(self, mouse: ImVec2) -> tuple[float, float]:
        """(x, y) on the looking camera's image plane under the mouse."""
        column, row = self.part(mouse)
        left, right, bottom, top = self.shown.viewport
        return left + column * (right - left), top - row * (top - bottom)

    def ray(self, mouse: ImVec2) -> tuple[navigation.Floats, navigation.Floats]:
        """Origin and direction of the looking camera's ray under the mouse."""
        column, row = self.part(mouse)
        ray = self.shown.ray(row - 0.5, column - 0.5, (1, 1))
        return ray.origin, ray.direction


@dataclass(frozen=True)
class _Grab:
    kind: str  # "orbit", "pan" or "look"
    camera: Camera
    start: tuple[float, float]
    point: tuple[float, float]
    parameter: float
    latest: Camera


class Mouse:
    """Follows the mouse over one view, whose item was just submitted."""

    def __init__(self) -> None:
        self._grab: _Grab | None = None
        self._wheel_number = 0
        self._wheel_s = 0.0

    @property
    def dragging(self) -> bool:
        return self._grab is not None

    def cancel(self) -> None:
        self._grab = None

    def clicked(self) -> bool:
        """Return True if the left button was released over the item without a drag."""
        moved = imgui.get_mouse_drag_delta(imgui.MouseButton_.left, 0.0)
        still = math.hypot(moved.x, moved.y) < STILL_PX
        return imgui.is_item_deactivated() and still and imgui.is_mouse_released(0)

    def follow(self, scope: Scope) -> tuple[Camera, Hashable]:
        """The camera that looks from now on, and the gesture that the change belongs to."""
        io = imgui.get_io()
        camera = self._drag(scope, io)
        if imgui.is_item_hovered() and io.mouse_wheel and self._grab is None:
            now_s = time.monotonic()
            self._wheel_number += now_s - self._wheel_s > WHEEL_PAUSE_S
            self._wheel_s = now_s
            return self._wheel(scope, io), ("outside wheel", self._wheel_number)
        return camera, None

    def _drag(self, scope: Scope, io: imgui.IO) -> Camera:
        mouse, camera = io.mouse_pos, scope.camera
        if imgui.is_item_activated():
            self._grab = self._begin(scope, _kind(io), mouse)
            return camera
        grab = self._grab
        if grab is None:
            return camera
        if not imgui.is_item_active():
            self._grab = None
            return camera
        if (
            camera != grab.latest and grab.kind != "look"
        ):  # something else has changed it: go on from there
            self._grab = self._begin(scope, grab.kind, mouse)
            return camera
        right, up = mouse.x - grab.start[0], grab.start[1] - mouse.y
        if math.hypot(right, up) < STILL_PX and camera == grab.camera:
            return camera
        angle = HALF_TURN / max(scope.extent.y, 1.0)
        try:
            if grab.kind == "look":  # by steps: flying moves the camera in between
                x, y = io.mouse_delta.x * angle, -io.mouse_delta.y * angle
                camera = navigation.looked(camera, x, y)
                self._grab = replace(grab, latest=camera)
                return camera
            if grab.kind == "pan":
                end = scope.image_point(mouse)
                camera = navigation.panned(grab.camera, grab.point, end, grab.parameter)
            else:
                camera = navigation.orbited(grab.camera, scope.center, right * angle, up * angle)
        except LucidaError:  # too far out: the camera stays
            return scope.camera
        self._grab = replace(grab, latest=camera)
        return camera

    def _begin(self, scope: Scope, kind: str, mouse: ImVec2) -> _Grab:
        parameter = navigation.parameter_of(scope.shown, scope.center)
        point = scope.image_point(mouse)
        start = (mouse.x, mouse.y)
        return _Grab(kind, scope.camera, start, point, parameter, scope.camera)

    def _wheel(self, scope: Scope, io: imgui.IO) -> Camera:
        """Zooms at what is under the mouse as far off as the middle; near it, in ever smaller
        steps of the scene's size, so that one can go on through."""
        at = scope.image_point(io.mouse_pos)
        _, direction = scope.ray(io.mouse_pos)
        slowest = 0.1 * scope.reach / max(math.hypot(*direction.tolist()), 1e-30)
        parameter = max(navigation.parameter_of(scope.shown, scope.center, slowest), slowest)
        origin, direction = scope.ray(io.mouse_pos)
        target = origin + parameter * direction
        try:
            camera = navigation.zoomed(
                scope.camera, at, WHEEL_STEP ** float(io.mouse_wheel), parameter
            )
            if navigation.may_zoom(scope.camera, camera, target, scope.center, scope.reach):
                return camera
        except (LucidaError, OverflowError):
            pass
        return scope.camera


def _kind(io: imgui.IO) -> str:
    if not imgui.is_mouse_down(imgui.MouseButton_.left) or io.key_shift:
        return "pan"
    return "look" if io.key_alt or any(held()) else "orbit"
