"""Supersampling for both renderers: the positions of samples in a pixel, and their mean."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError

from .frame import Frame

MOST_SAMPLES = 64

Progress = Callable[[float], None]
# Draws an image of a camera, size and channels, with one sample per pixel, at its centre.
Draw = Callable[[Camera, tuple[int, int], tuple[str, ...], Progress | None], Frame]


def check_samples(samples: object) -> int:
    """Return the number of samples. Raises LucidaError if it is not a square from 1 to 64."""
    number = samples.__index__() if hasattr(samples, "__index__") else 0
    if not 1 <= number <= MOST_SAMPLES or math.isqrt(number) ** 2 != number:
        raise LucidaError(
            "samples", f"{samples!r} is not a square from 1 to {MOST_SAMPLES}",
            "give 1, 4, 9, 16, 25, 36, 49 or 64",
        )  # fmt: skip
    return number


def offsets(samples: int) -> list[tuple[float, float]]:
    """Return (rows, columns) of each sample from the pixel's centre: the cells of a k x k grid."""
    k = math.isqrt(samples)
    steps = [(2 * a + 1 - k) / (2 * k) for a in range(k)]  # (a + 0.5) / k - 0.5, with an exact 0
    return [(rows, columns) for rows in steps for columns in steps]


def supersampled(
    draw: Draw,
    camera: Camera,
    size: tuple[int, int],
    channels: tuple[str, ...],
    samples: int,
    progress: Progress | None = None,
) -> Frame:
    """Return an image whose colour is the mean, in linear light, of `samples` images with subpixel
    shifts. The other channels are those of the pixels' centres.

    channels and size: checked. samples: from check_samples. progress: called with 0 to 1.
    """
    places = offsets(samples if "color" in channels else 1)
    centre = (0.0, 0.0)
    others = tuple(name for name in channels if name != "color")
    passes: list[tuple[tuple[float, float], tuple[str, ...]]]
    passes = [(place, ("color",)) for place in places if place != centre]
    if centre in places:
        passes.insert(0, (centre, channels))
    elif others:
        passes.insert(0, (centre, others))

    frame: Frame | None = None
    total: np.ndarray | None = None
    time_s, complete = 0.0, True
    for number, (place, wanted) in enumerate(passes):
        shifted = camera if place == centre else camera.shifted(*place, size)
        part = draw(shifted, size, wanted, _part_of(progress, number, len(passes)))
        frame = frame or part
        time_s, complete = time_s + part.time_s, complete and part.complete
        if part.color is not None:
            total = part.color if total is None else np.add(total, part.color, out=total)
        if not complete:
            break
    assert frame is not None  # there is at least one pass
    if total is not None and len(places) > 1:
        total = total / np.float32(len(places))
    return replace(frame, color=total, time_s=time_s, complete=complete)


def _part_of(progress: Progress | None, number: int, count: int) -> Progress | None:
    if progress is None:
        return None
    return lambda fraction: progress((number + fraction) / count)
