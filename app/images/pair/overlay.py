"""Text over an image: the channel's legend, the magnification, a note.

They are dark boxes in the lower corners, legible on any image.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.images.placement import magnification_text
from lucida.app.images.screen import Screen
from lucida.app.state.app_state import AppState
from lucida.app.ui import palettes, theme
from lucida.renderer.images.display import ID_PALETTE
from lucida.renderer.images.shared_numbers import FARTHEST_GRAY

BOX = theme.rgb("#0c0d0f", 0.9)
TEXT = theme.rgb("#e8eaed")
DIM = theme.rgb("#b4bac2")
ERROR = palettes.DARK.ERROR
MARGIN = 8.0
PADDING = 6.0
BAR = 84.0  # of the depth's legend
MOST_NAMES = 6
# The normal's components and their colours.
NORMAL = (("normal x", "#ff7a6b"), ("normal y", "#6fd36f"), ("normal z", "#7aa8ff"))


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
        _column(draw, screen, [(axis, theme.rgb(color)) for axis, color in NORMAL])
    elif channel == "id":
        objects = state.scene.visible
        words = [(entry.name or f"object {k}", _palette(k)) for k, entry in objects[:MOST_NAMES]]
        if len(objects) > MOST_NAMES:
            words.append((f"and {len(objects) - MOST_NAMES} more", DIM))
        _column(draw, screen, words)


def draw_magnification(draw: imgui.ImDrawList, screen: Screen, state: AppState) -> None:
    """Draw the magnification in the lower right corner if it is not the window's."""
    if state.images.magnification is None and state.images.resolution is None:
        return
    text = magnification_text(screen.placement.magnification)
    width = imgui.calc_text_size(text).x + 2 * PADDING
    low = _corner(draw, screen, width, imgui.get_font_size() + 2 * PADDING, right=True)
    if low is not None:
        draw.add_text(ImVec2(low.x + PADDING, low.y + PADDING), theme.u32(TEXT), text)


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
    low = _corner(draw, screen, width, size + 2 * PADDING)
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


def _column(draw: imgui.ImDrawList, screen: Screen, words: list[tuple[str, ImVec4]]) -> None:
    """Draw each word on a line of its own, with a square of its colour."""
    size = imgui.get_font_size()
    line = size + 3
    width = max((imgui.calc_text_size(text).x for text, _ in words), default=0.0)
    height = line * len(words) + 2 * PADDING - 3
    low = _corner(draw, screen, width + size + 3 * PADDING, height)
    if low is None:
        return
    for k, (text, color) in enumerate(words):
        x, y = low.x + PADDING, low.y + PADDING + k * line
        square = ImVec2(x + size - 3, y + size - 1)
        draw.add_rect_filled(ImVec2(x + 1, y + 3), square, theme.u32(color))
        draw.add_text(ImVec2(x + size + PADDING, y), theme.u32(TEXT), text)


def _corner(
    draw: imgui.ImDrawList, screen: Screen, width: float, height: float, right: bool = False
) -> ImVec2 | None:
    """Draw a dark box in the lower left or right corner. Return its upper left corner, or None if
    it would leave too little of a small image free.
    """
    start, end = screen.pane
    if width + 2 * MARGIN >= 0.8 * (end.x - start.x) or height >= 0.5 * (end.y - start.y):
        return None
    left = end.x - MARGIN - width if right else start.x + MARGIN
    low = ImVec2(left, end.y - MARGIN - height)
    draw.add_rect_filled(low, ImVec2(low.x + width, low.y + height), theme.u32(BOX), 4.0)
    return low


def _palette(number: int) -> ImVec4:
    red, green, blue = (int(v) / 255 for v in ID_PALETTE[number % len(ID_PALETTE)])
    return ImVec4(red, green, blue, 1.0)
