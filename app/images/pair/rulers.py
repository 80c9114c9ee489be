"""The rulers of an image whose pixels are magnified: the numbers of its columns and rows.

They are drawn in the image's margin (images/placement.py), never over pixels. Both have the same
step.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from imgui_bundle import ImVec2, imgui

from lucida.app.images.screen import Screen
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import ImageOptions
from lucida.app.ui import theme
from lucida.app.ui.theme import framebuffer_scale

ADVANCE = 0.5  # width of a fixed-width character, over the font's size
GAP = 3.0  # between numbers and image
MOST_NUMBERED = 12  # longest side of an image whose pixels all have numbers in a lecture
USUAL_DIGITS = 4  # of pixel numbers, in an image that follows its window


def ruler_sizes(options: ImageOptions) -> tuple[int, int]:
    """Return the width of the rows' ruler and the height of the columns', in framebuffer pixels."""
    digits = len(str(options.resolution[1])) if options.resolution else USUAL_DIGITS
    size, scale = _text_size(), framebuffer_scale()
    wide, high = ADVANCE * size * max(2, digits) + 2 * GAP, size + GAP
    return math.ceil(wide * scale), math.ceil(high * scale)


def thinning(cell: float, needed: float) -> int:
    """Return the step between pixels that leaves space for a text: 1, 2, 5, 10, 20 ..."""
    factor = 1
    while True:
        for step in (1, 2, 5):
            if factor * step * cell >= needed:
                return factor * step
        factor *= 10


def numbered(first: int, last: int, base: int, step: int) -> Iterator[int]:
    """Yield the pixels from first to before last that get a number: the image's first one, then
    every step-th, so that numbers are odd (step 2) or round. base: the number of the first pixel.
    """
    for pixel in range(first, last):
        if pixel == 0 or (pixel if step <= 2 else pixel + base) % step == 0:
            yield pixel


def draw_rulers(
    draw: imgui.ImDrawList, screen: Screen, state: AppState, fonts: theme.Fonts, has_tools: bool
) -> None:
    """Draw columns above the image and rows at its left, if it leaves a margin.

    has_tools: see Host. Without tools, images larger than MOST_NUMBERED number only the first, the
    last and the marked pixel.
    """
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
    if not has_tools and max(screen.placement.size) > MOST_NUMBERED:
        step = max(screen.placement.size)
    marked = state.marked or (-1, -1)
    draw.push_clip_rect(corner, high, intersect_with_current_clip_rect=True)
    for far in (ImVec2(high.x, low.y), ImVec2(low.x, high.y)):  # a mark's lines end at the image
        draw.add_rect_filled(corner, far, theme.u32(theme.BACKGROUND))

    def number(text: str, at: ImVec2, chosen: bool) -> None:
        if chosen:  # the mark's yellow is legible only on a dark background
            far = ImVec2(at.x + digit * len(text) + 2, at.y + size)
            draw.add_rect_filled(ImVec2(at.x - 2, at.y), far, theme.u32(theme.MARK), 2.0)
        color = theme.rgb("#000000") if chosen else theme.TEXT
        draw.add_text(fonts.mono or imgui.get_font(), size, at, theme.u32(color), text)

    for axis, (first, last) in enumerate(((top, bottom), (left, right))):
        is_row = axis == 0
        edges = ((corner.x, high.x), (corner.y, high.y))[is_row]
        listed = numbered(first, last, base, step)
        if step >= last - first:
            listed = iter((first, last - 1))
        for pixel in _with(listed, marked[axis], first, last):
            text, place = str(pixel + base), screen.point(pixel + 0.5, pixel + 0.5)
            wide = digit * len(text)
            middle, long, needed = (
                (place.y, size, size) if is_row else (place.x, wide, wide + digit)
            )
            is_near = abs(pixel - marked[axis]) * screen.cell[1 - axis] < needed
            start = middle - long / 2
            fits = edges[0] <= start and start + long <= edges[1]
            if fits and (pixel == marked[axis] or not is_near):
                beside, above = ImVec2(low.x - GAP - wide, start), low.y - GAP / 2 - size
                at = beside if is_row else ImVec2(start, above)
                number(text, at, pixel == marked[axis])
    draw.pop_clip_rect()


def _with(pixels: Iterator[int], marked: int, first: int, last: int) -> list[int]:
    """Return these pixels, and the marked one if it is visible."""
    return sorted({*pixels, *([marked] if first <= marked < last else [])})


def _text_size() -> float:
    """Return the size of the numbers, in units."""
    return theme.type_px()
