"""The cameras of a film's frames: around a point, in a dolly zoom, through key cameras."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from lucida.app.cameras.animation import Passage
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.navigation import dollied, orbited
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

Timing = Literal["eased", "constant", "cut"]
ZOOM = 4.0  # the dolly zoom's change of distance


@dataclass(frozen=True)
class Key:
    """A camera on the path. seconds, timing: those of the transition to the next key."""

    view: View
    seconds: float = 2.0
    timing: Timing = "eased"


def around(view: View, focus: Focus, size: Size, count: int) -> list[Camera]:
    """Return cameras that circle the focus once, the eye moving to the right. The first frame
    follows the last one.
    """
    camera = view.for_size(size)
    angles = np.linspace(0, -2 * math.pi, count, endpoint=False).tolist()
    return [orbited(camera, focus.center, angle, 0.0) if angle else camera for angle in angles]


def dolly_zoom(view: View, focus: Focus, size: Size, count: int) -> list[Camera]:
    """Return cameras that move back from the focus, and zoom so that it keeps its size."""
    camera = view.for_size(size)
    if camera.is_parallel:
        raise LucidaError(
            "--dolly-zoom",
            "parallel rays have no distance",
            "use --path, or a camera in perspective",
        )
    distances = camera.distance * np.geomspace(1, ZOOM, count)
    return [dollied(camera, focus.center, distance) for distance in distances.tolist()]


def through(keys: Sequence[Key], focus: Focus, size: Size, count: int) -> list[Camera]:
    """Return cameras from the first key to the last one, in time with their seconds."""
    if len(keys) == 1:
        return [keys[0].view.for_size(size)] * count
    ends = np.cumsum([key.seconds for key in keys[:-1]])
    passages = [Passage(one.view, two.view, focus.center, size) for one, two in pairwise(keys)]
    cameras = []
    for moment in np.linspace(0, ends[-1], count).tolist():
        number = min(int(np.searchsorted(ends, moment, "right")), len(passages) - 1)
        key, passage = keys[number], passages[number]
        part = 1 - (float(ends[number]) - moment) / key.seconds
        if key.timing == "cut" and part < 1:
            part = 0.0
        cameras.append(passage.at(part, eased=key.timing == "eased").for_size(size))
    return cameras
