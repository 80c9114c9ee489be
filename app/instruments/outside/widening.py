"""Bring a wrong answer into sight: the outside camera moves back until it sees all of it.

It returns when the answer is gone, unless the user has moved it meanwhile.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lucida.app.instruments.outside.answers import points_of
from lucida.app.instruments.outside.diagram import Item
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.system.errors import LucidaError

if TYPE_CHECKING:
    from lucida.app.instruments.outside.mouse import Scope
    from lucida.app.ui.host import Host


LABEL_PX = (75.0, 35.0)  # at both ends of a side, for what is written there
MOST_ROOM = 1.6  # a picture's side, in those of what it must hold
FARTHEST = 40.0  # in reaches of the scene: a point beyond would make a dot of the scene


class Widening:
    """The outside camera's place before an answer was drawn, and while it is."""

    def __init__(self) -> None:
        self._seen: tuple[Hashable, ...] = ()
        self._moved: tuple[Camera | None, Camera | None] | None = None  # from where, to where

    def follow(self, host: Host, scope: Scope, drawn: dict[Hashable, tuple[Item, ...]]) -> None:
        """Move the outside camera if what was answered has changed. Call once a frame.

        drawn: wrong answers, with their drawings.
        """
        seen = tuple(drawn)
        if seen == self._seen:
            return
        self._seen = seen
        now = host.state.options.outside.camera
        home = self._moved[0] if self._moved is not None and now == self._moved[1] else now
        target, self._moved = home, None
        if drawn:
            points = np.concatenate([points_of(items) for items in drawn.values()])
            apart = np.linalg.norm(points - scope.center, axis=1)
            size = round(scope.extent.x), round(scope.extent.y)
            looking = home or scope.camera
            found = backed(looking, points[apart < FARTHEST * scope.reach], size)
            target = home if found is looking else found
            self._moved = home, target
        if target != now:
            host.amend(host.state.with_options(replace(host.state.options.outside, camera=target)))


def backed(camera: Camera, points: Floats, size: tuple[int, int]) -> Camera:
    """Return the camera, moved straight back until it sees all points (n, 3) in a picture of
    `size`; itself if it sees them. A parallel one gets a larger viewport.
    """
    if not len(points):
        return camera
    width, height = (
        min(side / max(side - 2 * label, 1.0), MOST_ROOM)
        for side, label in zip(size, LABEL_PX, strict=True)
    )
    seen = camera.fitted(size).viewport
    left, right, bottom, top = np.divide(seen, (width, width, height, height))
    matrix = camera.camera_from_world
    x, y, z = (points @ matrix[:3, :3].T + matrix[:3, 3]).T
    with np.errstate(all="ignore"):
        sides = np.stack([x / right, x / left, y / top, y / bottom]).max(axis=0)
    try:
        if camera.is_parallel:
            factor = float(sides.max())
            wider = tuple((np.array(camera.viewport) * max(factor, 1.0)).tolist())
            return camera if factor <= 1 else replace(camera, viewport=wider)
        back = float((camera.distance * sides + z).max())
        if back <= 0:
            return camera
        eye = tuple((np.asarray(camera.eye) + back * np.asarray(camera.w)).tolist())
        return replace(camera, eye=eye)
    except LucidaError:  # beyond the numbers
        return camera
