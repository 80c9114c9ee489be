"""The camera of the outside view, its reach, and the width of its lines.

The module also makes the camera that sees everything and those along the world's axes, and selects
the pixel whose ray is drawn.
"""

from __future__ import annotations

import math
from collections.abc import Container
from functools import partial

import numpy as np
from imgui_bundle import ImVec2

from lucida.app.images.ray_pictures import RayPainter, RayPictures
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size, has_pixel
from lucida.renderer.camera.navigation import depth_of, orbited
from lucida.renderer.system.memo import Memo, same

from .diagram import RayEnd
from .extent import around, arrow_length, outside_camera
from .frustum import bundle_pixels
from .mouse import Area, Scope
from .screen import NEAREST, OutsideScreen

NOTHING = np.zeros((0, 3))
STILL_S = 0.25  # the view follows the other camera after it has been still for so long
ROOMY_PX = 330.0  # a smaller view has smaller symbols
TRIAD_PX = 47.5  # half of the axes' square in the upper right corner


class Scopes:
    """The view of the current frame, recomputed only if it must change.

    moves: True if the other camera has just moved.
    """

    def __init__(self) -> None:
        self._fixed: tuple[object, ...] | None = None
        self._inner: Camera | None = None  # the other camera of the scope
        self._seen: Camera | None = None  # the other camera in the previous frame
        self._changed_s = 0.0
        self._scope: Scope | None = None
        self._is_in_picture = Memo(is_in_picture)
        self.moves = False

    def of(self, host: Host, area: Area, more: Floats, now_s: float, held: bool = False) -> Scope:
        """Return scope_of(), but keep an outside camera that is not the user's own where it is
        while the other camera moves within sight.

        held: True while a mouse button is held, so that a pause does not end the drag.
        """
        both, state = host.renderers, host.state
        place = (area.size, *area.origin, *area.extent)
        options, inner = state.options.outside, both.camera(state)
        looking = options.camera
        fixed = state.scene, more, looking, options.turned, both.size, place, state.step
        if inner != self._seen:
            self._seen, self._changed_s = inner, now_s
        self.moves = now_s - self._changed_s < STILL_S
        scope = self._scope if same(fixed, self._fixed) else None
        stays = (
            scope is not None
            and (self.moves or held)
            and looking is None
            and self._is_in_picture(inner, scope.shown, arrow_length(host.focus.reach))
        )
        if scope is None or not (stays or inner == self._inner):
            self._scope = scope = scope_of(host, area, more)
            self._fixed, self._inner = fixed, inner
        return scope


def is_in_picture(camera: Camera, looking: Camera, arrow: float = 1.0) -> bool:
    """Return True if a camera's eye, basis and image plane are in the picture of another one.

    arrow: from arrow_length().
    """
    matrix = looking.image_from_world((2, 2))
    x, y, t = matrix[:, :3] @ around(NOTHING, arrow, camera).T + matrix[:, 3:]
    edge = 1.0 if looking.is_parallel else t
    return bool((np.maximum(abs(x), abs(y)) <= edge).all())


def scope_of(host: Host, area: Area, more: Floats = NOTHING) -> Scope:
    """Return the view in an area.

    more: points (n, 3) that must be in sight with the scene.
    """
    points = _points(host, more)
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    reach = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0))) / 2
    options = host.state.options.outside
    camera = options.camera or camera_for_all(host, area, more)
    x, y, z = center.tolist()
    middle, reach = (x, y, z), max(reach, 1e-9)
    if options.turned:
        camera = orbited(camera, middle, math.radians(options.turned), 0.0)
    return Scope(camera, camera.fitted(area.size), area, middle, reach)


def camera_for_all(host: Host, area: Area, more: Floats = NOTHING) -> Camera:
    """Return the outside camera that sees everything."""
    home = host.state.scene.view.camera
    return outside_camera(_points(host, more), home, area.size[0] / area.size[1])


def nearest(camera: Camera, scope: Scope) -> float:
    """Return the least t of lines that are drawn: a small part of the distance to the middle."""
    unit = 1.0 if camera.is_parallel else camera.distance
    away = scope.reach / float(np.linalg.norm(camera.w)) / unit
    return NEAREST * max(depth_of(camera, scope.center) / unit, away)


def units_px(extent: ImVec2) -> tuple[float, float]:
    """Return the width of a line and the size of symbols in a view of this extent."""
    symbol_px = framebuffer_scale() * min(theme.px(1), min(extent.x, extent.y) / ROOMY_PX)
    # Presentation mode thickens lines, but they must not dominate the picture.
    return (theme.line_px(framebuffer_scale()) + symbol_px) / 2, symbol_px


def widest_px(screen: OutsideScreen, corners: Floats) -> float:
    """Return the longest visible side of a polygon (n, 3) on the screen."""
    points, _, _ = screen.segments(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1))
    return float(np.linalg.norm(points[:, 1] - points[:, 0], axis=1).max(initial=0.0))


def ray_ends(
    hits: RayPictures[dict[Pixel, float]],
    host: Host,
    camera: Camera,
    size: Size,
    others: Container[str],
) -> tuple[RayEnd | None, list[RayEnd]]:
    """Return the marked pixel's ray and the bundle's, with their ends as far as they are known.

    others: views that draw the rays of the pixels that they highlight.
    """
    both, state = host.renderers, host.state
    options = state.options.outside
    marked = _ray_pixel(host, others) if options.ray else None
    pixels = [(int(i), int(j)) for i, j in bundle_pixels(size, options.bundle)]
    asked = (*pixels, marked) if marked is not None else tuple(pixels)
    known: dict[Pixel, float] = {}
    if not asked:
        hits.forget()
    else:
        about = camera, size, asked
        known = hits.follow(about, state.scene, both.live, partial(ray_depths, about)) or {}
    bundle = [RayEnd(pixel, known.get(pixel)) for pixel in pixels]
    if marked is None:
        return None, bundle
    t = both.depth_at(state, marked)
    return RayEnd(marked, known.get(marked) if t is None else t), bundle


def ray_depths(
    about: tuple[Camera, Size, tuple[Pixel, ...]], painter: RayPainter
) -> dict[Pixel, float]:
    """Return the t at which each ray ends; inf if it hits nothing or is outside the lens.

    about: the camera, its image size, the rays' pixels.
    """
    camera, size, pixels = about
    i, j = np.array(pixels).T
    ray = camera.ray(i, j, size)
    t = np.full(len(pixels), np.inf)
    seen = np.isfinite(ray.direction[:, 0])
    if seen.any():
        t[seen] = painter.hits(ray.origin[seen], ray.direction[seen], camera.t_range)
    return dict(zip(pixels, t.tolist(), strict=True))


def _ray_pixel(host: Host, others: Container[str]) -> Pixel | None:
    """Return the pixel whose ray is drawn: the marked one, or the one under the mouse."""
    pixel = host.state.marked
    if pixel is None and host.hovered is not None and host.hovered[0] not in others:
        pixel = host.hovered[1]
    return pixel if pixel is not None and has_pixel(host.renderers.size, pixel) else None


def _points(host: Host, more: Floats) -> Floats:
    """Return points around everything in sight: the scene, the camera, its place in the scene's
    file, and `more`.
    """
    home = host.state.scene.view.for_size(host.renderers.size)
    points, arrow = np.concatenate([host.focus.framed, more]), arrow_length(host.focus.reach)
    return around(points, arrow, home, host.renderers.camera(host.state))
