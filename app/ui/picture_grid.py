"""Small pictures side by side with headings, as large as possible and with sharp pixels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import moderngl
from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.state.options.shared import Pixel

from . import theme
from .areas import press_area
from .canvas import pressed_pixel, walked_pixel
from .lettering import fitting_words, lettering
from .rows import tip
from .theme import Fonts, framebuffer_scale

HEADING_EM = 1.3
GAP_EM = 0.7


@dataclass(frozen=True)
class GridPicture:
    """A picture of the grid.

    name: ImGui's id.
    title, caption: the heading; the title is bold. The caption is next to it, shortened if
    necessary, and in a tooltip.
    texture: None if there is none yet.
    frame: a colour for its frame; None for the usual line.
    pixel: the marked pixel.
    """

    name: str
    title: str
    texture: moderngl.Texture | None
    caption: str = ""
    frame: ImVec4 | None = None
    pixel: Pixel | None = None


def columns_for(
    count: int,
    aspect: float,
    room: tuple[float, float],
    heading: float,
    gap: float,
    least: float = 0.0,
) -> tuple[int, float]:
    """Return the number of columns that makes the pictures largest, and the width of each.

    aspect: width / height of a picture. heading: the height above each. least: the least width of
    a column, unless there is only one. Lengths are in the unit of `room`.
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
) -> Pixel | None:
    """Draw the pictures at the cursor, within `room`. Return the clicked pixel, or None.

    size: (width, height) of each picture, in pixels of its own.
    """
    em, gap = imgui.get_font_size(), GAP_EM * imgui.get_font_size()
    with lettering(fonts.bold):
        titles = [float(imgui.calc_text_size(f"{picture.title} ").x) for picture in pictures]
    heading, widest = HEADING_EM * em, max(titles)
    scale = framebuffer_scale()
    columns, across = columns_for(
        len(pictures), size[0] / size[1], (room.x, room.y), heading, gap, widest
    )
    unit = across * scale / size[0]  # framebuffer pixels per picture pixel
    unit = float(int(unit)) if unit >= 4 else unit  # whole, so that all have the same size
    extent = ImVec2(*size) * unit / scale
    corner, answer = imgui.get_cursor_screen_pos(), None
    width = max(extent.x, min(widest, (room.x - gap * (columns - 1)) / columns))
    pitch = ImVec2(width, extent.y) + ImVec2(gap, heading + gap)
    draw = imgui.get_window_draw_list()
    for number, picture in enumerate(pictures):
        row, column = divmod(number, columns)
        at = corner + pitch * (column, row)
        with lettering(fonts.bold):
            draw.add_text(at, theme.u32(theme.TEXT), fitting_words(picture.title, width))
        caption = fitting_words(picture.caption, width - titles[number])
        draw.add_text(at + ImVec2(titles[number], 0), theme.u32(theme.DIM), caption)
        answer = _picture(picture, size, at, extent, heading) or answer
    imgui.set_cursor_screen_pos(corner)
    imgui.dummy((room.x, -(-len(pictures) // columns) * pitch.y - gap))
    return answer


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
    if picture.caption:
        tip(picture.caption)
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
