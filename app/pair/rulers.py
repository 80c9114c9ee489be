"""The rulers of an image whose pixels are magnified: the numbers of its columns and rows.

They are in a margin that the image leaves (images/placement.py), never over pixels. Both have the
same step.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from imgui_bundle import ImVec2, imgui

from app.images.screen import Screen
from app.state.app_state import AppState
from app.state.options import ImageOptions
from app.widgets import theme
from app.widgets.theme import framebuffer_scale

ADVANCE = 0.5  # of the fixed-width font, in its size
LEAST_TEXT, TEXT = 13.0, 0.9  # in units; in parts of the window's type
GAP = 3.0  # between numbers and image
USUAL_DIGITS = 4  # of an image that follows its window


def ruler_sizes(options: ImageOptions) -> tuple[int, int]:
    """Width of the ruler with the rows' numbers and height of the one with the columns', in
    framebuffer pixels."""
    digits = len(str(options.resolution[1])) if options.resolution else USUAL_DIGITS
    size, scale = _text_size(), framebuffer_scale()
    wide, high = ADVANCE * size * max(2, digits) + 2 * GAP, size + GAP
    return math.ceil(wide * scale), math.ceil(high * scale)


def thinning(cell: float, needed: float) -> int:
    """Every how many pixels a text has room: 1, 2, 5, 10, 20 ..."""
    factor = 1
    while True:
        for step in (1, 2, 5):
            if factor * step * cell >= needed:
                return factor * step
        factor *= 10


def numbered(first: int, last: int, base: int, step: int) -> Iterator[int]:
    """The pixels that get a number, of those from first to before last: the image's first one, then
    every step-th: the odd ones with the first, else round numbers. base: the first one's number."""
    for pixel in range(first, last):
        if pixel == 0 or (pixel if step <= 2 else pixel + base) % step == 0:
            yield pixel


def draw_rulers(
    draw: imgui.ImDrawList, screen: Screen, state: AppState, fonts: theme.Fonts
) -> None:
    """Columns above what is seen of the image, rows at its left, where it leaves a margin."""
    if not any(screen.placement.margin):
        return
    low, high = screen.visible
    corner = ImVec2(
        low.x - screen.placement.margin[0] / screen.scale,
        low.y - screen.placement.margin[1] / screen.scale,
    )
    size, base = _text_size(), state.options.indexing.value
    columns, _ = screen.placement.size
    top, left, bottom, right = screen.placement.visible_pixels
    digit = ADVANCE * size
    step = max(
        thinning(screen.cell[0], digit * (len(str(columns)) + 1)), thinning(screen.cell[1], size)
    )
    marked = state.marked or (-1, -1)
    draw.push_clip_rect(corner, high, intersect_with_current_clip_rect=True)
    for far in (ImVec2(high.x, low.y), ImVec2(low.x, high.y)):  # a mark's lines end at the image
        draw.add_rect_filled(corner, far, theme.u32(theme.BACKGROUND))

    def number(text: str, at: ImVec2, chosen: bool) -> None:
        if chosen:  # the mark's yellow is legible on dark only, and there in both themes
            far = ImVec2(at.x + digit * len(text) + 2, at.y + size)
            draw.add_rect_filled(ImVec2(at.x - 2, at.y), far, theme.u32(theme.MARK), 2.0)
        color = theme.rgb("#000000") if chosen else theme.TEXT
        draw.add_text(fonts.mono or imgui.get_font(), size, at, theme.u32(color), text)

    for column in _with(numbered(left, right, base, step), marked[1], left, right):
        text, middle = str(column + base), screen.point(0, column + 0.5).x
        near = abs(column - marked[1]) * screen.cell[0] < digit * (len(text) + 1)
        x = middle - digit * len(text) / 2
        fits = corner.x <= x and x + digit * len(text) <= high.x
        if fits and (column == marked[1] or not near):
            number(text, ImVec2(x, low.y - GAP / 2 - size), column == marked[1])
    for row in _with(numbered(top, bottom, base, step), marked[0], top, bottom):
        text, middle = str(row + base), screen.point(row + 0.5, 0).y
        near = abs(row - marked[0]) * screen.cell[1] < size
        fits = corner.y <= middle - size / 2 and middle + size / 2 <= high.y
        if fits and (row == marked[0] or not near):
            x = low.x - GAP - digit * len(text)
            number(text, ImVec2(x, middle - size / 2), row == marked[0])
    draw.pop_clip_rect()


def _with(pixels: Iterator[int], marked: int, first: int, last: int) -> list[int]:
    """These, and the marked one where it is among what is seen."""
    return sorted({*pixels, *([marked] if first <= marked < last else [])})


def _text_size() -> float:
    """In units."""
    return theme.whole_px(max(LEAST_TEXT, TEXT * imgui.get_font_size()))
