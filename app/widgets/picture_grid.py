"""Small pictures side by side, each below its heading: as large as fits, with sharp pixels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import moderngl
from imgui_bundle import ImVec2, ImVec4, imgui

from app.state.options import Pixel
from app.widgets import theme
from app.widgets.areas import press_area
from app.widgets.canvas import pressed_pixel, walked_pixel
from app.widgets.lettering import fitting_words, lettering
from app.widgets.rows import tip
from app.widgets.theme import Fonts, framebuffer_scale

HEADING_EM = 1.3
MOST_LINES = 7
LEAST_PART = 0.6  # of their width that captions may leave to pictures; else these go before words
GAP_EM = 0.7


@dataclass(frozen=True)
class GridPicture:
    """A picture of the grid.

    name: ImGui's id.
    title, caption: the heading; the title is bold.
    texture: None while there is none.
    frame: a colour for its frame; None for the usual line.
    pixel: the marked one.
    line: a second line in place of a caption; then all pictures of the grid have one.
    tip: shown under the mouse.
    """

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
    """A click: the number of the picture, and its pixel."""

    number: int
    pixel: Pixel


def columns_for(
    count: int,
    aspect: float,
    room: tuple[float, float],
    heading: float,
    gap: float,
    least: float = 0.0,
) -> tuple[int, float]:
    """Return the number of columns that makes the pictures largest, and the width of each.

    aspect: width / height of a picture. heading: the height above each. least: the width of a
    column, unless there is but one. Lengths are in the room's unit.
    """
    best = (1, 0.0)
    for columns in range(1, count + 1):
        rows = -(-count // columns)
        across = (room[0] - gap * (columns - 1)) / columns
        if columns > 1 and across < least:
            break
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
) -> GridAnswer | None:
    """Draw the pictures from the cursor on, in the room. size: (width, height) of the whole
    grid.
    """
    em, gap = imgui.get_font_size(), GAP_EM * imgui.get_font_size()
    widest = _widest_title(pictures, fonts)
    if any(picture.line for picture in pictures):
        heading = 2 * HEADING_EM * em
        columns, extent = _extent(len(pictures), size, room, heading, gap, widest)
    else:
        heading, columns, extent = _below_captions(pictures, size, room, fonts)
    corner, answer = imgui.get_cursor_screen_pos(), None
    width = max(extent.x, min(widest, (room.x - gap * (columns - 1)) / columns))
    pitch = ImVec2(width, extent.y) + ImVec2(gap, heading + gap)
    for number, picture in enumerate(pictures):
        row, column = divmod(number, columns)
        at = corner + pitch * (column, row)
        if picture.line:
            _two_lines(picture, at, width, fonts)
        else:
            _title_and_caption(picture, at, width, heading, fonts)
        pixel = _picture(picture, size, at, extent, heading)
        answer = answer if pixel is None else GridAnswer(number, pixel)
    imgui.set_cursor_screen_pos(corner)
    imgui.dummy((room.x, -(-len(pictures) // columns) * pitch.y - gap))
    return answer


def _below_captions(
    pictures: Sequence[GridPicture], size: tuple[int, int], room: ImVec2, fonts: Fonts
) -> tuple[float, int, ImVec2]:
    """Return the height of headings that hold their captions, the number of columns, and the size
    of each.
    """
    em, gap = imgui.get_font_size(), GAP_EM * imgui.get_font_size()
    widest = _widest_title(pictures, fonts)
    alone = 0.0  # how wide they are below headings of one line
    for lines in (*range(1, MOST_LINES + 1), 1):  # of the headings; one where none has room
        heading = (HEADING_EM + lines - 1) * em
        columns, extent = _extent(len(pictures), size, room, heading, gap, widest)
        alone = alone or extent.x
        width = max(extent.x, widest)
        if extent.x >= LEAST_PART * alone and all(
            _lines(picture, width, fonts) <= lines for picture in pictures
        ):
            break
    return heading, columns, extent


def _widest_title(pictures: Sequence[GridPicture], fonts: Fonts) -> float:
    with lettering(fonts.bold):
        return max(float(imgui.calc_text_size(picture.title).x) for picture in pictures)


def _extent(
    count: int, size: tuple[int, int], room: ImVec2, heading: float, gap: float, least: float
) -> tuple[int, ImVec2]:
    """Return the number of columns and the size of each picture. least: the width of a column."""
    scale = framebuffer_scale()
    columns, width = columns_for(count, size[0] / size[1], (room.x, room.y), heading, gap, least)
    unit = width * scale / size[0]  # framebuffer pixels of a picture's pixel
    unit = float(int(unit)) if unit >= 4 else unit  # whole, so that all have the same size
    return columns, ImVec2(*size) * unit / scale


def _lines(picture: GridPicture, width: float, fonts: Fonts) -> int:
    """Return the number of lines of a picture's heading.

    One if the caption fits next to the title; otherwise it goes below.
    """
    if not picture.caption:
        return 1
    left = width - _title_px(picture, fonts)
    if imgui.calc_text_size(picture.caption).x <= left:
        return 1
    if max(imgui.calc_text_size(word).x for word in picture.caption.split()) > width:
        return MOST_LINES + 1
    below = imgui.calc_text_size(picture.caption, wrap_width=max(width, 1.0)).y
    return 1 + round(below / imgui.get_text_line_height())


def _title_px(picture: GridPicture, fonts: Fonts) -> float:
    """Return the width of the title and the gap to its caption."""
    if not picture.title:
        return 0.0
    em = imgui.get_font_size()
    with lettering(fonts.bold):
        return float(imgui.calc_text_size(picture.title + " ").x) + 0.3 * em


def _two_lines(picture: GridPicture, at: ImVec2, width: float, fonts: Fonts) -> None:
    draw, em = imgui.get_window_draw_list(), imgui.get_font_size()
    with lettering(fonts.bold):
        draw.add_text(at, theme.u32(theme.TEXT), fitting_words(picture.title, width))
    below = at + ImVec2(0, HEADING_EM * em)
    draw.add_text(below, theme.u32(theme.DIM), fitting_words(picture.line, width))


def _title_and_caption(
    picture: GridPicture, at: ImVec2, width: float, heading: float, fonts: Fonts
) -> None:
    draw, em = imgui.get_window_draw_list(), imgui.get_font_size()
    with lettering(fonts.bold):
        draw.add_text(at, theme.u32(theme.TEXT), fitting_words(picture.title, width))
    wide = _title_px(picture, fonts)
    if picture.caption and heading > HEADING_EM * em and _lines(picture, width, fonts) > 1:
        imgui.set_cursor_screen_pos(at + ImVec2(0, 1.15 * em))
        imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + width)
        imgui.text_colored(theme.DIM, picture.caption)
        imgui.pop_text_wrap_pos()
    elif picture.caption and wide < width:
        caption = fitting_words(picture.caption, width - wide)
        draw.add_text(at + ImVec2(wide, 0), theme.u32(theme.DIM), caption)


def _picture(
    picture: GridPicture, size: tuple[int, int], at: ImVec2, extent: ImVec2, heading: float
) -> Pixel | None:
    """Draw one picture. Return the clicked pixel, or None."""
    draw, scale = imgui.get_window_draw_list(), framebuffer_scale()
    low = ImVec2(int(at.x * scale), int((at.y + heading) * scale)) / scale
    high = low + extent
    imgui.set_cursor_screen_pos(low)
    clicked = press_area(picture.name, ImVec2(max(extent.x, 1.0), max(extent.y, 1.0)))
    walked = walked_pixel(picture.pixel, size)
    if picture.tip:
        tip(picture.tip)
    if picture.texture is not None:
        draw.add_image(imgui.ImTextureRef(picture.texture.glo), low, high)
    else:
        draw.add_rect_filled(low, high, theme.u32(theme.FRAME))
    color, width = picture.frame or theme.LINE, theme.px(4 if picture.frame else 1)
    if imgui.is_item_hovered() or imgui.is_item_focused():
        color, width = picture.frame or theme.ACCENT, theme.px(3)
    outside = ImVec2(width, width) / 2
    draw.add_rect(low - outside, high + outside, theme.u32(color), 0.0, width)
    unit = extent.x / size[0]
    if picture.pixel is not None:  # a frame that is visible however small the pixel is
        half = ImVec2(1, 1) * max(unit, theme.px(6)) / 2
        middle = low + ImVec2(picture.pixel[1] + 0.5, picture.pixel[0] + 0.5) * unit
        near, far = middle - half, middle + half
        draw.add_rect(near, far, theme.u32(theme.rgb("#000000", 0.8)), 0.0, theme.px(4))
        draw.add_rect(near, far, theme.u32(theme.MARK), 0.0, theme.px(2))
    return walked or (pressed_pixel(low, unit, size) if clicked else None)
