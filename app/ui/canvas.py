"""A small image, pixel by pixel: pixels that are set, unset pixels, and marks on them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from lucida.app.state.options.shared import Pixel
from lucida.renderer.images.display import to_srgb8

from . import theme
from .areas import focused_steps, pixel_from, press_point

CELL, LEAST_CELL = 12, 4  # texels per side of a pixel: on a small canvas, on the largest
LARGEST_PX = 256  # a picture's width, if its pixels keep LEAST_CELL texels
POINT = 1.0  # texels, half a side of the point in an unset pixel
SMALLEST_CELL = 5.0  # pixels of this size have outlines


@dataclass(frozen=True)
class Marks:
    """Marks on a canvas.

    pixel: the current pixel.
    box: the rows and columns of a bounding box.
    corners: the current triangle's corners, (x, y) in pixels from the upper left corner.
    """

    pixel: Pixel | None = None
    box: tuple[range, range] | None = None
    corners: tuple[tuple[float, float], ...] = ()


def color_picture(color: NDArray[np.float64], exposure_ev: float) -> NDArray[np.uint8]:
    """Convert linear light (height, width, 3), NaN if unset, to a picture.

    A side of a pixel has cell_of(width) texels.
    """
    unset = np.asarray(np.isnan(color).any(axis=2))
    shown = to_srgb8(np.where(unset[..., None], 0.0, color), exposure_ev)
    cell = cell_of(shown.shape[1])
    dark, light = (
        np.round(255 * np.array([*color])[:3]).astype(np.uint8)
        for color in (theme.BACKGROUND, theme.PLAIN)
    )
    large = np.where(unset[..., None], dark, shown).repeat(cell, axis=0).repeat(cell, axis=1)
    near = np.abs(np.arange(cell) - (cell - 1) / 2) < POINT
    large[np.kron(unset, near[:, None] & near).astype(bool)] = light
    return large


def cell_of(width: int) -> int:
    """Return the texels per side of a pixel, for a canvas of this width."""
    return max(LEAST_CELL, min(CELL, LARGEST_PX // width))


def canvas_unit(size: tuple[int, int], room: ImVec2) -> float:
    """Return the largest side of a pixel that fits in `room`, rounded down if it exceeds 4."""
    unit = max(1.0, min(room.x / size[0], room.y / size[1]))
    return float(int(unit)) if unit > 4 else unit


def draw_canvas(
    texture: int | None, size: tuple[int, int], corner: ImVec2, unit: float, marks: Marks
) -> None:
    """Draw a canvas at a place. unit: the side of a pixel."""
    draw, far = imgui.get_window_draw_list(), corner + ImVec2(*size) * unit
    if texture is not None:
        draw.add_image(imgui.ImTextureRef(texture), corner, far)
    if unit >= SMALLEST_CELL:
        color = theme.u32(theme.rgb("#808890"), 0.35)
        for column in range(1, size[0]):
            x = corner.x + column * unit
            draw.add_line((x, corner.y), (x, far.y), color)
        for row in range(1, size[1]):
            y = corner.y + row * unit
            draw.add_line((corner.x, y), (far.x, y), color)
    draw.add_rect(corner, far, theme.u32(theme.PLAIN))
    _draw_marks(draw, corner, far, unit, marks)


def pressed_pixel(corner: ImVec2, unit: float, size: tuple[int, int]) -> Pixel:
    """Return the pressed pixel, or the nearest one. unit: the length of a pixel's side."""
    at = (press_point() - corner) / unit
    return min(max(int(at.y), 0), size[1] - 1), min(max(int(at.x), 0), size[0] - 1)


def walked_pixel(pixel: Pixel | None, size: tuple[int, int]) -> Pixel | None:
    """Return the pixel that pressed arrow keys lead to; None without keys or keyboard focus."""
    steps = focused_steps() if pixel is not None else (0, 0)
    return pixel_from(pixel, steps, size) if pixel is not None and any(steps) else None


def _draw_marks(
    draw: imgui.ImDrawList, corner: ImVec2, far: ImVec2, unit: float, marks: Marks
) -> None:
    black = theme.rgb("#000000")
    if marks.corners:
        _triangle(draw, corner, far, [corner + ImVec2(*at) * unit for at in marks.corners])
    frames = [] if marks.box is None else [(*marks.box, theme.rgb("#cc79a7"), 0.0)]
    if marks.pixel is not None:
        i, j = marks.pixel
        frames.append((range(i, i + 1), range(j, j + 1), theme.MARK, 1.0))
    width = min(theme.line_px(2.0), max(1.0, 0.22 * unit))
    for rows, columns, color, grow in frames:
        if rows and columns:  # a frame that is visible on any colour and covers no pixel
            low = corner + ImVec2(columns.start, rows.start) * unit - (grow, grow)
            high = corner + ImVec2(columns.stop, rows.stop) * unit + (grow, grow)
            edge = width + min(2.5, 0.3 * unit)
            draw.add_rect(low, high, theme.u32(black, 0.75), 0.0, edge)
            draw.add_rect(low, high, theme.u32(color), 0.0, width)


def _triangle(draw: imgui.ImDrawList, low: ImVec2, high: ImVec2, points: list[ImVec2]) -> None:
    """Draw the parts of the triangle's sides and corner names that are on the canvas."""
    black, white = theme.u32(theme.rgb("#000000")), theme.u32(theme.rgb("#ffffff"))
    width = theme.line_px(1.5)
    draw.push_clip_rect(low, high, True)
    for color, thick in ((black, width + 2), (theme.u32(theme.RAY), width)):
        for number, point in enumerate(points):
            draw.add_line(points[number - 1], point, color, thick)
    for name, point in zip("abc", points, strict=True):
        draw.add_text(point + ImVec2(4, 1), black, name)
        draw.add_text(point + ImVec2(3, 0), white, name)
    draw.pop_clip_rect()
