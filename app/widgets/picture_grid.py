"""Small pictures side by side, each below its heading: as large as the room allows, pixels sharp.

Owns where they stand and how they look. Knows nothing of what they show.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import moderngl
from imgui_bundle import ImVec2, ImVec4, imgui

from app.state.options import Pixel
from app.widgets import theme
from app.widgets.lettering import LEAST_FITTED, fitted_text, fitting_words, lettering
from app.widgets.theme import Fonts, framebuffer_scale

HEADING_EM = 1.3
GAP_EM = 0.7


@dataclass(frozen=True)
class GridPicture:
    """name: ImGui's. title, caption: above it, the one in bold. texture: None while there is none.
    frame: a colour round it; None: the usual line. pixel: one that is marked. line: a second one
    above it. tip: under the mouse."""

    name: str
    title: str
    texture: moderngl.Texture | None
    caption: str = ""
    frame: ImVec4 | None = None
    pixel: Pixel | None = None
    line: str = ""
    tip: str = ""


@dataclass(frozen=True)
class GridAnswer:
    """What was clicked: the number of the picture, and its pixel."""

    number: int
    pixel: Pixel


def columns_for(
    count: int, aspect: float, room: tuple[float, float], heading: float, gap: float
) -> tuple[int, float]:
    """How many stand in a row so that they are as large as possible, and how wide each is.

    aspect: width / height of a picture. heading: above each. Lengths are those of the room."""
    best = (1, 0.0)
    for columns in range(1, count + 1):
        rows = -(-count // columns)
        across = (room[0] - gap * (columns - 1)) / columns
        down = ((room[1] - gap * (rows - 1)) / rows - heading) * aspect
        width = min(across, down)
        if width > best[1]:
            best = (columns, width)
    return best


def picture_grid(
    pictures: Sequence[GridPicture],
    size: tuple[int, int],
    room: ImVec2,
    fonts: Fonts,
    scroll_to: int | None = None,
) -> GridAnswer | None:
    """Draws them within the room, from the cursor on. size: (width, height) of all of them.
    scroll_to: the number of the one that is to be brought into sight."""
    em, scale = imgui.get_font_size(), framebuffer_scale()
    lines = 1 + any(picture.line for picture in pictures)
    heading, gap = lines * HEADING_EM * em, GAP_EM * em
    columns, width = columns_for(len(pictures), size[0] / size[1], (room.x, room.y), heading, gap)
    unit = width * scale / size[0]  # framebuffer pixels of a picture's pixel
    unit = float(int(unit)) if unit >= 4 else unit  # then all are of one size
    extent = ImVec2(unit * size[0] / scale, unit * size[1] / scale)
    corner, answer = imgui.get_cursor_screen_pos(), None
    with lettering(fonts.bold, em):
        title_em = _common_em([picture.title for picture in pictures], extent.x)
    line_em = _common_em([picture.line for picture in pictures], extent.x)
    for number, picture in enumerate(pictures):
        row, column = divmod(number, columns)
        at = ImVec2(
            corner.x + column * (extent.x + gap), corner.y + row * (extent.y + heading + gap)
        )
        _words(picture, at, extent.x, (title_em, line_em), fonts)
        pixel = _picture(picture, size, at, extent, heading)
        if number == scroll_to:
            imgui.set_scroll_here_y()
        answer = answer if pixel is None else GridAnswer(number, pixel)
    rows = -(-len(pictures) // columns)
    imgui.set_cursor_screen_pos(corner)
    imgui.dummy(ImVec2(room.x, rows * (extent.y + heading + gap) - gap))
    return answer


def _common_em(texts: Sequence[str], width: float) -> float:
    """The size of type at which all of them have room, unless that is too small."""
    widest = max(imgui.calc_text_size(text).x for text in texts)
    return imgui.get_font_size() * max(LEAST_FITTED, min(1.0, width / max(widest, 1.0)))


def _words(
    picture: GridPicture, at: ImVec2, width: float, sizes: tuple[float, float], fonts: Fonts
) -> None:
    """What stands above a picture. sizes: of the title's type, and the line's."""
    draw, em = imgui.get_window_draw_list(), imgui.get_font_size()
    with lettering(fonts.bold, sizes[0]):
        wide = imgui.calc_text_size(picture.title + " ").x if picture.title else 0.0
        draw.add_text(at, theme.u32(theme.TEXT), fitting_words(picture.title, width))
    if picture.caption and wide < width:
        beside = ImVec2(at.x + wide + 0.3 * em, at.y)
        fitted_text(draw, beside, theme.u32(theme.DIM), picture.caption, width - wide - 0.3 * em)
    if picture.line:
        below = ImVec2(at.x, at.y + HEADING_EM * em)
        with lettering(fonts.text, sizes[1]):
            draw.add_text(below, theme.u32(theme.DIM), fitting_words(picture.line, width))


def _picture(
    picture: GridPicture, size: tuple[int, int], at: ImVec2, extent: ImVec2, heading: float
) -> Pixel | None:
    """Gives the pixel that was clicked."""
    draw, scale = imgui.get_window_draw_list(), framebuffer_scale()
    low = ImVec2(int(at.x * scale) / scale, int((at.y + heading) * scale) / scale)
    high = ImVec2(low.x + extent.x, low.y + extent.y)
    imgui.set_cursor_screen_pos(low)
    clicked = imgui.invisible_button(picture.name, ImVec2(max(extent.x, 1.0), max(extent.y, 1.0)))
    if picture.tip:
        imgui.set_item_tooltip(picture.tip)
    if picture.texture is not None:
        draw.add_image(imgui.ImTextureRef(picture.texture.glo), low, high)
    else:
        draw.add_rect_filled(low, high, theme.u32(theme.FRAME))
    width = theme.px(4) if picture.frame is not None else theme.px(1)
    color = picture.frame if picture.frame is not None else theme.LINE
    if imgui.is_item_hovered() or imgui.is_item_focused():
        color, width = picture.frame or theme.ACCENT, theme.px(3)
    outside = 0.5 * width
    draw.add_rect(
        ImVec2(low.x - outside, low.y - outside),
        ImVec2(high.x + outside, high.y + outside),
        theme.u32(color),
        0.0,
        width,
    )
    unit = extent.x / size[0]
    if picture.pixel is not None:
        _mark(draw, picture.pixel, low, unit)
    if not clicked:
        return None
    mouse = imgui.get_io().mouse_pos
    row, column = int((mouse.y - low.y) / unit), int((mouse.x - low.x) / unit)
    return min(max(row, 0), size[1] - 1), min(max(column, 0), size[0] - 1)


def _mark(draw: imgui.ImDrawList, pixel: Pixel, low: ImVec2, unit: float) -> None:
    """A frame about a pixel that is to be seen however small it is."""
    least = max(unit, theme.px(6))
    x, y = low.x + (pixel[1] + 0.5) * unit, low.y + (pixel[0] + 0.5) * unit
    near = ImVec2(x - least / 2, y - least / 2)
    far = ImVec2(x + least / 2, y + least / 2)
    draw.add_rect(near, far, theme.u32(theme.rgb("#000000", 0.8)), 0.0, theme.px(4))
    draw.add_rect(near, far, theme.u32(theme.MARK), 0.0, theme.px(2))
