"""The note over an image that is black or shows nothing: why, and a button that helps.

Owns its place and look. Whether there is one, and what the button does, is asked elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from lucida.app.images.screen import Box, Screen
from lucida.app.ui import theme
from lucida.app.ui.areas import press_area

PADDING_EM, GAP_EM = 0.8, 0.5
BOX, TEXT = theme.rgb("#0c0d0f", 0.85), theme.rgb("#e8eaed")


@dataclass(frozen=True)
class DarkNote:
    """text: why. remedy: on the button; empty: there is none."""

    text: str
    remedy: str = ""


@dataclass(frozen=True)
class _Places:
    box: Box
    text: ImVec2
    wrap: float
    button: Box | None


def note_button(note: DarkNote, screen: Screen) -> bool:
    """Draw the button, an item that takes the mouse before the image does. Return True if it
    was pressed.

    Call it in the image's window, before the image.
    """
    button = _places(note, screen).button
    if button is None:
        return False
    low, high = button
    imgui.set_cursor_screen_pos(low)
    return press_area(note.remedy, ImVec2(high.x - low.x, high.y - low.y))


def draw_dark_note(draw: imgui.ImDrawList, note: DarkNote, screen: Screen) -> None:
    """Draw the note in the middle of the image."""
    places = _places(note, screen)
    font, size = imgui.get_font(), imgui.get_font_size()
    draw.push_clip_rect(*screen.pane, True)
    draw.add_rect_filled(*places.box, theme.u32(BOX), 4.0)
    draw.add_text(font, size, places.text, theme.u32(TEXT), note.text, wrap_width=places.wrap)
    if places.button is not None:
        low, high = places.button
        is_over = imgui.is_mouse_hovering_rect(low, high)
        held = is_over and imgui.is_mouse_down(imgui.MouseButton_.left)
        kind = imgui.Col_.button_active if held else imgui.Col_.button_hovered
        draw.add_rect_filled(
            low, high, imgui.get_color_u32(kind if is_over else imgui.Col_.button), 3.0
        )
        wide = imgui.calc_text_size(note.remedy)
        at = ImVec2((low.x + high.x - wide.x) / 2, (low.y + high.y - wide.y) / 2)
        draw.add_text(at, imgui.get_color_u32(imgui.Col_.text), note.remedy)
    draw.pop_clip_rect()


def _places(note: DarkNote, screen: Screen) -> _Places:
    """Return the places of the parts, in the middle of the visible image."""
    low, high = screen.visible
    em = imgui.get_font_size()
    padding = PADDING_EM * em
    wrap = max(4 * em, 0.8 * (high.x - low.x))
    text = imgui.calc_text_size(note.text, wrap_width=wrap)
    label = imgui.calc_text_size(note.remedy) if note.remedy else ImVec2(0, 0)
    wide, tall = label.x + 2 * padding, label.y + padding
    height = text.y + ((GAP_EM * em + tall) if note.remedy else 0.0)
    width = max(text.x, wide if note.remedy else 0.0)
    x, y = (low.x + high.x) / 2, (low.y + high.y - height) / 2
    box = (
        ImVec2(x - width / 2 - padding, y - padding),
        ImVec2(x + width / 2 + padding, y + height + padding),
    )
    button = None
    if note.remedy:
        top = y + text.y + GAP_EM * em
        button = ImVec2(x - wide / 2, top), ImVec2(x + wide / 2, top + tall)
    return _Places(box, ImVec2(x - text.x / 2, y), wrap, button)
