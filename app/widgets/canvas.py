"""A small image, pixel by pixel: pixels that are set, unset pixels, and marks on them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui
from numpy.typing import NDArray

from app.state.options import Pixel
from app.widgets import theme
from renderer.images.display import to_srgb8

CELL, LEAST_CELL = 12, 4  # texels a side of a pixel, of a small canvas and of the largest
LARGEST_PX = 256  # a picture's width, where that leaves pixels LEAST_CELL texels
POINT = 1.0  # texels, half a side of the point in an unset pixel
SMALLEST_CELL = 5.0  # pixels of this size have outlines
MOST_DOTS = 500


@dataclass(frozen=True)
class Marks:
    """Marks on a canvas.

    pixel: the current one.
    box: rows and columns of a bounding box.
    dots: the tested pixels, and whether the object was hit there.
    corners: of the current triangle, (x, y) in pixels from the upper left corner.
    """

    pixel: Pixel | None = None
    box: tuple[range, range] | None = None
    dots: tuple[tuple[Pixel, bool], ...] = ()
    corners: tuple[tuple[float, float], ...] = ()


def color_picture(color: NDArray[np.float64], exposure_ev: float) -> NDArray[np.uint8]:
    """Return linear light (height, width, 3), NaN where unset, as a picture of cell_of(width)
    texels per pixel.
    """
    unset = np.asarray(np.isnan(color).any(axis=2))
    shown = to_srgb8(np.where(unset[..., None], 0.0, color), exposure_ev)
    return _pointed(shown, unset)


def depth_picture(depth: NDArray[np.float64], farthest: float) -> NDArray[np.uint8]:
    """Return ray parameters as gray, the nearest the brightest. Infinity is a point."""
    unset = ~np.isfinite(depth)
    part = np.where(unset, 0.0, depth) / (farthest if farthest > 0 else 1.0)
    gray = (255 * (1 - 0.8 * np.clip(part, 0, 1))).astype(np.uint8)
    return _pointed(np.repeat(gray[..., None], 3, axis=2), unset)


def cell_of(width: int) -> int:
    """Return the texels along a pixel's side in the picture of a canvas of this width."""
    return max(LEAST_CELL, min(CELL, LARGEST_PX // width))


def _pointed(shown: NDArray[np.uint8], unset: NDArray[np.bool_]) -> NDArray[np.uint8]:
    cell = cell_of(shown.shape[1])
    dark, light = (
        np.array([round(255 * part) for part in (color.x, color.y, color.z)], np.uint8)
        for color in (theme.BACKGROUND, theme.PLAIN)
    )
    large = np.where(unset[..., None], dark, shown).repeat(cell, axis=0).repeat(cell, axis=1)
    near = np.flatnonzero(np.abs(np.arange(cell) - (cell - 1) / 2) < POINT)
    i, j = np.nonzero(unset)
    for down in near:
        for right in near:
            large[i * cell + down, j * cell + right] = light
    return large


def canvas(
    texture: int | None,
    size: tuple[int, int],
    room: ImVec2,
    marks: Marks,
    name: str,
) -> Pixel | None:
    """Draw a canvas of (width, height) pixels as large as possible. Return the clicked pixel, or
    None.

    texture: the OpenGL name of its picture.
    """
    unit = max(1.0, min(room.x / size[0], room.y / size[1]))
    if unit > 4:
        unit = float(int(unit))
    corner = imgui.get_cursor_screen_pos()
    extent = ImVec2(size[0] * unit, size[1] * unit)
    far = ImVec2(corner.x + extent.x, corner.y + extent.y)
    clicked = imgui.invisible_button(name, extent)
    draw = imgui.get_window_draw_list()
    if texture is not None:
        draw.add_image(imgui.ImTextureRef(texture), corner, far)
    if unit >= SMALLEST_CELL:
        _grid(draw, corner, far, size, unit)
    draw.add_rect(corner, far, theme.u32(theme.PLAIN))
    _draw_marks(draw, corner, far, unit, marks)
    if not clicked:
        return None
    mouse = imgui.get_io().mouse_pos
    row, column = int((mouse.y - corner.y) / unit), int((mouse.x - corner.x) / unit)
    return min(max(row, 0), size[1] - 1), min(max(column, 0), size[0] - 1)


def _grid(
    draw: imgui.ImDrawList, corner: ImVec2, far: ImVec2, size: tuple[int, int], unit: float
) -> None:
    color = theme.u32(theme.rgb("#808890"), 0.35)
    for column in range(1, size[0]):
        x = corner.x + column * unit
        draw.add_line(ImVec2(x, corner.y), ImVec2(x, far.y), color)
    for row in range(1, size[1]):
        y = corner.y + row * unit
        draw.add_line(ImVec2(corner.x, y), ImVec2(far.x, y), color)


def _draw_marks(
    draw: imgui.ImDrawList, corner: ImVec2, far: ImVec2, unit: float, marks: Marks
) -> None:
    def cell(rows: Iterable[int], columns: Iterable[int]) -> tuple[ImVec2, ImVec2]:
        i, j = list(rows), list(columns)
        return (
            ImVec2(corner.x + j[0] * unit, corner.y + i[0] * unit),
            ImVec2(corner.x + (j[-1] + 1) * unit, corner.y + (i[-1] + 1) * unit),
        )

    if len(marks.dots) <= MOST_DOTS and unit >= SMALLEST_CELL:
        for (i, j), is_hit in marks.dots:
            middle = ImVec2(corner.x + (j + 0.5) * unit, corner.y + (i + 0.5) * unit)
            radius = max(1.5, 0.14 * unit)
            draw.add_circle_filled(middle, radius + 1, theme.u32(theme.rgb("#000000"), 0.6))
            if is_hit:
                draw.add_circle_filled(middle, radius, theme.u32(theme.MARK))
            else:
                draw.add_circle(middle, radius, theme.u32(theme.rgb("#ffffff")))
    if marks.corners:
        _triangle(draw, corner, far, unit, marks.corners)
    if marks.box is not None and marks.box[0] and marks.box[1]:
        _frame(draw, *cell(*marks.box), theme.rgb("#cc79a7"), 0.0, unit)
    if marks.pixel is not None:
        i, j = marks.pixel
        _frame(draw, *cell([i], [j]), theme.MARK, 1.0, unit)


def _triangle(
    draw: imgui.ImDrawList,
    corner: ImVec2,
    far: ImVec2,
    unit: float,
    places: tuple[tuple[float, float], ...],
) -> None:
    """Draw the triangle's sides, as far as they are on the canvas, and the names of its corners."""
    points = [ImVec2(corner.x + x * unit, corner.y + y * unit) for x, y in places]
    ends = [_within(corner, far, points[k - 1], points[k]) for k in range(len(points))]
    width = theme.line_px(1.5)
    for color, thick in (
        (theme.u32(theme.rgb("#000000"), 0.6), width + 2),
        (theme.u32(theme.RAY), width),
    ):
        for end in ends:
            if end is not None:
                draw.add_line(*end, color, thick)
    em = imgui.get_font_size()
    for name, point in zip("abc", points, strict=True):
        x = min(max(point.x + 3, corner.x + 2), far.x - 0.6 * em)
        y = min(max(point.y - 0.5 * em, corner.y), far.y - em)
        if abs(x - point.x) + abs(y - point.y) < 2 * em:  # otherwise the name is too far away
            draw.add_text(ImVec2(x + 1, y + 1), theme.u32(theme.rgb("#000000")), name)
            draw.add_text(ImVec2(x, y), theme.u32(theme.rgb("#ffffff")), name)


def _within(low: ImVec2, high: ImVec2, a: ImVec2, b: ImVec2) -> tuple[ImVec2, ImVec2] | None:
    """Return the part of a line inside a rectangle. Source: Liang and Barsky, 1984."""
    enter, leave = 0.0, 1.0
    for start, way, least, most in (
        (a.x, b.x - a.x, low.x, high.x),
        (a.y, b.y - a.y, low.y, high.y),
    ):
        if way == 0.0:
            if not least <= start <= most:
                return None
            continue
        first, second = sorted(((least - start) / way, (most - start) / way))
        enter, leave = max(enter, first), min(leave, second)
    if enter > leave:
        return None
    return (
        ImVec2(a.x + enter * (b.x - a.x), a.y + enter * (b.y - a.y)),
        ImVec2(a.x + leave * (b.x - a.x), a.y + leave * (b.y - a.y)),
    )


def _frame(
    draw: imgui.ImDrawList, low: ImVec2, high: ImVec2, color: ImVec4, grow: float, unit: float
) -> None:
    """Draw a rectangle that shows on any colour, around a pixel that stays visible."""
    low, high = ImVec2(low.x - grow, low.y - grow), ImVec2(high.x + grow, high.y + grow)
    width = min(theme.line_px(2.0), max(1.0, 0.22 * unit))
    draw.add_rect(
        low, high, theme.u32(theme.rgb("#000000"), 0.75), 0.0, width + min(2.5, 0.3 * unit)
    )
    draw.add_rect(low, high, theme.u32(color), 0.0, width)
