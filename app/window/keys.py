"""Pass keyboard events to ImGui, frame by frame.

An ImGui frame has one set of modifiers, those at its end, and accepts one change of each key. Later
changes wait for the next frame and get its modifiers. If Ctrl is released in the frame in which P
was pressed (by a remote desktop, a macro pad, or anybody during a slow frame), ImGui would see P
alone. This module therefore keeps the waiting events, so that each key has its own modifiers. It is
independent of windows and of the keys' actions.
"""

from __future__ import annotations

from collections.abc import Callable

PRESS, REPEAT = 1, 2  # as GLFW numbers actions
MODIFIERS = range(340, 348)  # GLFW's keys: Shift, Ctrl, Alt, Super, left and right
CHARACTER = 1  # the length of an event that is one


class KeyFrames:
    """A queue of keyboard events that waits for frames.

    give: passes a key's event to ImGui, (key, code, action, modifiers) as GLFW reports it.
    write: passes a character, in order with the keys.
    """

    def __init__(self, give: Callable[..., None], write: Callable[[int], None]) -> None:
        self._give, self._write = give, write
        self._waiting: list[tuple[int, ...]] = []
        self._changed: set[int] = set()  # keys that were pressed or released in this frame
        self._pressed = False  # whether a key other than a modifier was pressed

    def begin_frame(self) -> None:
        """Pass on waiting events. Call once a frame, when ImGui has taken the earlier ones."""
        waiting, self._waiting = self._waiting, []
        self._changed.clear()
        self._pressed = False
        for event in waiting:
            self.take(*event)

    def take(self, *event: int) -> None:
        """Pass an event on, or let it wait for its frame."""
        is_key = len(event) != CHARACTER
        if is_key and event[2] == REPEAT:
            return  # ImGui repeats keys itself
        if self._waiting or (is_key and not self._fits(event[0], event[2])):
            self._waiting.append(event)
        else:
            (self._give if is_key else self._write)(*event)

    def _fits(self, key: int, action: int) -> bool:
        """Return True if a key's change fits in this frame, and record it."""
        is_modifier = key in MODIFIERS
        if key in self._changed or (is_modifier and self._pressed):
            return False
        self._changed.add(key)
        self._pressed = self._pressed or (action == PRESS and not is_modifier)
        return True
