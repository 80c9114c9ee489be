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

Floats = NDArray[np.float64]
Viewport = tuple[float, float, float, float]


def draw_hatching(draw: imgui.ImDrawList, screen: Screen, camera: Camera) -> None:
    """Draw the lines, each light beside dark, so that they show on any background."""
    if camera.lens is None:
        return
    apart = theme.px(APART) * screen.scale
    lines = hatching(camera.lens, camera.viewport, camera.distance, screen.placement, apart)
    corner, unit = screen.corner, 1.0 / screen.scale
    for shift, color in ((1.0, theme.rgb("#000000", 0.5)), (0.0, theme.rgb("#c8ccd2", 0.55))):
        ink, x0, y0 = theme.u32(color), corner.x + shift, corner.y
        for x1, y1, x2, y2 in lines:
            start = ImVec2(x0 + x1 * unit, y0 + y1 * unit)
            draw.add_line(start, ImVec2(x0 + x2 * unit, y0 + y2 * unit), ink, 1.0)


@functools.lru_cache(maxsize=8)
def hatching(
    lens: Lens, viewport: Viewport, distance: float, placement: Placement, apart: float
) -> list[tuple[float, float, float, float]]:
    """Return the ends (x, y, x, y) of lines over what of the visible image is outside of the lens.

    apart: from one line to the next. All lengths are framebuffer pixels from the pane's corner.
    """
    border = lens.border()
    if border is None:
        return []
    left, right, bottom, top = viewport
    x = (border[:, 0] * distance - left) / (right - left) * placement.extent[0]
    y = (top + border[:, 1] * distance) / (top - bottom) * placement.extent[1]
    x, y = x + placement.origin[0], y + placement.origin[1]
    # On a line, x + y is constant; x - y is the place on it.
    line, place = x + y, x - y
    low_x, low_y, high_x, high_y = placement.visible
    found: list[tuple[float, float, float, float]] = []
    for at in np.arange(low_x + low_y, high_x + high_y, apart).tolist():
        ends = max(2 * low_x - at, at - 2 * high_y), min(2 * high_x - at, at - 2 * low_y)
        inside = np.clip(_crossings(line, place, at), *ends)
        for start, end in np.array([ends[0], *inside, ends[1]]).reshape(-1, 2).tolist():
            if end > start:
                found.append(((at + start) / 2, (at - start) / 2, (at + end) / 2, (at - end) / 2))
    return found


def _crossings(line: Floats, place: Floats, at: float) -> Floats:
    """Return where a line crosses the closed curve, in order: an even number of places."""
    over = line >= at
    k = np.flatnonzero(over != np.roll(over, -1))
    after = (k + 1) % len(line)
    share = (at - line[k]) / (line[after] - line[k])
    return np.sort(place[k] + share * (place[after] - place[k]))
