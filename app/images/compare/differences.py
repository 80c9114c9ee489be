"""The differences as numbers in magnified pixels, where the compare view shows false colours.

Only pixels that differ have a number: the others agree.
"""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2, imgui

from app.images.screen import Screen
from app.state.app_state import AppState
from app.ui import theme
from renderer.compare.raster_and_ray import AGREE, Comparison
from renderer.images.difference import false_color, signed_difference
from renderer.images.display import from_srgb, luminance

FROM_PX = 32.0  # as the images' own values
MOST = 1200
ADVANCE = 0.5  # of the fixed-width font, in its size
UNITS = {"color": 255.0, "depth": 100.0}


def draw_differences(
    screen: Screen, state: AppState, comparison: Comparison, fonts: theme.Fonts
) -> None:
    """Draw the numbers of the visible pixels, in the units of the colour bar."""
    placement = screen.placement
    if min(placement.unit) < FROM_PX or placement.size != comparison.size:
        return
    top, left, bottom, right = placement.visible_pixels
    seen = np.s_[top:bottom, left:right]
    rows, columns = np.nonzero(comparison.labels[seen] != AGREE)
    if not 0 < len(rows) <= MOST:
        return
    channel, options = state.images.channel, state.options.compare
    difference = signed_difference(
        comparison.raster.part(seen), comparison.ray.part(seen), channel
    )[rows, columns]
    colors = false_color(difference, channel, options.gain, options.mode == "signed")
    dark = (luminance(from_srgb(colors)) < 0.18).tolist()
    numbers = difference * UNITS.get(channel, 1.0)
    if options.mode == "absolute":
        numbers = np.abs(numbers)
    texts = [difference_text(float(number), options.mode == "signed") for number in numbers]
    longest = max(len(text) for text in texts)
    width, height = screen.cell
    size = theme.type_px()
    if size > min(width / ((longest + 0.6) * ADVANCE), 0.8 * height):
        return  # they would cover one another
    draw = imgui.get_window_draw_list()
    draw.push_clip_rect(*screen.visible, True)
    for row, column, text, on_dark in zip(
        rows.tolist(), columns.tolist(), texts, dark, strict=True
    ):
        at = screen.point(row + top + 0.5, column + left + 0.5)
        at = ImVec2(at.x - ADVANCE * size * len(text) / 2, at.y - size / 2)
        color = theme.rgb("#ffffff") if on_dark else theme.rgb("#000000")
        draw.add_text(fonts.mono or imgui.get_font(), size, at, theme.u32(color), text)
    draw.pop_clip_rect()


def difference_text(number: float, signed: bool) -> str:
    """Return three digits, and the sign if it matters."""
    if np.isinf(number):
        return "one" if not signed else ("+one" if number > 0 else "-one")
    text = f"{number:.3g}" if abs(number) < 1000 else f"{number:.0f}"
    return f"+{text}" if signed and number > 0 else text
