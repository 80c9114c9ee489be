"""A camera in transition from one view to another while the window draws frames: the camera of both
images, or the outside view's own.

The module keeps the current passage and its clock; animation.py computes the path.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace

from lucida.app.state.app_state import AppState, is_orthonormal
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.model import View

from .animation import Passage

DURATION_S = 0.5


@dataclass(frozen=True)
class Ends:
    """The outside view's camera before and after, as used there: a state may leave it to the view.

    size: that view's, (width, height).
    of: returns the camera in a state.
    put: returns the state with another camera.
    """

    start: Camera
    end: Camera
    size: tuple[int, int]
    of: Callable[[AppState], Camera | None]
    put: Callable[[AppState, Camera | None], AppState]


class CameraTransition:
    """A transition between cameras. Any other change of the view (a drag, a key, undo) ends it
    where it is.

    now_s: the clock, in seconds.
    instant: True if transitions end at once (pictures, tests).
    """

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self.now_s = now_s
        self.instant = False
        self._number = 0
        self._passage: Passage | None = None
        self._target: AppState | None = None
        self._latest: AppState | None = None
        self._outside: Ends | None = None
        self._began_s = 0.0

    @property
    def gesture(self) -> Hashable:
        """Return the key that joins all steps of a transition into one undo step."""
        return ("passage", self._number)

    @property
    def under_way(self) -> bool:
        return self._passage is not None

    def begin(
        self,
        state: AppState,
        target: AppState,
        focus: Focus,
        size: tuple[int, int],
        outside: Ends | None = None,
    ) -> AppState:
        """Start towards the target's view, or towards its outside camera if the ends are given.
        Return the state to show now.

        Return the target itself if there is nothing to see in between: another scene, a mirrored
        camera, or a user who wants no motion.
        size: the images' size.
        """
        self.stop()
        start, end = state.view, target.view
        if outside is not None:
            start, end, size = View(outside.start), View(outside.end), outside.size
        if (
            self.instant
            or state.preferences.reduced_motion
            or state.scene is not target.scene
            or start == end
            or not min(size)
        ):
            return target
        passage = Passage(start, end, focus.center, size)
        if not passage.possible:
            return target
        self._number += 1
        self._passage, self._target, self._began_s = passage, target, self.now_s()
        self._latest, self._outside = state, outside
        return state

    def step(self, state: AppState) -> AppState:
        """Return `state` with the current camera, or with that of the outside view; unchanged if
        there is no transition.
        """
        passage, target, latest = self._passage, self._target, self._latest
        if passage is None or target is None or latest is None:
            return state
        if self._seen(state) != self._seen(latest) or state.scene is not latest.scene:
            self.stop()
            return state
        part = (self.now_s() - self._began_s) / DURATION_S
        view, there = passage.at(part), part >= 1
        outside = self._outside
        if outside is not None:
            self._latest = outside.put(state, outside.of(target) if there else view.camera)
        else:
            keep = state.keep_orthonormal and is_orthonormal(view.camera)
            keep = target.keep_orthonormal if there else keep
            self._latest = replace(state, view=view, keep_orthonormal=keep)
        found = self._latest
        if there:
            self.stop()
        return found

    def _seen(self, state: AppState) -> View | Camera | None:
        """Return the values that nothing else may change during the transition."""
        return state.view if self._outside is None else self._outside.of(state)

    def stop(self) -> None:
        """End the transition where it is."""
        self._passage = self._target = self._latest = None
