"""Parallel lines of the world, drawn over an image up to their vanishing point."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from lucida.app.images.screen import Screen
from lucida.app.state.options.pair import PairOptions
from lucida.app.ui import theme
from lucida.renderer.camera.camera import Camera

NEAREST = 0.05  # the parameter at which a line begins in perspective
LENGTH = 1e4  # of a line that has no end in the image, in lengths of its direction
LABEL = "vanishing point"

Floats = NDArray[np.float64]


def ends(camera: Camera, points: Sequence[Sequence[float]], along: Sequence[float]) -> Floats:
    """Return the visible part of each line, its two ends in the world, (n, 2, 3).

    In perspective, a line begins in front of the eye. Its other end is so far away that it is in
    the vanishing point, unless the line is parallel to the image plane.
    """
    through, direction = np.asarray(points, float).reshape(-1, 3), np.asarray(along, float)
    first = np.full(len(through), -LENGTH)
    if not camera.is_parallel:
        into = camera.camera_from_world[2, :3] @ direction / -camera.distance
        if abs(into) > 1e-9:
            direction = direction * np.sign(into)
            here = camera.project(through, (1, 1)).parameter
            first = (NEAREST - here) / abs(into)
    reach = np.stack([first, np.full(len(through), LENGTH)], axis=1)
    return through[:, None, :] + reach[..., None] * direction


def vanishing_point(camera: Camera, along: Sequence[float]) -> Floats | None:
    """Return a point of the world in the direction in which parallel lines meet; None if their
    images are parallel.
    """
    into = camera.camera_from_world[2, :3] @ np.asarray(along, float)
    if camera.is_parallel or abs(into) < 1e-9:
        return None
    return np.asarray(camera.eye) - np.sign(into) * np.asarray(along, float)


def draw_parallels(
    draw: imgui.ImDrawList,
    screen: Screen,
    camera: Camera,
    size: tuple[int, int],
    options: PairOptions,
) -> None:
    """Draw the lines, and the point in which they meet. camera: without a lens."""

    def place(points: Floats) -> list[ImVec2]:
        row, column, _ = camera.project(points, size)
        pairs = zip(np.atleast_1d(row), np.atleast_1d(column), strict=True)
        return [screen.point(float(r) + 0.5, float(c) + 0.5) for r, c in pairs]

    color, dark = theme.u32(theme.MARK), theme.u32(theme.rgb("#000000", 0.6))
    draw.push_clip_rect(*screen.visible, True)
    for segment in ends(camera, options.parallels, options.along):
        start, end = place(segment)
        end = start + (end - start) * options.extended
        for ink, width in ((dark, 4.0), (color, 2.0)):
            draw.add_line(start, end, ink, theme.line_px(width))
    meets = vanishing_point(camera, options.along) if options.extended == 1 else None
    at = place(meets)[0] if meets is not None else ImVec2(math.nan, math.nan)
    if math.isfinite(at.x):
        for ink, width in ((dark, 6.0), (color, 3.0)):
            draw.add_circle(at, theme.px(9), ink, 0, theme.line_px(width))
        wide, pad = imgui.calc_text_size(LABEL), ImVec2(theme.px(4), theme.px(4))
        low = at - ImVec2(wide.x / 2, theme.px(18) + wide.y)
        draw.add_rect_filled(low - pad, low + wide + pad, theme.u32(theme.PANEL, 0.9), pad.x)
        draw.add_text(low, theme.u32(theme.TEXT), LABEL)
    draw.pop_clip_rect()
