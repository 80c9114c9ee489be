"""States of the window between two states, as a pure function of time.

Cameras follow the path of animation.py, and floats change in proportion. All other values, such as
switches, words and counts, change when the movement begins.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from lucida.app.cameras.animation import Passage
from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.model import View

SIZE = 16, 9  # of a hidden image


class Movement:
    """A movement from one state to another.

    focus: of the scene. size: (width, height) of the images.
    """

    def __init__(self, start: AppState, end: AppState, focus: Focus, size: tuple[int, int]) -> None:
        self.start, self.end = start, end
        self._focus, self._size = focus, size if min(size) else SIZE
        self._passages: dict[tuple[View, View], Passage] = {}

    def at(self, part: float, eased: bool = True) -> AppState:
        """Return the state at a fraction of the time, 0 to 1; 1 is the end.

        eased: slower at both ends.
        """
        if part >= 1:
            return self.end
        s = part * part * (3 - 2 * part) if eased else part
        view = self._view(self.start.view, self.end.view, s)
        return replace(
            self.end, view=view, options=self._mixed(self.start.options, self.end.options, s)
        )

    def _mixed(self, start: Any, end: Any, s: float) -> Any:
        """Return the value of a field between two values, or the end if there is none."""
        if start == end:
            return end
        if isinstance(start, Camera) and isinstance(end, Camera):
            return self._view(View(start), View(end), s).camera
        if is_dataclass(end) and type(start) is type(end):
            names = [field.name for field in fields(end)]
            mixed = {n: self._mixed(getattr(start, n), getattr(end, n), s) for n in names}
            return replace(end, **mixed)  # type: ignore[type-var]
        if isinstance(start, tuple) and isinstance(end, tuple) and len(start) == len(end):
            return tuple(self._mixed(*pair, s) for pair in zip(start, end, strict=True))
        if float in (type(start), type(end)) and {type(start), type(end)} <= {int, float}:
            return start + s * (end - start)
        return end

    def _view(self, start: View, end: View, s: float) -> View:
        if start == end:
            return end
        passage = self._passages.get((start, end))
        if passage is None:
            focus = _shared_frame(start.camera, end.camera) or self._focus.center
            passage = Passage(start, end, focus, self._size)
            self._passages[start, end] = passage
        return passage.at(s, eased=False)


def _shared_frame(one: Camera, two: Camera) -> Vector | None:
    """Return the middle of the image rectangle if both cameras share it, so that only the eye
    moves.
    """
    frame = plane_corners(one)
    if not np.allclose(frame, plane_corners(two)):
        return None
    x, y, z = np.mean(frame, axis=0).tolist()
    return x, y, z
