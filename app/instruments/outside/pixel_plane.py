"""K in the outside view: the image plane as pixels, whose grid, corners and principal point can be
dragged.

The grid slides on its plane, a corner scales it about the principal point: K changes. The principal
point takes the eye along, and the plane stays: K and t change.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.memo import Memo

from .diagram import Arrow, Dot, Item, Label, line
from .frustum import has_plane, image_point, on_plane, plane_corners
from .mouse import Scope
from .screen import OutsideScreen

Part = Literal["grid", "corner", "point"]

MOST_TICKS = 32  # of a side
NEAR_PX = 14.0  # from a handle
LEAST, MOST = 0.1, 10.0  # by which a drag may scale the grid


@dataclass(frozen=True)
class _Grab:
    """A drag. camera: at its beginning, as edited. start: on the plane, in units of u and v."""

    part: Part
    camera: Camera
    start: Floats


class PixelPlane:
    """The handles of one view, and what they draw."""

    def __init__(self) -> None:
        self._grab: _Grab | None = None
        self._items = Memo(pixel_items)

    def shown(self, host: Host) -> tuple[Item, ...]:
        """Return what is drawn: nothing unless the options ask for it."""
        if not _is_on(host) or not min(host.renderers.size):
            return ()
        camera, size = host.renderers.camera(host.state), host.renderers.size
        return self._items(camera, size, host.state.options.pixel_origin)

    def follow(self, host: Host, scope: Scope) -> bool:
        """Drag what is under the mouse, after the view's item. Return True while it is dragged."""
        if not _is_on(host):
            self._grab = None
            return False
        camera, mouse = host.renderers.camera(host.state), imgui.get_mouse_pos()
        part = _part_at(camera, scope, mouse) if imgui.is_item_hovered() else None
        if part is not None or self._grab is not None:
            imgui.set_mouse_cursor(imgui.MouseCursor_.resize_all)
        if imgui.is_item_activated() and part and imgui.is_mouse_down(imgui.MouseButton_.left):
            start = _on_plane(camera, scope, mouse)
            self._grab = None if start is None else _Grab(part, host.state.camera, start)
        elif not imgui.is_item_active():
            self._grab = None
        if self._grab is None:
            return False
        now = _on_plane(self._grab.camera, scope, mouse)
        if now is not None and imgui.is_mouse_dragging(imgui.MouseButton_.left):
            host.apply(
                host.state.with_camera(
                    dragged(self._grab.camera, self._grab.part, self._grab.start, now)
                )
            )
        return True


def pixel_items(camera: Camera, size: Size, origin: PixelOrigin) -> tuple[Item, ...]:
    """Return the focal length, the principal point, the pixels' coordinates and the handles.

    camera: fitted to its image of `size`. origin: where whole numbers are.
    """
    try:
        K = camera.intrinsics(size, origin).K
    except LucidaError:  # of parallel rays there is none
        return ()
    fx, fy, cx, cy = (float(K[at]) for at in ((0, 0), (1, 1), (0, 2), (1, 2)))
    back = 0.5 if origin == "corner" else 0.0
    eye, point = np.asarray(camera.eye), image_point(camera, 0.0, 0.0)
    last = [side - 1 + round(2 * back) for side in size]

    def at(x: float, y: float) -> Floats:
        return image_point(camera, *camera.image_point(y - back, x - back, size))

    same = math.isclose(fx, fy, rel_tol=1e-4)
    focal = f"f = {fx:.4g}" if same else f"f = ({fx:.4g}, {fy:.4g})"
    first, corners = at(0, 0), plane_corners(camera)
    items: list[Item] = [
        line("axis", "w", eye, point, 2.0, dashed=True, layer=2),
        Label("focal length", "w", focal, (eye + point) / 2),
        Dot("principal point", "extra", point, 7.0, layer=5),
        Label("principal point", "extra", f"c = ({cx:.4g}, {cy:.4g})", point),
        Label("pixel 0", "other", "(0, 0)", first, away=at(1, 1)),
    ]
    for name, end, step in (("j", at(last[0], 0), (1, 0)), ("i", at(0, last[1]), (0, 1))):
        count = last[step[1]]
        items += [
            Arrow(name, "other", first, end + 0.5 * (at(*step) - first), 2.0, 11.0),
            Label(name, "other", name, end + 0.5 * (at(*step) - first), away=first),
        ]
        if count <= MOST_TICKS:
            items += [
                Dot(name, "other", at(k * step[0], k * step[1]), 3.2) for k in range(count + 1)
            ]
    return (*items, *(Dot("corner", "plane", corner, 5.0) for corner in corners))


def dragged(camera: Camera, part: Part, start: Floats, now: Floats) -> Camera:
    """Return the camera after a drag on the image plane, from start to now, in units of u and v."""
    way = now - start
    if part == "corner":
        least = max(float(np.linalg.norm(start)), 1e-9)
        scale = min(max(float(np.linalg.norm(now)) / least, LEAST), MOST)
        return _with_viewport(camera, scale * np.asarray(camera.viewport))
    viewport = np.asarray(camera.viewport) + (1 if part == "grid" else -1) * np.repeat(way, 2)
    found = _with_viewport(camera, viewport)
    if part == "grid":
        return found
    x, y, z = (
        np.asarray(camera.eye) + way[0] * np.asarray(camera.u) + way[1] * np.asarray(camera.v)
    ).tolist()
    return replace(found, eye=(x, y, z))


def _with_viewport(camera: Camera, viewport: Floats) -> Camera:
    left, right, bottom, top = viewport.tolist()
    return replace(camera, viewport=(left, right, bottom, top))


def _is_on(host: Host) -> bool:
    camera = host.state.camera
    is_flat = not camera.is_parallel and has_plane(camera)
    return host.state.options.outside.pixels and is_flat


def _part_at(camera: Camera, scope: Scope, mouse: ImVec2) -> Part | None:
    """Return what a drag would move."""
    at = _on_plane(camera, scope, mouse)
    if at is None:
        return None
    extent = max(1, round(scope.extent.x)), max(1, round(scope.extent.y))
    point = image_point(camera, 0.0, 0.0)
    found = OutsideScreen(scope.shown, extent).spots(np.array([point, *plane_corners(camera)]))
    if found is not None:
        here = np.array([mouse.x - scope.origin.x, mouse.y - scope.origin.y])
        gaps = np.linalg.norm(found[0] - here, axis=1)
        if gaps.min() < theme.px(NEAR_PX):
            return "corner" if gaps.argmin() else "point"
    left, right, bottom, top = camera.viewport
    inside = left < at[0] < right and bottom < at[1] < top
    return "grid" if inside else None


def _on_plane(camera: Camera, scope: Scope, mouse: ImVec2) -> Floats | None:
    """Return the place on the image plane under the mouse, (x, y) in units of u and v."""
    found = on_plane(camera, *scope.ray(mouse))
    return None if found is None else np.array(found[:2])
