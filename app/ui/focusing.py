"""Deliver letters typed right after Tab to the field that Tab leads to.

ImGui focuses a field in the frame after the request and drops the letters of that frame: of
`1 Tab 13`, typed during a slow frame, the second 1 would be lost. Here the events wait until the
field has the keyboard.
"""

from __future__ import annotations

import math

from imgui_bundle import hello_imgui, imgui

_FLAGS = imgui.internal.NavMoveFlags_
_TO_A_FIELD = int(_FLAGS.is_tabbing) | int(_FLAGS.focus_api)


class Focusing:
    """A buffer that holds back the events of one window."""

    def __init__(self) -> None:
        self._held: imgui.ImVector_InputEvent | None = None
        self._repeat_delay_s = 0.0
        self._has_held = False  # in the previous frame; never hold twice in a row

    def before_frame(self) -> None:
        """Remove the events if a field will get the keyboard. Call between two frames."""
        context, io = imgui.get_current_context(), imgui.get_io()
        if self._has_held:
            io.key_repeat_delay = self._repeat_delay_s
        is_asked = context.nav_move_submitted and context.nav_move_flags & _TO_A_FIELD
        self._has_held = bool(is_asked) and not self._has_held
        if self._has_held:
            self._held = _copy(context.input_events_queue)
            context.input_events_queue.clear()
            # The release of Tab waits, too: in a slow frame, Tab would repeat.
            self._repeat_delay_s, io.key_repeat_delay = io.key_repeat_delay, math.inf

    def begin_frame(self) -> None:
        """Queue the events for the next frame, before newer ones. Call when a frame has begun."""
        if self._held is None:
            return
        queue = imgui.get_current_context().input_events_queue
        since = _copy(queue)
        queue.clear()
        for event in (*self._held, *since):
            queue.push_back(event)
        if queue.size():
            hello_imgui.request_refresh()
        self._held = None


def _copy(events: imgui.ImVector_InputEvent) -> imgui.ImVector_InputEvent:
    copy = type(events)()
    for event in events:
        copy.push_back(event)
    return copy
