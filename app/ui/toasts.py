"""Notifications: a completed action, in a corner, for some seconds.

Errors that must be answered are in ui/messages.py.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

from imgui_bundle import imgui

from lucida.renderer.system.errors import one_line

from . import theme
from .messages import box_width, overlay, wrapped

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

    def clear(self) -> None:
        self._toasts = []

    def draw(self) -> None:
        """Draw the toasts above one another, the newest in the lower right corner."""
        now_s, em = time.monotonic(), imgui.get_font_size()
        self._toasts = [toast for toast in self._toasts if toast.end_s > now_s]
        viewport, flags = imgui.get_main_viewport(), imgui.WindowFlags_
        passive = flags.no_inputs | flags.no_nav | flags.no_focus_on_appearing
        corner = viewport.work_pos + viewport.work_size - (em, 3 * em)
        for number, toast in enumerate(reversed(self._toasts)):
            edge = theme.GOOD if toast.good else theme.ERROR
            name, width = f"##toast{number}", box_width(WIDTH_EM, 0.8)
            with overlay(name, corner, (1, 1), width, edge, int(passive)):
                wrapped(toast.text)
                corner.y -= imgui.get_window_height() + 0.5 * em
