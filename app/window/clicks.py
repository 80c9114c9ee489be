"""Double clicks while frames are slow.

ImGui takes one change of a mouse button a frame and measures a double click by its frames' times:
where a frame takes longer than a click, the second click comes two frames after the first, too
late, and a number typed after it would be shortcuts. Knows nothing of windows.
"""

from __future__ import annotations

from collections import deque

from imgui_bundle import imgui

DOUBLE_CLICK_S = 0.3  # ImGui's own


class ClickTime:
    """A double click's time: its own, and what the last two frames took."""

    def __init__(self) -> None:
        self._took_s: deque[float] = deque(maxlen=2)
        self._began_s = 0.0

    def begin_frame(self, now_s: float) -> None:
        """Call before ImGui takes the events of a frame."""
        self._began_s = now_s
        io = imgui.get_io()
        io.mouse_double_click_time = DOUBLE_CLICK_S + sum(self._took_s)
        io.mouse_single_click_delay = 2 * io.mouse_double_click_time  # ImGui wants it to be longer

    def end_frame(self, now_s: float) -> None:
        """Call when a frame has been shown, before it waits for the next event."""
        self._took_s.append(now_s - self._began_s)
