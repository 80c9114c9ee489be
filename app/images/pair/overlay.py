"""Text over an image: the channel's legend, the magnification, a note.

They are dark boxes in the lower corners, legible on any image.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, ImVec4, imgui

from app.images.placement import magnification_text
from app.images.screen import Screen
from app.state.app_state import AppState
from app.ui import theme
from renderer.images.display import ID_PALETTE
from renderer.images.shared_numbers import FARTHEST_GRAY

BOX = theme.rgb("#0c0d0f", 0.9)
TEXT = theme.rgb("#e8eaed")
DIM = theme.rgb("#b4bac2")
ERROR = theme.DARK.ERROR
MARGIN = 8.0
PADDING = 6.0
BAR = 84.0  # of the depth's legend
MAP = 72.0  # the longer side of the map of a magnified image
SEEN = 5.0  # the least side of the frame in it
MOST_NAMES = 6
NORMAL = (("x", "#ff7a6b"), ("y", "#6fd36f"), ("z", "#7aa8ff"))


def draw_legend(
    draw: imgui.ImDrawList,
    screen: Screen,
    state: AppState,
    depths: tuple[float, float] | None,
    fonts: theme.Fonts,
) -> None:
    """Draw the meaning of a channel's colours in the lower left corner of the window."""
    channel = state.images.channel
    if channel == "depth":
        _depth_legend(draw, screen, depths, fonts)
    elif channel == "normal":
        _words(draw, screen, [("normal", TEXT), *((n, theme.rgb(c)) for n, c in NORMAL)], fonts)
    elif channel == "id":
        objects = state.scene.visible
        words = [(entry.name or f"object {k}", _palette(k)) for k, entry in objects[:MOST_NAMES]]
        if len(objects) > MOST_NAMES:
            words.append((f"and {len(objects) - MOST_NAMES} more", DIM))
        _column(draw, screen, words)


def draw_corner(
    draw: imgui.ImDrawList,
    screen: Screen,
    state: AppState,
    whole: Callable[[tuple[int, int]], int | None],
) -> None:
    """Draw the magnification if it is not the window's, and a map if not all of the image is
    visible.

    whole: returns a texture of the whole image, of a size in framebuffer pixels.
    """
    placement, options = screen.placement, state.images
    if options.magnification is None and options.resolution is None:
        return
    text, size = magnification_text(placement.magnification), imgui.get_font_size()
    wide = imgui.calc_text_size(text).x
    extent, pixels = (0.0, 0.0), [0, 0]
    if not placement.sees_all:
        longest = max(placement.size)
        side = round(theme.px(MAP) * screen.scale)
        pixels = [max(1, round(side * part / longest)) for part in placement.size]
        extent = (pixels[0] / screen.scale, pixels[1] / screen.scale)
    width = max(wide, extent[0]) + 2 * PADDING
    height = size + 2 * PADDING + (extent[1] + PADDING if extent[1] else 0)
    if not _fits(screen, width, height):
        return
    _, end = screen.pane
    low = ImVec2(end.x - MARGIN - width, end.y - MARGIN - height)
    draw.add_rect_filled(low, ImVec2(low.x + width, low.y + height), theme.u32(BOX), 4.0)
    if extent[1]:
        corner = ImVec2(low.x + (width - extent[0]) / 2, low.y + PADDING)
        _map(draw, corner, extent, placement.visible_parts, whole((pixels[0], pixels[1])))
    at = ImVec2(low.x + (width - wide) / 2, low.y + height - PADDING - size)
    draw.add_text(at, theme.u32(TEXT), text)


def draw_note(draw: imgui.ImDrawList, screen: Screen, note: str, is_error: bool) -> None:
    """Draw a line or two of text in the middle of the image, which is darkened."""
    origin, far = screen.visible
    draw.add_rect_filled(origin, far, theme.u32(theme.rgb("#000000", 0.5)))  # it is not of now
    _boxed(draw, screen, note, theme.u32(ERROR if is_error else TEXT))


def draw_told(draw: imgui.ImDrawList, screen: Screen, text: str, is_error: bool) -> None:
    """Draw the note on a photograph at the image's upper edge."""
    color = ERROR if is_error else TEXT
    draw.push_clip_rect(*screen.pane, True)
    _boxed(draw, screen, text, theme.u32(color), at_the_top=True)
    draw.pop_clip_rect()


def _boxed(
    draw: imgui.ImDrawList, screen: Screen, text: str, color: int, at_the_top: bool = False
) -> None:
    origin, far = screen.visible
    wrap = max(60.0, (far.x - origin.x) * 0.8)
    size = imgui.calc_text_size(text, wrap_width=wrap)
    top = origin.y + 16 if at_the_top else (origin.y + far.y - size.y) / 2
    at = ImVec2((origin.x + far.x - size.x) / 2, top)
    low, high = ImVec2(at.x - 12, at.y - 8), ImVec2(at.x + size.x + 12, at.y + size.y + 8)
    draw.add_rect_filled(low, high, theme.u32(theme.rgb("#0c0d0f", 0.85)), 4.0)
    draw.add_text(imgui.get_font(), imgui.get_font_size(), at, color, text, wrap_width=wrap)


def _depth_legend(
    draw: imgui.ImDrawList,
    screen: Screen,
    depths: tuple[float, float] | None,
    fonts: theme.Fonts,
) -> None:
    size, mono = imgui.get_font_size(), fonts.mono or imgui.get_font()
    imgui.push_font(mono, 0.0)
    near, far = (f"{t:.4g}" for t in depths) if depths is not None else ("", "")
    widths = [imgui.calc_text_size(text).x for text in ("t", near, far)]
    imgui.pop_font()
    width = sum(widths) + BAR + 3 * PADDING + 2 * PADDING
    low = _lower_left(draw, screen, width, size + 2 * PADDING)
    if low is None:
        return
    x, y = low.x + PADDING, low.y + PADDING
    draw.add_text(mono, size, ImVec2(x, y), theme.u32(DIM), "t")
    x += widths[0] + PADDING
    if depths is None:
        draw.add_text(ImVec2(x, y), theme.u32(DIM), "nothing is hit")
        return
    draw.add_text(mono, size, ImVec2(x, y), theme.u32(TEXT), near)
    x += widths[1] + PADDING
    white, gray = (imgui.color_convert_float4_to_u32((v, v, v, 1.0)) for v in (1.0, FARTHEST_GRAY))
    draw.add_rect_filled_multi_color(
        ImVec2(x, y + 1), ImVec2(x + BAR, y + size - 1), white, gray, gray, white
    )
    x += BAR + PADDING
    draw.add_text(mono, size, ImVec2(x, y), theme.u32(TEXT), far)


def _words(
    draw: imgui.ImDrawList,
    screen: Screen,
    words: list[tuple[str, ImVec4]],
    fonts: theme.Fonts,
) -> None:
    size, bold = imgui.get_font_size(), fonts.bold or imgui.get_font()
    imgui.push_font(bold, 0.0)
    widths = [imgui.calc_text_size(text).x for text, _ in words]
    imgui.pop_font()
    width = sum(widths) + 2 * PADDING + 8.0 * (len(words) - 1)
    low = _lower_left(draw, screen, width, size + 2 * PADDING)
    if low is None:
        return
    x = low.x + PADDING
    for (text, color), wide in zip(words, widths, strict=True):
        at = ImVec2(x, low.y + PADDING)
        draw.add_text(bold, size, at, theme.u32(color), text)
        x += wide + 8.0


def _column(draw: imgui.ImDrawList, screen: Screen, words: list[tuple[str, ImVec4]]) -> None:
    """Draw each word on a line of its own, with a square of its colour."""
    size = imgui.get_font_size()
    line = size + 3
    width = max((imgui.calc_text_size(text).x for text, _ in words), default=0.0)
    height = line * len(words) + 2 * PADDING - 3
    low = _lower_left(draw, screen, width + size + 3 * PADDING, height)
    if low is None:
        return
    for k, (text, color) in enumerate(words):
        x, y = low.x + PADDING, low.y + PADDING + k * line
        square = ImVec2(x + size - 3, y + size - 1)
        draw.add_rect_filled(ImVec2(x + 1, y + 3), square, theme.u32(color))
        draw.add_text(ImVec2(x + size + PADDING, y), theme.u32(TEXT), text)


def _map(
    draw: imgui.ImDrawList,
    corner: ImVec2,
    extent: tuple[float, float],
    parts: tuple[float, float, float, float],
    texture: int | None,
) -> None:
    """Draw the whole image, with a frame around its visible part."""
    end = ImVec2(corner.x + extent[0], corner.y + extent[1])
    if texture is None:
        draw.add_rect_filled(corner, end, theme.u32(theme.rgb("#ffffff", 0.12)))
    else:
        draw.add_image(imgui.ImTextureRef(texture), corner, end)
    draw.add_rect(corner, end, theme.u32(DIM))
    left, top, right, bottom = parts
    low = ImVec2(corner.x + left * extent[0], corner.y + top * extent[1])
    high = ImVec2(
        max(corner.x + right * extent[0], low.x + SEEN),
        max(corner.y + bottom * extent[1], low.y + SEEN),
    )
    draw.add_rect(low, high, theme.u32(theme.rgb("#000000")), 0.0, 3.5)
    draw.add_rect(low, high, theme.u32(theme.RAY), 0.0, 1.5)


def _lower_left(
    draw: imgui.ImDrawList, screen: Screen, width: float, height: float
) -> ImVec2 | None:
    """Draw a dark box there. Return its corner, or None if the image has no room for it."""
    if not _fits(screen, width, height):
        return None
    start, end = screen.pane
    low = ImVec2(start.x + MARGIN, end.y - MARGIN - height)
    draw.add_rect_filled(low, ImVec2(low.x + width, low.y + height), theme.u32(BOX), 4.0)
    return low


def _fits(screen: Screen, width: float, height: float) -> bool:
    """Return True if a box leaves most of a small image free."""
    start, end = screen.pane
    return width + 2 * MARGIN < 0.8 * (end.x - start.x) and height < 0.5 * (end.y - start.y)


def _palette(number: int) -> ImVec4:
    red, green, blue = (int(v) / 255 for v in ID_PALETTE[number % len(ID_PALETTE)])
    return ImVec4(red, green, blue, 1.0)
