"""A movement between two states that the window is showing."""

from __future__ import annotations

import time

from lucida.app.lecture.movement import Movement
from lucida.app.state.app_state import AppState


class Playing:
    """The current movement, if there is one. shown: its state in this frame, or None."""

    def __init__(self) -> None:
        self.shown: AppState | None = None
        self._movement: Movement | None = None
        self._began_s = self._takes_s = 0.0
        self._loops = False

    @property
    def under_way(self) -> bool:
        return self._movement is not None

    def begin(self, movement: Movement, takes_s: float, loop: bool) -> None:
        """Begin a movement that takes some seconds. loop: True to repeat it."""
        self._movement, self.shown = movement, movement.at(0.0)
        self._began_s, self._takes_s, self._loops = time.monotonic(), takes_s, loop

    def end(self) -> bool:
        """End the movement. Return True if one was under way that would have ended by itself."""
        would_end = self.under_way and not self._loops
        self._movement = self.shown = None
        return would_end

    def frame(self, is_pressed: bool) -> None:
        """Show the movement's state in this frame. is_pressed: True to end it, by the mouse."""
        if self._movement is None:
            return
        part = (time.monotonic() - self._began_s) / self._takes_s
        if is_pressed or (part >= 1 and not self._loops):
            self.end()
        else:
            self.shown = self._movement.at(part % 1, eased=not self._loops)
