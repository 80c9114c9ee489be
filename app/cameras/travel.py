"""The camera under way from one view to another, while the window's frames go on.

Owns the passage under way and its clock. Knows nothing of widgets; the path is animation.py's.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from dataclasses import replace

from app.cameras.animation import Passage
from app.cameras.focus import Focus
from app.state import AppState, is_orthonormal

DURATION_S = 0.5


class Traveller:
    """now_s: the clock, in seconds. instant: passages end at once (pictures, tests).

    What else changes the view (a drag, a key, undo) ends the passage where it is.
    """

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self.now_s = now_s
        self.instant = False
        self._number = 0
        self._passage: Passage | None = None
        self._target: AppState | None = None
        self._latest: AppState | None = None
        self._began_s = 0.0

    @property
    def gesture(self) -> Hashable:
        """What all steps of the passage have in common: they are one step of undo."""
        return ("passage", self._number)

    @property
    def under_way(self) -> bool:
        return self._passage is not None

    def begin(
        self, state: AppState, target: AppState, focus: Focus, size: tuple[int, int]
    ) -> AppState:
        """Sets out for the target's view; gives the state to show now.

        That is the target itself where there is nothing to see on the way: another scene, a
        mirrored camera, or a user who wants no motion.
        """
        self.stop()
        if (
            self.instant
            or state.preferences.reduced_motion
            or state.scene is not target.scene
            or state.view == target.view
            or not min(size)
        ):
            return target
        passage = Passage(state.view, target.view, focus.center, focus.bounds, size)
        if not passage.possible:
            return target
        self._number += 1
        self._passage, self._target, self._began_s = passage, target, self.now_s()
        self._latest = state
        return state

    def step(self, state: AppState) -> AppState:
        """Where the camera is now: `state` with another view; itself if nothing is under way."""
        passage, target, latest = self._passage, self._target, self._latest
        if passage is None or target is None or latest is None:
            return state
        if state.view != latest.view or state.scene is not latest.scene:
            self.stop()
            return state
        part = (self.now_s() - self._began_s) / DURATION_S
        view, keep = passage.at(part), target.keep_orthonormal
        if part >= 1:
            self.stop()
        else:
            keep = state.keep_orthonormal and is_orthonormal(view.camera)
        self._latest = replace(state, view=view, keep_orthonormal=keep)
        return self._latest

    def stop(self) -> None:
        """Ends the passage where it is."""
        self._passage = self._target = self._latest = None
