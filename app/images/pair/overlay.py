"""Text over an image, in dark boxes that are legible on any image: the channel's legend, a note."""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

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
MOST_NAMES = 6
# The normal's components and their colours.
NORMAL = (("normal x", "#ff7a6b"), ("normal y", "#6fd36f"), ("normal z", "#7aa8ff"))


def draw_legend(
    draw: imgui.ImDrawList, screen: Screen, state: AppState, depths: tuple[float, float] | None
) -> None:
    """Draw the meaning of a channel's colours in the lower left corner of the window: a line for
    each word, with a square of its colour.
    """
    words: list[tuple[str, ImVec4]] = []
    channel, objects = state.images.channel, state.scene.visible
    if depths is not None:
        letter, (near, far) = "z" if channel == "z" else "t", depths
        gray = ImVec4(FARTHEST_GRAY, FARTHEST_GRAY, FARTHEST_GRAY, 1)
        words = [(f"{letter} = {near:.4g}", theme.rgb("#ffffff")), (f"{letter} = {far:.4g}", gray)]
    elif channel == "normal":
        words = [(axis, theme.rgb(color)) for axis, color in NORMAL]
    elif channel == "id":
        words = [(entry.name or f"object {k}", _palette(k)) for k, entry in objects[:MOST_NAMES]]
        if len(objects) > MOST_NAMES:
            words.append((f"and {len(objects) - MOST_NAMES} more", DIM))
    size = imgui.get_font_size()
    line = size + 3
    width = max((imgui.calc_text_size(text).x for text, _ in words), default=0.0)
    height = line * len(words) + 2 * PADDING - 3
    low = _corner(draw, screen, width + size + 3 * PADDING, height) if words else None
    if low is None:
        return
    for k, (text, color) in enumerate(words):
        at = low + ImVec2(PADDING, PADDING + k * line)
        square = at + ImVec2(1, 3), at + ImVec2(size - 3, size - 1)
        draw.add_rect_filled(*square, theme.u32(color))
        draw.add_text(at + ImVec2(size + PADDING, 0), theme.u32(TEXT), text)


def draw_note(draw: imgui.ImDrawList, screen: Screen, note: str, is_error: bool) -> None:
    """Draw a line or two of text in the middle of the image, which is darkened."""
    origin, far = screen.visible
    draw.add_rect_filled(origin, far, theme.u32(theme.rgb("#000000", 0.5)))  # it is outdated
    wrap = max(60.0, (far.x - origin.x) * 0.8)
    size = imgui.calc_text_size(note, wrap_width=wrap)
    at, pad = (origin + far - size) / 2, ImVec2(12, 8)
    draw.add_rect_filled(at - pad, at + size + pad, theme.u32(BOX), 4.0)
    color = theme.u32(ERROR if is_error else TEXT)
    draw.add_text(imgui.get_font(), imgui.get_font_size(), at, color, note, wrap_width=wrap)


def _corner(draw: imgui.ImDrawList, screen: Screen, width: float, height: float) -> ImVec2 | None:
    """Draw a dark box in the lower left corner. Return its upper left corner, or None if
    it would leave too little of a small image free.
    """
    start, end = screen.pane
    if width + 2 * MARGIN >= 0.8 * (end.x - start.x) or height >= 0.5 * (end.y - start.y):
        return None
    low = ImVec2(start.x + MARGIN, end.y - MARGIN - height)
    draw.add_rect_filled(low, low + ImVec2(width, height), theme.u32(BOX), 4.0)
    return low


def _palette(number: int) -> ImVec4:
    red, green, blue = (int(v) / 255 for v in ID_PALETTE[number % len(ID_PALETTE)])
    return ImVec4(red, green, blue, 1.0)
