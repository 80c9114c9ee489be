"""Viewing rays of a row, a column, or a net of pixels, and what they hit: to be drawn in space.

Owns which pixels and the arrays. Knows nothing of how rays are drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.probe.model import Probe, winner_of
from renderer.camera import Camera, Floats, Size
from renderer.errors import LucidaError

if TYPE_CHECKING:  # it loads the compiler
    from renderer.trace import Tracer

MOST_RAYS = 4096  # of a bundle without a tracer


@dataclass(frozen=True, eq=False)
class Bundle:
    """Viewing rays of several pixels: arrays (n, 2) of (row, column), (n, 3), (n, 3) and (n,).

    t: of the closest hit, inf for none; primitive: -1 for none.
    """

    pixels: NDArray[np.int64]
    origins: Floats
    directions: Floats
    t: Floats
    primitive: NDArray[np.int64]


def bundle(
    probe: Probe,
    pixels: NDArray[np.integer],
    camera: Camera,
    size: Size,
    tracer: Tracer | None = None,
) -> Bundle:
    """The rays of several pixels (n, 2) and what they hit; see row_of().

    tracer: finds the hits, in float32, where there are many; of the same scene. Without it at
    most MOST_RAYS are followed: LucidaError.
    """
    pixels = np.asarray(pixels, np.int64).reshape(-1, 2)
    ray = camera.ray(pixels[:, 0], pixels[:, 1], size)
    origins, directions = (np.array(part, float) for part in ray)
    if tracer is not None:
        hits = tracer.closest_hits(origins, directions, *camera.t_range)
        t, primitive = hits[0].astype(float), hits[1].astype(np.int64)
        return Bundle(pixels, origins, directions, t, primitive)
    if len(pixels) > MOST_RAYS:
        problem = f"{len(pixels)} are too many to follow one by one"
        raise LucidaError("rays", problem, f"stay within {MOST_RAYS}, or give a tracer")
    t, primitive = np.full(len(pixels), np.inf), np.full(len(pixels), -1)
    for number, (origin, direction) in enumerate(zip(origins, directions, strict=True)):
        found = probe.index.crossings(origin, direction)
        if (first := winner_of(found, camera.t_range)) >= 0:
            t[number], primitive[number] = found.t[first], found.primitive[first]
    return Bundle(pixels, origins, directions, t, primitive)


def row_of(row: int, size: Size) -> NDArray[np.int64]:
    """The pixels of a row, (width, 2)."""
    return grid([row], np.arange(size[0]))


def column_of(column: int, size: Size) -> NDArray[np.int64]:
    """The pixels of a column, (height, 2)."""
    return grid(np.arange(size[1]), [column])


def grid(rows: object, columns: object) -> NDArray[np.int64]:
    """All pairs of rows and columns, row by row, (n, 2)."""
    i, j = np.meshgrid(np.asarray(rows, np.int64), np.asarray(columns, np.int64), indexing="ij")
    return np.stack([i.ravel(), j.ravel()], axis=1)
