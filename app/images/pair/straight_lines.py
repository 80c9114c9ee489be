"""Straight lines of the world over an image, bent as the camera's lens bends them."""

from __future__ import annotations

import functools
import math

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from lucida.app.images.placement import Placement
from lucida.app.images.screen import Screen
from lucida.app.ui import theme
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

SAMPLES = 49  # points of a line
WANTED = 5  # lines from the middle of the image to its side
FINEST, COARSEST = 1 / 64, 1 / 4  # step from one line to the next, as a slope
WIDEST_DEG = 170.0
NARROW = 0.6  # slope of the image's sides up to which it shows only the cube's front

Floats = NDArray[np.float64]
Point = ImVec2 | tuple[int | float, int | float] | list[int | float]  # as ImGui takes it
Curves = tuple[Floats, ...]  # each (n, 2): rows and columns, integers at the pixels' centres


def draw_grid(draw: imgui.ImDrawList, screen: Screen, camera: Camera, size: Size) -> None:
    """Draw the grid over an image."""
    still = Camera(distance=camera.distance, viewport=camera.viewport, lens=camera.lens)
    corner = screen.corner.x, screen.corner.y
    points = _placed_grid(still, size, screen.placement, corner, screen.scale)
    draw_curves(draw, screen, points, theme.u32(theme.rgb("#ffffff", 0.75)), 1.0)


@functools.lru_cache(maxsize=4)
def _placed_grid(
    still: Camera, size: Size, placement: Placement, corner: tuple[float, float], scale: float
) -> list[list[Point]]:
    return placed(grid(still, size), Screen(placement, ImVec2(*corner), scale))


def grid(camera: Camera, size: Size) -> Curves:
    """Return the visible parts of a grid of straight lines on a cube around the eye.

    The cube's front faces the camera; a narrow camera has only the front.

    camera: at the origin, with the world's axes.
    """
    wide = max(min(angle, WIDEST_DEG) for angle in (camera.fov_x_deg, camera.fov_y_deg))
    slope = max(math.tan(math.radians(wide) / 2), FINEST)
    step = min(max(2.0 ** round(math.log2(slope / WANTED)), FINEST), COARSEST)
    reach = math.ceil(1.6 * slope / step) * step if slope < NARROW else 1.0
    places, along = np.arange(-reach, reach + step / 2, step), np.linspace(-reach, reach, SAMPLES)
    along = np.insert(along, SAMPLES // 2 + 1, 1e-9)  # both sides of a seam
    place, way = np.meshgrid(places, along, indexing="ij")
    front = np.concatenate(
        [
            np.stack([*axes, np.full(place.shape, -1.0)], axis=-1)
            for axes in ((place, way), (way, place))
        ]
    )
    faces = [front]
    if slope >= NARROW:
        faces = [sign * np.roll(front, axis, axis=-1) for axis in range(3) for sign in (1, -1)]
    return curves(camera, np.concatenate(faces), size)


def curves(camera: Camera, lines: Floats, size: Size) -> Curves:
    """Return the visible parts of lines through points (m, n, 3), which are broken outside the lens
    and at a panorama's seam.
    """
    row, column, _ = camera.project(lines, size)
    left, right, bottom, top = camera.viewport
    # A line jumps if two of its points are farther apart than one radian.
    most = camera.distance * min(size[0] / (right - left), size[1] / (top - bottom))
    shown = np.zeros((len(lines), lines.shape[1] + 1), bool)  # from the previous point to this one
    with np.errstate(invalid="ignore"):
        shown[:, 1:-1] = np.hypot(np.diff(row), np.diff(column)) < most
        for place, count in ((row, size[1]), (column, size[0])):
            shown[:, 1:-1] &= np.maximum(place[:, 1:], place[:, :-1]) > -1
            shown[:, 1:-1] &= np.minimum(place[:, 1:], place[:, :-1]) < count
    line, ends = np.nonzero(np.diff(shown))
    places = np.stack([row, column], axis=-1)
    parts = zip(line[::2].tolist(), ends[::2].tolist(), ends[1::2].tolist(), strict=True)
    return tuple(places[number, first : last + 1] for number, first, last in parts)


def placed(found: Curves, screen: Screen) -> list[list[Point]]:
    """Return the curves' points on the screen."""
    (x0, y0), (across, down) = screen.placement.origin, screen.placement.unit
    points: list[list[Point]] = []
    for curve in found:
        x = (x0 + (curve[:, 1] + 0.5) * across) / screen.scale + screen.corner.x
        y = (y0 + (curve[:, 0] + 0.5) * down) / screen.scale + screen.corner.y
        points.append([*map(ImVec2, x.tolist(), y.tolist())])
    return points


def draw_curves(
    draw: imgui.ImDrawList,
    screen: Screen,
    points: list[list[Point]],
    color: int,
    width: float,
) -> None:
    """Draw curves of points on the screen over the visible part of the image, with a dark edge."""
    dark = theme.u32(theme.rgb("#000000", 0.4))
    draw.push_clip_rect(*screen.visible, True)
    for ink, wide in ((dark, width + 2.0), (color, width)):
        for curve in points:
            draw.add_polyline(curve, ink, theme.line_px(wide), 0)
    draw.pop_clip_rect()
