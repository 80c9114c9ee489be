"""Vectors of three numbers as tuples: they live in registers, not in memory. The numbers are
float64, or lanes (vector/).
"""

from __future__ import annotations

import math

import numpy as np

from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import emitted


@inlined
def row(array, i):
    """Return array[i, :3] as float64. i: int64 (a literal would compile another version)."""
    return np.float64(array[i, 0]), np.float64(array[i, 1]), np.float64(array[i, 2])


@emitted
def triple(array, at):
    """Return array[at : at + 3] of a flat array."""
    return array[at], array[at + 1], array[at + 2]


@emitted
def transformed(m, at, p):
    """Return a point p, transformed by the upper three rows of a matrix, at m[at:] row by row."""
    return plus(rotated(m, at, p), (m[at + 3], m[at + 7], m[at + 11]))


@emitted
def rotated(m, at, a):
    """Return a direction a, transformed by the same rows without their translation."""
    return dot(triple(m, at), a), dot(triple(m, at + 4), a), dot(triple(m, at + 8), a)


@emitted
def plus(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@emitted
def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@emitted
def times(s, a):
    return s * a[0], s * a[1], s * a[2]


@emitted
def each_times(a, b):
    """Return the component-wise product, of colours."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


@emitted
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@emitted
def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def length(a):
    return math.sqrt(dot(a, a))


@inlined
def normalized(a):
    """Return a / |a|; a must not be 0."""
    return times(1.0 / length(a), a)


@emitted
def blend(b0, p, b1, q, b2, r):
    """Return b0 p + b1 q + b2 r: interpolation by barycentrics."""
    return (
        b0 * p[0] + b1 * q[0] + b2 * r[0],
        b0 * p[1] + b1 * q[1] + b2 * r[1],
        b0 * p[2] + b1 * q[2] + b2 * r[2],
    )
