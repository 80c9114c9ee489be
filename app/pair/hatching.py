"""Hatching over what is outside of the camera's lens: no ray reaches these pixels."""

from __future__ import annotations

import functools

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from app.images.placement import Placement
from app.images.screen import Screen
from app.widgets import theme
from renderer.camera import Camera
from renderer.lenses import Lens

APART = 9.0  # from one line to the next, along x and y
FARTHEST_PX = 1e6

Floats = NDArray[np.float64]
Viewport = tuple[float, float, float, float]


def draw_hatching(draw: imgui.ImDrawList, screen: Screen, camera: Camera) -> None:
    """Draw the lines and the border, each light beside dark, so that they show on any
    background.
    """
    if camera.lens is None:
        return
    of = camera.lens, camera.viewport, camera.distance, screen.placement
    lines, border = hatching(*of, theme.px(APART) * screen.scale), border_px(*of)
    unit = 1.0 / screen.scale
    draw.push_clip_rect(*screen.visible, True)
    for shift, color in ((1.0, theme.rgb("#000000", 0.5)), (0.0, theme.rgb("#c8ccd2", 0.55))):
        ink, x0, y0 = theme.u32(color), screen.corner.x + shift, screen.corner.y
        for x1, y1, x2, y2 in lines:
            start = ImVec2(x0 + x1 * unit, y0 + y1 * unit)
            draw.add_line(start, ImVec2(x0 + x2 * unit, y0 + y2 * unit), ink, 1.0)
        if lines:
            edge = [ImVec2(x0 + x * unit, y0 + y * unit) for x, y in border.tolist()]
            draw.add_polyline([*edge], ink, 1.0, int(imgui.ImDrawFlags_.closed))
    draw.pop_clip_rect()


@functools.lru_cache(maxsize=8)
def border_px(lens: Lens, viewport: Viewport, distance: float, placement: Placement) -> Floats:
    """Return the border of what the lens sees, points (n, 2) in framebuffer pixels from the pane's
    corner; none if it sees all of the image plane.
    """
    border = lens.border()
    if border is None:
        return np.zeros((0, 2))
    left, right, bottom, top = viewport
    x = (border[:, 0] * distance - left) / (right - left) * placement.extent[0]
    y = (top + border[:, 1] * distance) / (top - bottom) * placement.extent[1]
    return np.clip(np.stack([x, y], axis=-1) + placement.origin, -FARTHEST_PX, FARTHEST_PX)


@functools.lru_cache(maxsize=8)
def hatching(
    lens: Lens, viewport: Viewport, distance: float, placement: Placement, apart: float
) -> list[tuple[float, float, float, float]]:
    """Return the ends (x, y, x, y) of lines over what of the visible image is outside of the lens.

    apart: from one line to the next. All lengths are framebuffer pixels from the pane's corner.
    """
    border = border_px(lens, viewport, distance, placement)
    if not len(border):
        return []
    # On a line, x + y is constant; x - y is the place on it.
    line, place = border[:, 0] + border[:, 1], border[:, 0] - border[:, 1]
    low_x, low_y, high_x, high_y = placement.visible
    found: list[tuple[float, float, float, float]] = []
    for at in np.arange(low_x + low_y, high_x + high_y, apart).tolist():
        ends = max(2 * low_x - at, at - 2 * high_y), min(2 * high_x - at, at - 2 * low_y)
        inside = np.clip(_crossings(line, place, at), *ends)
        for start, end in np.array([ends[0], *inside, ends[1]]).reshape(-1, 2).tolist():
            if end - start > 1e-6:
                found.append(((at + start) / 2, (at - start) / 2, (at + end) / 2, (at - end) / 2))
    return found


def _crossings(line: Floats, place: Floats, at: float) -> Floats:
    """Return where a line crosses the closed curve, in order: an even number of places."""
    over = line >= at
    k = np.flatnonzero(over != np.roll(over, -1))
    after = (k + 1) % len(line)
    share = (at - line[k]) / (line[after] - line[k])
    return np.sort(place[k] + share * (place[after] - place[k]))
