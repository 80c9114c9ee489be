"""Triangles whose vertices are moved to where a lens shows them, while their edges stay straight.

This is what games do. Splitting the triangles first brings the edges closer to the lens's curves.
Computed in float64 on the CPU, which has the maps of all lenses. Needs no GL.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Floats, Size
from renderer.errors import LucidaError
from renderer.lens_drawing import SPHERE_SPLITTING, pieces_drawn
from renderer.scene.flat import FlatScene
from renderer.scene.positions import world_corners

MOST_PIECES = 1 << 22
VERTICES = 1 << 17  # at a time


class Moved(NamedTuple):
    """Triangles to draw. vertices: float32 (n, 3), pixels from the image's middle, x right and y
    up, multiplied by t; and t. weights: float32 (n, 3), of the original triangle's corners; of a
    sphere, the vector from its centre in units of its radius. numbers: int32 (n,), of the
    primitives. indices: int32 (m, 3).
    """

    vertices: NDArray[np.float32]
    weights: NDArray[np.float32]
    numbers: NDArray[np.int32]
    indices: NDArray[np.int32]


def check_pieces(flat: FlatScene, splitting: int) -> None:
    """Raise LucidaError if that is too many."""
    count = pieces_drawn(len(flat.faces), len(flat.spheres), splitting)
    if count > MOST_PIECES:
        problem = f"{splitting} makes {count} triangles; at most {MOST_PIECES} are drawn"
        raise LucidaError("lens_drawing.splitting", problem, "split less, or look up")


def moved_triangles(
    flat: FlatScene, camera: Camera, size: Size, splitting: int, first: int, last: int
) -> Iterator[Moved]:
    """Yield the pieces of triangles first to last - 1, as a lens moves them, in parts.

    A piece with a corner that the lens does not see is left out, and so are invisible backs.
    """
    grid, pieces = _grid(splitting)
    step = max(1, VERTICES // len(grid))
    for start in range(first, last, step):
        numbers = np.arange(start, min(start + step, last))
        corners = world_corners(flat, numbers).astype(np.float64)
        owner = flat.face_object[numbers]
        a, b, c = np.moveaxis(corners, 1, 0)
        from_front = np.einsum("ni,ni->n", np.cross(b - a, c - a), np.asarray(camera.eye) - a)
        shown = ~((flat.single_sided[owner] > 0) & (from_front < 0))
        numbers, corners = numbers[shown], corners[shown]
        points = np.einsum("gk,nkx->ngx", grid, corners)
        yield _moved(camera, size, points, grid, numbers, pieces)


def moved_spheres(flat: FlatScene, camera: Camera, size: Size, splitting: int) -> Iterator[Moved]:
    """Yield the pieces of the spheres, in parts."""
    directions, pieces = _ball(splitting + SPHERE_SPLITTING)
    step = max(1, VERTICES // len(directions))
    for start in range(0, len(flat.spheres), step):
        spheres = flat.spheres[start : start + step]
        points = spheres[:, None, :3] + spheres[:, None, 3:] * directions
        numbers = len(flat.faces) + np.arange(start, start + len(spheres))
        yield _moved(camera, size, points, directions, numbers, pieces)


def t_span(flat: FlatScene, camera: Camera) -> tuple[float, float]:
    """Return the least and the largest ray parameter to tell apart in a lens's image."""
    corners = np.stack(np.meshgrid(*flat.bounds.astype(float).T), -1).reshape(-1, 3)
    matrix = camera.camera_from_world
    away = np.linalg.norm(corners @ matrix[:3, :3].T + matrix[:3, 3], axis=1).max()
    farthest = max(1.01 * float(away) / camera.distance, 1e-30)
    return 1e-6 * farthest, farthest


def _moved(
    camera: Camera,
    size: Size,
    points: Floats,
    weights: Floats,
    numbers: NDArray[np.integer],
    pieces: NDArray[np.int32],
) -> Moved:
    """Return the pieces of n primitives. points: world, (n, k, 3). weights: (k, 3)."""
    count, each = points.shape[:2]
    row, column, t = camera.project(points, size)
    x, y = column - (size[0] - 1) / 2, (size[1] - 1) / 2 - row
    with np.errstate(invalid="ignore", over="ignore"):
        vertices = np.stack([x * t, y * t, t], axis=-1).astype(np.float32)
    seen = np.isfinite(vertices).all(axis=-1) & (vertices[..., 2] > 0)
    indices = pieces + each * np.arange(count, dtype=np.int32)[:, None, None]
    return Moved(
        vertices.reshape(-1, 3),
        np.tile(weights.astype(np.float32), (count, 1)),
        np.repeat(numbers.astype(np.int32), each),
        indices[seen[:, pieces].all(axis=-1)],
    )


@cache
def _grid(splitting: int) -> tuple[Floats, NDArray[np.int32]]:
    """Return barycentrics (n, 3), and the triangles between them (4^splitting, 3)."""
    side = 2**splitting
    places = [(i, j) for i in range(side + 1) for j in range(side + 1 - i)]
    known = {place: number for number, place in enumerate(places)}
    pieces = [
        [known[place] for place in three]
        for i, j in places
        for three in (((i, j), (i + 1, j), (i, j + 1)), ((i + 1, j), (i + 1, j + 1), (i, j + 1)))
        if all(place in known for place in three)
    ]
    weights = np.array([(side - i - j, i, j) for i, j in places]) / side
    return weights, np.array(pieces, np.int32)


@cache
def _ball(splitting: int) -> tuple[Floats, NDArray[np.int32]]:
    """Return unit directions (n, 3), and the triangles between them: a split octahedron."""
    grid, pieces = _grid(splitting)
    signs = np.array([(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)])
    points = (grid * signs[:, None]).reshape(-1, 3)
    points = points / np.linalg.norm(points, axis=1, keepdims=True)
    starts = len(grid) * np.arange(8, dtype=np.int32)
    return points, (pieces + starts[:, None, None]).reshape(-1, 3)
