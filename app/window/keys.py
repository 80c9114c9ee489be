"""The keyboard's events on their way to ImGui, frame by frame.

A frame of ImGui's has one set of modifiers, those at its end, and takes one change of each key:
what comes after waits for the next frame, with whatever modifiers there are then. Where Ctrl is
let go in the frame in which P was pressed (by a remote desktop, a macro pad, or any hand while a
frame is slow), it would see P alone. Owns what waits, so that each key has its own modifiers. Knows
nothing of windows, nor of what keys do.
"""

from __future__ import annotations

from collections.abc import Callable

PRESS, REPEAT = 1, 2  # as GLFW numbers actions
MODIFIERS = range(340, 348)  # and keys: Shift, Ctrl, Alt, Super, left and right
CHARACTER = 1  # the length of an event that is one


class KeyFrames:
    """give: passes a key's event to ImGui, (key, code, action, modifiers) as GLFW reports it.
    write: passes a character, which keeps its place between them.
    """

    def __init__(self, give: Callable[..., None], write: Callable[[int], None]) -> None:
        self._give, self._write = give, write
        self._waiting: list[tuple[int, ...]] = []
        self._changed: set[int] = set()  # keys that were pressed or let go in this frame
        self._pressed = False  # whether one of them was pressed that is no modifier

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
        """Return True if a key's change belongs into this frame, and count it."""
        is_modifier = key in MODIFIERS
        if key in self._changed or (is_modifier and self._pressed):
            return False
        self._changed.add(key)
        self._pressed = self._pressed or (action == PRESS and not is_modifier)
        return True
