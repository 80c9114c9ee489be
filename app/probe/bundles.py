"""Viewing rays of a row, a column, or a grid of pixels, and their hits, to be drawn in space."""

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
    """Return the rays of several pixels (n, 2) and their hits; see row_of().

    tracer: of the same scene; finds the hits, in float32, if there are many. Without it, more than
    MOST_RAYS rays raise LucidaError.
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
    """Return the pixels of a row, (width, 2)."""
    return grid([row], np.arange(size[0]))


def column_of(column: int, size: Size) -> NDArray[np.int64]:
    """Return the pixels of a column, (height, 2)."""
    return grid(np.arange(size[1]), [column])


def grid(rows: object, columns: object) -> NDArray[np.int64]:
    """Return all pairs of rows and columns, row by row, (n, 2)."""
    i, j = np.meshgrid(np.asarray(rows, np.int64), np.asarray(columns, np.int64), indexing="ij")
    return np.stack([i.ravel(), j.ravel()], axis=1)
