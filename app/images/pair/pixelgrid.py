"""Lines between magnified pixels, and values and names in them.

Each is drawn from a certain size on, and thinned out if it would not be legible. Only the values of
visible pixels are requested.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from lucida.app.images.pixelvalues import Depths, is_dark, line_count, shown_bytes, value_lines
from lucida.app.images.placement import RULED_FROM
from lucida.app.images.screen import Screen
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.renderer.raster.targets import Region

from .rulers import ADVANCE

MOST_VALUES = 1200  # more are thinned out, since they are illegible and slow
MOST_TEXT = 64.0
# Relative to the fixed-width font's size. Lines may be close, since digits have no descenders.
DIGITS_TOP, DIGITS_HIGH = 0.22, 0.61
LEADING = 0.76
FILLED = 0.84  # part of a pixel's height that its lines fill

Values = Callable[[AppState, str, Region], NDArray | None]  # of a channel's pixels


def draw_pixel_grid(
    draw: imgui.ImDrawList,
    screen: Screen,
    state: AppState,
    values: Values | None,
    depths: Depths,
    fonts: theme.Fonts,
) -> None:
    """Draw everything for which the magnification leaves space."""
    side_px = min(screen.placement.unit)
    if side_px < RULED_FROM:
        return
    _lines(draw, screen)
    if values is not None:
        draw.push_clip_rect(*screen.visible, intersect_with_current_clip_rect=True)
        _values(draw, screen, state, values, depths, fonts)
        draw.pop_clip_rect()


def text_size(width: float, height: float, letters: int, lines: int) -> float:
    """Return the size of the text in a pixel of that width and height.

    letters: the number of characters in the longest line.
    """
    return min(width / ((letters + 0.8) * ADVANCE), FILLED * height / _high(lines), MOST_TEXT)


def _high(lines: int) -> float:
    """Return the distance from the top of the first line's digits to the foot of the last
    one's, in sizes of the text.
    """
    return (lines - 1) * LEADING + DIGITS_HIGH


def _lines(draw: imgui.ImDrawList, screen: Screen) -> None:
    low, high = screen.visible
    top, left, bottom, right = screen.placement.visible_pixels
    width = 1 / screen.scale
    # Gray is visible on black and on white.
    color = theme.u32(theme.rgb("#808080", 0.55))
    for column in range(max(left, 1), right):
        x = screen.point(0, column).x
        draw.add_rect_filled(ImVec2(x, low.y), ImVec2(x + width, high.y), color)
    for row in range(max(top, 1), bottom):
        y = screen.point(row, 0).y
        draw.add_rect_filled(ImVec2(low.x, y), ImVec2(high.x, y + width), color)


def _values(
    draw: imgui.ImDrawList,
    screen: Screen,
    state: AppState,
    values: Values,
    depths: Depths,
    fonts: theme.Fonts,
) -> None:
    """Draw each pixel's value if it can be read, and its row and column if there is space."""
    options, (width, height) = state.images, screen.cell
    mono = fonts.mono or imgui.get_font()
    region = screen.placement.visible_pixels
    top, left, bottom, right = region
    array = values(state, options.channel, region)
    if array is None or array.size == 0:
        return
    texts = value_lines(array, options)
    dark = is_dark(shown_bytes(array, options, depths)).tolist()
    longest = max((len(line) for text in texts for line in text[0].split("\n")), default=1)
    longest = max(longest, max(len(line) for row in texts for line in row[-1].split("\n")))
    name, lines = state.options.indexing.short((bottom - 1, right - 1)), line_count(options)
    size = text_size(width, height, max(longest, len(name)), lines + 1)
    named = size >= theme.type_px()
    if not named:
        size = text_size(width, height, longest, lines)
    if size < theme.type_px():
        return  # they would be too small to read
    lines, skip = lines + named, 1
    while (bottom - top) * (right - left) / skip**2 > MOST_VALUES:
        skip += 1
    black, white = theme.u32(theme.rgb("#000000")), theme.u32(theme.rgb("#ffffff"))
    for row in range(top + -top % skip, bottom, skip):
        y = screen.point(row + 0.5, 0).y - (DIGITS_TOP + _high(lines) / 2) * size
        for column in range(left + -left % skip, right, skip):
            text = texts[row - top][column - left]
            color = white if dark[row - top][column - left] else black
            x = screen.point(0, column + 0.5).x
            below = y
            if named:
                name = state.options.indexing.short((row, column))
                at = ImVec2(x - ADVANCE * size * len(name) / 2, y)
                draw.add_text(mono, size, at, color, name)
                below += LEADING * size
            for line in text.split("\n"):
                at = ImVec2(x - ADVANCE * size * len(line) / 2, below)
                draw.add_text(mono, size, at, color, line)
                below += LEADING * size
