"""The mesh of a hall, of the kind of Sponza: walls and a floor of a few large triangles, columns,
urns and hangings of very many small ones.

Owns its shape and where it is looked at from. y is up; the nave runs along x, a bay each 4 units.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tools.benchmarks.meshes import Faces, Vertices, block, joined, placed

Mesh = tuple[Vertices, Faces]

BAYS, BAY = 8, 4.0
HALF = BAYS * BAY / 2  # of the length
NAVE, AISLE = 3.5, 6.5  # half of the width, to the columns and to the walls
STOREY, TOP = 5.0, 10.0  # the gallery's floor, the roof

# Profiles of (radius, height).
COLUMN = [(0.45, 0.0), (0.45, 0.25), (0.36, 0.4), (0.3, 0.5), (0.27, 4.4), (0.3, 4.6), (0.46, 5.0)]
URN = [(0.5, 0.0), (0.5, 0.5), (0.2, 0.6), (0.15, 0.8), (0.55, 1.3), (0.45, 1.7), (0.0, 1.2)]

# Under a name: eye, target, vertical field of view.
Point = tuple[float, float, float]
VIEWS: dict[str, tuple[Point, Point, float]] = {
    "along the nave": ((-14.5, 1.7, 0.6), (0.0, 3.6, -0.2), 60.0),
    "across an aisle": ((-9.0, 1.6, -5.6), (-2.0, 2.4, 3.0), 65.0),
    "down from the gallery": ((9.9, 7.1, 4.1), (0.0, 1.0, -3.0), 70.0),
    "up to the roof": ((1.0, 1.5, 0.0), (3.0, 9.0, 0.7), 80.0),
    "close to a hanging": ((-3.4, 3.4, 1.4), (-2.2, 3.3, 3.4), 50.0),
}


def interior(detail: float = 1.0) -> Mesh:
    """About 262,000 triangles; detail: how finely curves are divided, times as finely as then."""

    def n(count: int) -> int:
        return max(3, round(count * detail))

    parts = _shell()
    column = _turned(COLUMN, n(48), n(26), 0.08)
    urn = _turned(URN, n(40), n(44), 0.05)
    cloth = _hanging(n(46), n(80))
    for side in (-1.0, 1.0):
        for bay in range(BAYS + 1):
            x = (bay - BAYS / 2) * BAY
            parts += [_at(column, x, floor, side * NAVE) for floor in (0.0, STOREY)]
        for bay in range(BAYS):
            x = (bay + 0.5 - BAYS / 2) * BAY
            parts.append(_at(cloth, x, 0.0, side * NAVE))
            parts.append(_at(urn, x, 0.0, side * (AISLE - 0.8)))
    return joined(*parts)


def _at(part: Mesh, x: float, y: float, z: float) -> Mesh:
    return placed(part, 1.0, (x, y, z))


def _grid(points: NDArray[np.float64], around: bool = False) -> Mesh:
    """A surface through points (rows, columns, 3); around: the last column joins the first."""
    rows, columns = points.shape[:2]
    at = np.arange(rows * columns).reshape(rows, columns)
    if around:
        at = np.concatenate([at, at[:, :1]], axis=1)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    faces = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    return points.reshape(-1, 3).astype(np.float32), faces.astype(np.int32)


def _turned(profile: list[tuple[float, float]], around: int, steps: int, flutes: float) -> Mesh:
    """A profile of (radius, height) turned about y; flutes: their depth, a part of the radius."""
    corners = np.array(profile)
    along = np.linspace(0, len(corners) - 1, steps + 1)
    radius, height = (np.interp(along, np.arange(len(corners)), c) for c in corners.T)
    angle = np.arange(around) * (2 * np.pi / around)
    wave = 1 - flutes * np.abs(np.sin(6 * angle))
    r = radius[:, None] * wave
    points = [r * np.cos(angle), np.broadcast_to(height[:, None], r.shape), r * np.sin(angle)]
    return _grid(np.stack(points, axis=-1), around=True)


def _hanging(across: int, down: int) -> Mesh:
    """Cloth between two columns, in folds that widen downwards."""
    u, v = np.meshgrid(np.linspace(-1, 1, across + 1), np.linspace(0, 1, down + 1))
    fold = np.sin(9 * np.pi * u + 0.6 * np.sin(5 * v)) * (0.04 + 0.14 * v)
    x = 1.4 * u * (1 - 0.12 * np.sin(np.pi * v))
    y = 4.3 - 3.1 * v - 0.25 * (1 - u * u) * (1 - v)
    return _grid(np.stack([x, y, fold + 0.05 * np.sin(7 * u + 4 * v)], axis=-1))


def _shell() -> list[Mesh]:
    """A floor with joints, walls, galleries and a roof: large triangles, some long and thin."""
    middle, gallery = (NAVE + AISLE) / 2, AISLE - NAVE + 0.6
    boxes = [
        ((0.0, -0.1, 0.0), (2 * HALF, 0.2, 2 * AISLE)),
        ((0.0, TOP + 0.1, 0.0), (2 * HALF, 0.2, 2 * AISLE)),
        *(((0.0, STOREY + 0.1, side * middle), (2 * HALF, 0.2, gallery)) for side in (-1, 1)),
        *(((0.0, 5.0, side * (AISLE + 0.2)), (2 * HALF, 10.6, 0.4)) for side in (-1, 1)),
        *(((side * (HALF + 0.2), 5.0, 0.0), (0.4, 10.6, 2 * AISLE + 0.8)) for side in (-1, 1)),
        *(((x, 0.01, 0.0), (0.02, 0.02, 2 * NAVE)) for x in np.linspace(-HALF, HALF, 65)),
    ]
    return [placed(block(size), 1.0, middle) for middle, size in boxes]
