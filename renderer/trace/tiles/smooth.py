"""Interpolation of a triangle's vertices at its pixels: smooth normals and colours.

Barycentric coordinates are computed for one triangle at the pixels of a square.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.images import shared_numbers
from lucida.renderer.trace.bvh.bvh16 import CORNERS, WIDTH
from lucida.renderer.trace.compile.emit import choose, emitted, f32, f64, i32, i64
from lucida.renderer.trace.reference.vectors import cross, dot, minus, plus, times, triple
from lucida.renderer.trace.vector.lanes import LANES, fma, lane_of, splat
from lucida.renderer.trace.vector.memory import as_float64

from .view import ORIGIN, ROW_X, ROW_Y, ROW_Z, ROWS

OTHER_SIDE = np.float32(shared_numbers.OTHER_SIDE)
_E0, _E1, _E2 = 0, 3, 6  # where edges are kept


class Vertices(NamedTuple):
    """The places of a triangle's vertices in the scene's flat arrays of three numbers each."""

    a: np.int64
    b: np.int64
    c: np.int64


@emitted
def vertices_of(faces, primitive):
    """Return the vertices of a triangle of the flat scene."""
    return Vertices(
        3 * i64(faces[3 * primitive]),
        3 * i64(faces[3 * primitive + 1]),
        3 * i64(faces[3 * primitive + 2]),
    )


@emitted
def barycentrics(view, corner, slot, space, points, scratch):
    """Return (b0, b1, b2) of a slot's triangle at a square's pixels, F32.

    points: the pixels' image points (tile.py).

    Each is an edge function over the sum of the three. They are set up in float64 and around the
    square, so that small triangles and narrow views keep their digits. The scratch keeps the last
    triangle's, because a tile may show a single one.
    """
    edges, slot_32, space_32 = as_float64(scratch.kept_edges), i32(slot), i32(space)

    def set_up():
        scratch.kept[0], scratch.kept[1] = slot_32, space_32
        at = slot // WIDTH * CORNERS + slot % WIDTH
        a = _homogeneous_corner(view, space, corner, at)
        b = _homogeneous_corner(view, space, corner, at + 3 * WIDTH)
        c = _homogeneous_corner(view, space, corner, at + 6 * WIDTH)
        _keep(edges, _E0, cross(b, c))
        _keep(edges, _E1, cross(c, a))
        _keep(edges, _E2, cross(a, b))

    is_kept = (scratch.kept[0] == slot_32) & (scratch.kept[1] == space_32)
    choose(is_kept, lambda: None, set_up)
    w0, w1, w2 = _edge(edges, _E0, points), _edge(edges, _E1, points), _edge(edges, _E2, points)
    scale = splat(np.float32(1)) / (w0 + w1 + w2)
    return w0 * scale, w1 * scale, w2 * scale


@emitted
def _keep(edges, at, e):
    edges[at], edges[at + 1], edges[at + 2] = e[0], e[1], e[2]


@emitted
def barycentrics_at(view, world, slot, space, point):
    """Return (b0, b1, b2) at 16 points of a slot's triangle, F32, relative to near_point."""
    at = slot // WIDTH * CORNERS + slot % WIDTH
    a = triple_of_lane(world.corner, at)
    u = minus(triple_of_lane(world.corner, at + 3 * WIDTH), a)
    v = minus(triple_of_lane(world.corner, at + 6 * WIDTH), a)
    n = cross(u, v)
    # The product of these vectors with a point of the triangle is b1 or b2, up to a constant.
    scale = 1.0 / dot(n, n)
    b1 = _weight(view, world, space, times(scale, cross(v, n)), a, point)
    b2 = _weight(view, world, space, times(scale, cross(n, u)), a, point)
    return np.float32(1) - b1 - b2, b1, b2


@emitted
def triple_of_lane(array, at):
    """Return one lane of three vectors, one after the other, as float64."""
    return (
        f64(array[at]),
        f64(array[at + LANES]),
        f64(array[at + 2 * LANES]),
    )


@emitted
def _weight(view, world, space, g, a, point):
    """Return g . (q - a). q: a point of the world, in the object's space."""
    m, r = world.object_from_world, 12 * space
    x = g[0] * m[r] + g[1] * m[r + 4] + g[2] * m[r + 8]
    y = g[0] * m[r + 1] + g[1] * m[r + 5] + g[2] * m[r + 9]
    z = g[0] * m[r + 2] + g[1] * m[r + 6] + g[2] * m[r + 10]
    at_near = dot((x, y, z), triple(view.near_point, 0))
    constant = at_near + dot(g, (m[r + 3], m[r + 7], m[r + 11])) - dot(g, a)
    value = fma(point[2], f32(z), splat(f32(constant)))
    return fma(point[0], f32(x), fma(point[1], f32(y), value))


@emitted
def _homogeneous_corner(view, space, corner, at):
    """Return (X, Y, H) of a corner, float64."""
    x, y, z = camera_point(view, space, corner, at)
    return x, y, choose(view.parallel, lambda: 1.0, lambda: z)


@emitted
def camera_point(view, space, corner, at):
    """Return (X, Y, Z) of a corner, float64."""
    rows, r = view.rows_exact, space * ROWS
    p = minus(triple_of_lane(corner, at), triple(rows, r + ORIGIN))
    return (
        dot(triple(rows, r + ROW_X), p) + rows[r + ROW_X + 3],
        dot(triple(rows, r + ROW_Y), p) + rows[r + ROW_Y + 3],
        dot(triple(rows, r + ROW_Z), p) + rows[r + ROW_Z + 3],
    )


@emitted
def _edge(edges, at, points):
    """Return an edge function at a square's pixels."""
    e = triple(edges, at)
    start = f32(dot(e, (points.x, points.y, 1.0)))
    across, down = f32(e[0]), f32(e[1])
    return fma(points.right, across, fma(points.down, down, splat(start)))


@emitted
def blended(array, vertices, weights):
    """Return the weighted mean of three numbers of each vertex."""
    a, b, c = (triple(array, vertex) for vertex in vertices)
    return tuple(
        fma(weights[0], a[axis], fma(weights[1], b[axis], weights[2] * c[axis]))
        for axis in range(3)
    )


@emitted
def have_normals(normals, vertices):
    """Return True if none of a triangle's three vertex normals is 0."""
    a, b, c = (_is_set(normals, vertex) for vertex in vertices)
    return a & b & c


@emitted
def _is_set(normals, at):
    return (normals[at] != 0) | (normals[at + 1] != 0) | (normals[at + 2] != 0)


@emitted
def agrees(normals, vertices, geometric, lane):
    """Return True unless the sum of a triangle's vertex normals is opposite to one lane's geometric
    normal.
    """
    a, b = triple(normals, vertices.a), triple(normals, vertices.b)
    x, y, z = plus(plus(a, b), triple(normals, vertices.c))
    along = x * lane_of(geometric[0], lane) + y * lane_of(geometric[1], lane)
    return along + z * lane_of(geometric[2], lane) >= OTHER_SIDE
