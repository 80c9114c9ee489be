"""The laboratory's pictures on the screen: with a heading, frames about pixels, and clicks on them.

Owns their looks. Knows nothing of how a picture is made.
"""

from __future__ import annotations

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui

from app.laboratory.displays import Region
from app.laboratory.pages import Panel
from app.state.options import Pixel
from app.widgets import theme
from app.widgets.areas import focused_steps, mouse_area
from app.widgets.lettering import fitting_words, lettering
from app.widgets.rows import tip
from app.widgets.theme import Fonts, framebuffer_scale

HEADING_EM = 2.5  # above each picture
DASH_PX = 6.0


def draw_panel(
    name: str,
    panel: Panel,
    texture: moderngl.Texture | None,
    at: ImVec2,
    width: float,
    fonts: Fonts,
    pixel: Pixel | None,
) -> Pixel | None:
    """Draw a picture below its heading, which has the same width. Return the image's pixel that the
    mouse holds, or that the arrow keys lead to from `pixel`; it may be outside the image.
    """
    scale, em = framebuffer_scale(), imgui.get_font_size()
    draw = imgui.get_window_draw_list()
    with lettering(fonts.bold):
        draw.add_text(at, theme.u32(theme.TEXT), fitting_words(panel.title, width))
    below = ImVec2(at.x, at.y + 1.15 * em)
    draw.add_text(below, theme.u32(theme.DIM), fitting_words(panel.caption, width))
    if texture is None:
        return None
    top = at.y + HEADING_EM * em
    origin = ImVec2(np.floor(at.x * scale) / scale, np.floor(top * scale) / scale)
    extent = ImVec2(texture.size[0] / scale, texture.size[1] / scale)
    far = ImVec2(origin.x + extent.x, origin.y + extent.y)
    imgui.set_cursor_screen_pos(origin)
    mouse_area(name, extent)
    right, down = focused_steps() if pixel is not None else (0, 0)
    if imgui.calc_text_size(panel.caption).x > width:
        tip(panel.caption)
    draw.add_image(imgui.ImTextureRef(texture.glo), origin, far)
    round_it = ImVec2(origin.x - 1, origin.y - 1), ImVec2(far.x + 1, far.y + 1)
    draw.add_rect(*round_it, theme.u32(theme.LINE))  # a white picture ends where it ends
    if not panel.magnification:
        return None
    unit = panel.magnification / scale
    if panel.region is not None:
        _frame(draw, panel, panel.region, origin, unit)
    if panel.at_work is not None:
        _frame(draw, panel, panel.at_work, origin, unit, dashed=True)
    if pixel is not None and (right or down):
        return pixel[0] + down, pixel[1] + right
    if not imgui.is_item_active():
        return None
    mouse = imgui.get_io().mouse_pos
    return (
        panel.first[0] + int((mouse.y - origin.y) / unit),
        panel.first[1] + int((mouse.x - origin.x) / unit),
    )


def _frame(
    draw: imgui.ImDrawList,
    panel: Panel,
    region: Region,
    origin: ImVec2,
    unit: float,
    dashed: bool = False,
) -> None:
    """Draw a yellow frame, or a dashed white one, around pixels."""
    first, left, rows, columns = region
    low = ImVec2(
        origin.x + (left - panel.first[1]) * unit, origin.y + (first - panel.first[0]) * unit
    )
    high = ImVec2(low.x + columns * unit, low.y + rows * unit)
    draw.add_rect(low, high, theme.u32(theme.rgb("#000000", 0.8)), 0.0, 4.0)
    if not dashed:
        draw.add_rect(low, high, theme.u32(theme.MARK), 0.0, 2.0)
        return
    corners = (low, ImVec2(high.x, low.y), high, ImVec2(low.x, high.y))
    for start, end in zip(corners, (*corners[1:], low), strict=True):
        way = end - start
        count = max(1, round(max(abs(way.x), abs(way.y)) / (2 * DASH_PX)))
        for k in range(count):
            dash = start + way * (k / count), start + way * ((k + 0.5) / count)
            draw.add_line(*dash, theme.u32(theme.rgb("#ffffff")), 2.0)
