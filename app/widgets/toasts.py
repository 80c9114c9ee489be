"""Notifications: a completed action, in a corner, for some seconds.

Errors that must be answered are in widgets/messages.py.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.widgets import theme
from renderer.errors import one_line

SHOWN_S = 6.0
MOST = 4
WIDTH_EM = 26.0


@dataclass(frozen=True)
class Toast:
    """A notification. good: True for success."""

    text: str
    good: bool
    end_s: float


class Toasts:
    """The notifications of a window. HelloImGui's idle frames are frequent enough to end them."""

    def __init__(self) -> None:
        self._toasts: list[Toast] = []

    @property
    def texts(self) -> list[str]:
        return [toast.text for toast in self._toasts]

    def add(self, text: str, good: bool = True) -> None:
        text = one_line(text)
        kept = [toast for toast in self._toasts if toast.text != text]
        self._toasts = [*kept, Toast(text, good, time.monotonic() + SHOWN_S)][-MOST:]

    def clear(self) -> bool:
        """Remove all toasts. Return True if there were any."""
        had, self._toasts = bool(self._toasts), []
        return had

    def draw(self) -> None:
        now_s = time.monotonic()
        self._toasts = [toast for toast in self._toasts if toast.end_s > now_s]
        viewport = imgui.get_main_viewport()
        em = imgui.get_font_size()
        right = viewport.work_pos.x + viewport.work_size.x - em
        bottom = viewport.work_pos.y + viewport.work_size.y - 3 * em
        for number, toast in enumerate(reversed(self._toasts)):
            bottom -= self._box(number, toast, ImVec2(right, bottom)) + 0.5 * em

    def _box(self, number: int, toast: Toast, corner: ImVec2) -> float:
        """Draw one toast, with its lower right corner here. Return its height."""
        width = min(WIDTH_EM * imgui.get_font_size(), 0.8 * imgui.get_main_viewport().work_size.x)
        imgui.set_next_window_pos(corner, imgui.Cond_.always, ImVec2(1.0, 1.0))
        imgui.set_next_window_size(ImVec2(width, 0))
        imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
        imgui.push_style_color(imgui.Col_.border, theme.GOOD if toast.good else theme.ERROR)
        flags = imgui.WindowFlags_
        imgui.begin(
            f"##toast{number}",
            None,
            flags.no_decoration
            | flags.no_docking
            | flags.no_saved_settings
            | flags.no_move
            | flags.no_inputs
            | flags.no_nav
            | flags.no_focus_on_appearing,
        )
        imgui.push_text_wrap_pos(0.0)
        imgui.text(toast.text)
        imgui.pop_text_wrap_pos()
        height = imgui.get_window_height()
        imgui.end()
        imgui.pop_style_color(2)
        return height
