"""The mesh of a hall, of the kind of Sponza: walls and a floor of a few large triangles, columns,
arches, vaults, railings and hangings of very many small ones.

Owns its shape and where it is looked at from. y is up; the nave runs along x, a bay each 4 units.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.benchmarks.meshes import Faces, Vertices, block, joined, placed

Mesh = tuple[Vertices, Faces]

BAYS, BAY = 8, 4.0
HALF = BAYS * BAY / 2  # of the length
NAVE, AISLE = 3.5, 6.5  # half of the width, to the columns and to the walls
STOREY, TOP = 5.0, 10.0  # the gallery's floor, where the vault begins

# Under a name: eye, target, vertical field of view.
Point = tuple[float, float, float]
VIEWS: dict[str, tuple[Point, Point, float]] = {
    "along the nave": ((-14.5, 1.7, 0.6), (0.0, 3.6, -0.2), 60.0),
    "across an aisle": ((-9.0, 1.6, -5.6), (-2.0, 2.4, 3.0), 65.0),
    "down from the gallery": ((9.9, 7.1, 4.1), (0.0, 1.0, -3.0), 70.0),
    "up into the vault": ((1.0, 1.5, 0.0), (3.0, 12.0, 0.7), 80.0),
    "close to a hanging": ((-3.4, 3.4, 1.4), (-2.2, 3.3, 3.4), 50.0),
}


def interior(detail: float = 1.0) -> Mesh:
    """About 262,000 triangles; detail: how finely curves are divided, times as finely as then."""

    def n(count: int) -> int:
        return max(3, round(count * detail))

    parts = [*_shell(), _vault(n(44), n(24))]
    column, baluster = _column(n(48), n(24)), _baluster(n(8), n(16))
    arch, cloth, urn = _arch(n(24), n(10)), _hanging(n(46), n(80)), _urn(n(40), n(44))
    for side in (-1.0, 1.0):
        for bay in range(BAYS + 1):
            x = (bay - BAYS / 2) * BAY
            for floor in (0.0, STOREY):
                parts.append(_at(column, x, floor, side * NAVE))
                parts.append(_box(x, floor + 3.9, side * NAVE, 0.56, 2.2, 0.56))
        for bay in range(BAYS):
            x = (bay + 0.5 - BAYS / 2) * BAY
            for floor in (0.0, STOREY):
                parts.append(_at(arch, x, floor + 2.8, side * NAVE))
            parts += [_at(baluster, x + 0.4 * k, STOREY + 0.2, side * NAVE) for k in range(-4, 5)]
            parts.append(_box(x, STOREY + 1.05, side * NAVE, BAY - 0.7, 0.12, 0.3))
            if bay % 2:
                parts.append(_at(cloth, x, 0.0, side * NAVE))
            else:
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


def _column(around: int, steps: int) -> Mesh:
    shape = [(0.45, 0.0), (0.45, 0.25), (0.36, 0.4), (0.3, 0.5), (0.27, 2.4), (0.3, 2.5)]
    shape += [(0.42, 2.65), (0.46, 2.8), (0.0, 2.8)]
    return _turned(shape, around, steps, 0.08)


def _baluster(around: int, steps: int) -> Mesh:
    shape = [(0.09, 0.0), (0.05, 0.12), (0.11, 0.35), (0.05, 0.65), (0.09, 0.8)]
    return _turned(shape, around, steps, 0.0)


def _urn(around: int, steps: int) -> Mesh:
    shape = [(0.5, 0.0), (0.5, 0.5), (0.2, 0.6), (0.15, 0.8), (0.55, 1.3), (0.45, 1.7), (0.5, 1.8)]
    return _turned([*shape, (0.4, 1.75), (0.0, 1.2)], around, steps, 0.05)


def _arch(along: int, across: int) -> Mesh:
    """A half circle between two columns: a moulding, with the wall above it."""
    angle = np.linspace(0, np.pi, along + 1)[:, None]
    section = np.linspace(0, 1, across + 1)
    depth = 0.3 * np.cos(np.pi * section)
    radius = BAY / 2 - 0.28 + 0.12 * np.sin(np.pi * section) * np.cos(5 * np.pi * section) ** 2
    x, y = -radius * np.cos(angle), radius * np.sin(angle)
    ring = _grid(np.stack([x, y, np.broadcast_to(depth, x.shape)], axis=-1))
    walls = []
    for z in (-0.3, 0.3):
        inner = np.stack([x[:, 0], y[:, 0], np.full(along + 1, z)], axis=-1)
        outer = inner.copy()
        outer[:, 1] = STOREY - 2.8
        outer[:, 0] *= BAY / 2 / (BAY / 2 - 0.28)
        walls.append(_grid(np.stack([inner, outer])))
    return joined(ring, *walls)


def _hanging(across: int, down: int) -> Mesh:
    """Cloth between two columns, in folds that widen downwards."""
    u, v = np.meshgrid(np.linspace(-1, 1, across + 1), np.linspace(0, 1, down + 1))
    fold = np.sin(9 * np.pi * u + 0.6 * np.sin(5 * v)) * (0.04 + 0.14 * v)
    x = 1.4 * u * (1 - 0.12 * np.sin(np.pi * v))
    y = 4.3 - 3.1 * v - 0.25 * (1 - u * u) * (1 - v)
    return _grid(np.stack([x, y, fold + 0.05 * np.sin(7 * u + 4 * v)], axis=-1))


def _vault(along: int, across: int) -> Mesh:
    """Cross vaults over the nave, bay by bay: the higher of two barrels."""
    x = np.linspace(-HALF, HALF, BAYS * along + 1)[:, None]
    z = np.linspace(-NAVE, NAVE, 2 * across + 1)
    lengthwise = np.sqrt(np.maximum(0.0, 1 - (z / NAVE) ** 2))
    crosswise = np.sqrt(np.maximum(0.0, 1 - ((x / BAY + 0.5) % 1 * 2 - 1) ** 2))
    height = TOP + 2.6 * np.maximum(lengthwise, crosswise)
    points = np.broadcast_arrays(x, height, z)
    return _grid(np.stack(points, axis=-1))


def _shell() -> list[Mesh]:
    """Floors, walls and roofs: large triangles, some of them long and thin."""
    parts = [
        _box(0.0, -0.1, 0.0, 2 * HALF, 0.2, 2 * AISLE),
        _box(-HALF - 0.2, 6.5, 0.0, 0.4, 13.0, 2 * AISLE),
        _box(HALF + 0.2, 6.5, 0.0, 0.4, 13.0, 2 * AISLE),
    ]
    for side in (-1.0, 1.0):
        middle = side * (NAVE + AISLE) / 2
        parts += [
            _box(0.0, 5.0, side * (AISLE + 0.2), 2 * HALF, 10.0, 0.4),
            _box(0.0, STOREY + 0.1, middle, 2 * HALF, 0.2, AISLE - NAVE + 0.6),
            _box(0.0, TOP + 0.1, middle, 2 * HALF, 0.2, AISLE - NAVE + 0.6),
            _box(0.0, TOP + 1.4, side * (NAVE + 0.1), 2 * HALF, 2.8, 0.2),
        ]
        tiles = np.linspace(-HALF, HALF, 65)
        parts += [_box(x, 0.01, side * NAVE / 2, 0.02, 0.02, NAVE) for x in tiles]  # joints
    return parts


def _box(x: float, y: float, z: float, width: float, height: float, depth: float) -> Mesh:
    return placed(block((width, height, depth)), 1.0, (x, y, z))
