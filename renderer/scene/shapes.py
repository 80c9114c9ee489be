"""Procedural meshes: box, rectangle, disk, cylinder, cone, torus; and transforms of a mesh.

All are centred on the origin of their own space, with y up and counter-clockwise faces seen from
outside. Vertices that are duplicated for their normals have exactly the same position, so that
closed shapes have no gaps.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.system.errors import LucidaError

from .limits import SEGMENTS
from .material import length, vector
from .model import Mesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def box(size: float | Iterable[float] = 1.0) -> Mesh:
    """Return a box with sides `size`: one length, or three along x, y and z. Flat normals."""
    x, y, z = (side / 2 for side in _sides("size", size))
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    corners = np.empty((3, 2, 4, 3))
    for axis, side in itertools.product(range(3), (1, -1)):
        quad = corners[axis, int(side < 0)]
        quad[:, axis] = side
        # The other two axes in cyclic order turn counter-clockwise about +axis.
        quad[:, (axis + 1) % 3], quad[:, (axis + 2) % 3] = signs[:, 0] * side, signs[:, 1]
    quads = np.arange(24).reshape(6, 4)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    return _built(corners.reshape(-1, 3) * (x, y, z), faces)


def rectangle(width: float = 1.0, depth: float = 1.0) -> Mesh:
    """Return a rectangle in the plane y = 0, `width` along x and `depth` along z, facing +y."""
    x, z = _length("width", width) / 2, _length("depth", depth) / 2
    vertices = np.array([[-x, 0, z], [x, 0, z], [x, 0, -z], [-x, 0, -z]])
    return _built(vertices, np.array([[0, 1, 2], [0, 2, 3]]))


def disk(radius: float = 0.5, segments: int = 64) -> Mesh:
    """Return a disk in the plane y = 0, facing +y, as a regular polygon with `segments` corners."""
    rim = _length("radius", radius) * _circle(_count("segments", segments))
    vertices, faces = _cap(rim, 0.0, up=True)
    return _built(vertices, faces)


def cylinder(
    radius: float = 0.5, height: float = 1.0, segments: int = 64, smooth: bool = True
) -> Mesh:
    """Return a closed cylinder about the y axis. smooth: its side has smooth normals; its caps stay
    flat.
    """
    circle = _circle(_count("segments", segments))
    rim, half = _length("radius", radius) * circle, _length("height", height) / 2
    below, above = np.insert(rim, 1, -half, axis=1), np.insert(rim, 1, half, axis=1)
    outward = np.insert(circle, 1, 0.0, axis=1)
    side = np.concatenate([below, above])
    caps = [_cap(rim, half, up=True), _cap(rim, -half, up=False)]
    return _assemble(side, _strip(segments), np.tile(outward, (2, 1)), caps, smooth)


def cone(radius: float = 0.5, height: float = 1.0, segments: int = 64, smooth: bool = True) -> Mesh:
    """Return a closed cone about the y axis, its tip at +height / 2."""
    segments = _count("segments", segments)
    rim, half = (
        _length("radius", radius) * _circle(segments),
        _length("height", height) / 2,
    )
    base = np.insert(rim, 1, -half, axis=1)
    # The tip is duplicated; each copy has the normal of the middle of its segment.
    tips = np.tile([0.0, half, 0.0], (segments, 1))
    slope = np.array([height, radius]) / math.hypot(height, radius)
    at_base = np.insert(_circle(segments) * slope[0], 1, slope[1], axis=1)
    at_tip = np.insert(_circle(segments, 0.5) * slope[0], 1, slope[1], axis=1)
    here = np.arange(segments)
    faces = np.stack([here, (here + 1) % segments, segments + here], axis=1)
    side = np.concatenate([base, tips])
    caps = [_cap(rim, -half, up=False)]
    return _assemble(side, faces, np.concatenate([at_base, at_tip]), caps, smooth)


def torus(
    radius: float = 0.5,
    tube_radius: float = 0.2,
    segments: int = 96,
    sides: int = 48,
    smooth: bool = True,
) -> Mesh:
    """Return a torus about the y axis: a tube of `tube_radius` around a circle of `radius`."""
    radius, tube_radius = _length("radius", radius), _length("tube_radius", tube_radius)
    if not tube_radius < radius:
        raise LucidaError(
            "tube_radius", f"{tube_radius:g} is not below radius = {radius:g}", "give a smaller one"
        )
    ring = _circle(_count("segments", segments))[:, None]
    tube = _circle(_count("sides", sides))[None]
    normals = np.stack(
        np.broadcast_arrays(ring[..., 0] * tube[..., 0], tube[..., 1], ring[..., 1] * tube[..., 0]),
        axis=-1,
    )
    middle = np.insert(radius * ring, 1, 0.0, axis=-1)
    vertices = (middle + tube_radius * normals).reshape(-1, 3)
    a = np.arange(len(vertices)).reshape(segments, sides)
    b, d = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    c = np.roll(b, -1, axis=1)
    faces = np.stack([a, d, c, a, c, b], axis=-1).reshape(-1, 3)
    return _assemble(vertices, faces, normals.reshape(-1, 3), [], smooth)


# Transforms of a mesh.


def placement(
    translate: Iterable[float] = (0.0, 0.0, 0.0),
    rotate_deg: Iterable[float] = (0.0, 0.0, 0.0),
    scale: float | Iterable[float] = 1.0,
) -> Floats:
    """Return the matrix (4, 4) that scales, then rotates, then translates.

    rotate_deg: angles about the world's x axis first, then y, then z, counter-clockwise as seen
    from the axis's tip. scale: one factor, or three along x, y and z; negative ones mirror.
    """
    matrix = np.eye(4)
    for axis, angle in enumerate(vector("rotate_deg", rotate_deg)):
        # Angles repeat, so reduce them first, which keeps a huge one's digits.
        turn = math.radians(math.remainder(angle, 360))
        c, s = _exact(math.cos(turn)), _exact(math.sin(turn))
        rotation = np.eye(4)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        rotation[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
        matrix = rotation @ matrix
    factors = (scale,) * 3 if isinstance(scale, int | float) else scale
    factors = vector("scale", factors)
    if 0 in factors:
        raise LucidaError("scale", f"{factors} flattens the shape", "give factors other than 0")
    matrix[:3, :3] *= factors
    matrix[:3, 3] = vector("translate", translate)
    return matrix


def transformed(mesh: Mesh, matrix: Floats) -> Mesh:
    """Return the mesh moved by `matrix` (4, 4) in world space."""
    return mesh.placed(matrix @ mesh.transform)


# Parts of round shapes.


def _circle(segments: int, first: float = 0.0) -> Floats:
    """Return points (cos, -sin) of a unit circle, counter-clockwise seen from +y."""
    angle = (np.arange(segments) + first) * (2 * math.pi / segments)
    return np.stack([np.cos(angle), -np.sin(angle)], axis=1)


def _strip(segments: int) -> Ints:
    """Return the faces between a lower ring, vertices 0 to segments - 1, and the upper ring after
    it.
    """
    here = np.arange(segments)
    there = (here + 1) % segments
    a, b, c, d = here, there, segments + there, segments + here
    return np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


def _cap(rim: Floats, y: float, up: bool) -> tuple[Floats, Ints]:
    """Return a fan about its centre, the last vertex, at height y, facing +y or -y."""
    count = len(rim)
    vertices = np.insert(np.concatenate([rim, np.zeros((1, 2))]), 1, y, axis=1)
    here = np.arange(count)
    there = (here + 1) % count
    ends = (here, there) if up else (there, here)
    return vertices, np.stack([*ends, np.full(count, count)], axis=1)


def _assemble(
    side: Floats, faces: Ints, normals: Floats, caps: list[tuple[Floats, Ints]], smooth: bool
) -> Mesh:
    """Return one mesh of a smooth side and its flat caps."""
    vertices, all_faces, first = [side], [faces], len(side)
    for cap_vertices, cap_faces in caps:
        vertices.append(cap_vertices)
        all_faces.append(cap_faces + first)
        first += len(cap_vertices)
    padded = np.zeros((first, 3))
    padded[: len(side)] = normals
    return _built(np.concatenate(vertices), np.concatenate(all_faces), padded if smooth else None)


def _built(vertices: Floats, faces: Ints, normals: Floats | None = None) -> Mesh:
    return Mesh(
        vertices.astype(np.float32),
        faces.astype(np.int32),
        None if normals is None else normals.astype(np.float32),
    )


# Checks.


def _exact(value: float) -> float:
    """Return the value, or 0 or 1 if it differs from that only by rounding, as at right angles."""
    nearest = round(value)
    return float(nearest) if abs(value - nearest) < 1e-15 else value


def _length(name: str, value: float) -> float:
    return length(name, value, 1e-9, "give a length, e.g. 1.0")


def _sides(name: str, value: float | Iterable[float]) -> tuple[float, float, float]:
    sides = (value,) * 3 if isinstance(value, int | float | np.number) else value
    x, y, z = (_length(name, side) for side in vector(name, sides))
    return x, y, z


def _count(name: str, value: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise LucidaError(name, f"{value!r} is not a whole number", f"give 3 to {SEGMENTS}")
    if not 3 <= value <= SEGMENTS:
        raise LucidaError(name, f"{value} is outside 3 to {SEGMENTS}", "give e.g. 64")
    return int(value)
