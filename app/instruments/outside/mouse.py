"""The mouse over the outside view, which moves the outside camera as it moves the others.

The camera turns about the middle of everything in sight, and a drag moves that middle: its distance
is known without reading an image back.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

from lucida.app.images.pair.camera_drag import HALF_TURN, CameraDrag, drag_kind
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size

STILL_PX = 4.0  # a press that moves less is a click


class Area(NamedTuple):
    """The view's area: its size in pixels; its upper left corner and its size in ImGui's
    coordinates.
    """

    size: Size
    origin: ImVec2
    extent: ImVec2

    @classmethod
    def of(cls, size: Size, origin: ImVec2) -> Area:
        scale = framebuffer_scale()
        return cls(size, origin, ImVec2(size[0] / scale, size[1] / scale))

    @property
    def far(self) -> ImVec2:
        """Return the lower right corner."""
        return self.origin + self.extent


@dataclass(frozen=True)
class Scope:
    """The view in a frame.

    camera: the outside camera. shown: the same, fitted to the view. center, reach: the centre and
    reach of everything in sight, world space.
    """

    camera: Camera
    shown: Camera
    area: Area
    center: Vector
    reach: float

    @property
    def origin(self) -> ImVec2:
        return self.area.origin

    @property
    def extent(self) -> ImVec2:
        return self.area.extent

    def part(self, mouse: ImVec2) -> tuple[float, float]:
        """Return the mouse's position as a fraction of the view's width and height."""
        column = (mouse.x - self.origin.x) / max(self.extent.x, 1.0)
        return column, (mouse.y - self.origin.y) / max(self.extent.y, 1.0)

    def image_point(self, mouse: ImVec2) -> tuple[float, float]:
        """Return (x, y) on the outside camera's image plane under the mouse."""
        column, row = self.part(mouse)
        left, right, bottom, top = self.shown.viewport
        return left + column * (right - left), top - row * (top - bottom)

    def ray(self, mouse: ImVec2) -> tuple[navigation.Floats, navigation.Floats]:
        """Return origin and direction of the outside camera's ray under the mouse."""
        column, row = self.part(mouse)
        ray = self.shown.ray(row - 0.5, column - 0.5, (1, 1))
        return ray.origin, ray.direction


class Mouse:
    """The mouse over one view, whose item was just submitted."""

    def __init__(self) -> None:
        self._grab: CameraDrag | None = None

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

    def follow(self, scope: Scope) -> Camera:
        """Return the new outside camera."""
        io = imgui.get_io()
        camera = self._drag(scope, io.mouse_pos)
        if imgui.is_item_hovered() and io.mouse_wheel and self._grab is None:
            return self._wheel(scope, io)
        return camera

    def _drag(self, scope: Scope, mouse: ImVec2) -> Camera:
        camera = scope.camera
        if imgui.is_item_activated():
            self._grab = self._begin(scope, drag_kind(), mouse)
            return camera
        grab = self._grab
        if grab is None:
            return camera
        if not imgui.is_item_active():
            self._grab = None
            return camera
        if camera != grab.latest:  # moved by a key: continue from there
            self._grab = self._begin(scope, grab.kind, mouse)
            return camera
        still = math.dist(grab.start, (mouse.x, mouse.y)) < STILL_PX
        if not (still and camera == grab.camera):
            angle = HALF_TURN / max(scope.extent.y, 1.0)
            camera = grab.moved(camera, mouse, scope.image_point(mouse), angle)
            self._grab = replace(grab, latest=camera)
        return camera

    def _begin(self, scope: Scope, kind: str, mouse: ImVec2) -> CameraDrag:
        parameter = navigation.parameter_of(scope.shown, scope.center)
        point, start = scope.image_point(mouse), (mouse.x, mouse.y)
        return CameraDrag(kind, scope.camera, start, point, scope.center, parameter, scope.camera)

    def _wheel(self, scope: Scope, io: imgui.IO) -> Camera:
        """Zoom at a point under the mouse that is as far away as the middle."""
        at, (origin, direction) = scope.image_point(io.mouse_pos), scope.ray(io.mouse_pos)
        parameter = navigation.aim(scope.shown, direction, scope.center, scope.reach)
        x, y, z = (origin + parameter * direction).tolist()
        extent, steps = (scope.center, scope.reach), float(io.mouse_wheel)
        found = navigation.zoomed_by_wheel(scope.camera, at, steps, parameter, (x, y, z), extent)
        return found or scope.camera
