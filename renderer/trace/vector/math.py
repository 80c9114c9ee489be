"""Mathematics on lanes: powers, and 3-vectors as tuples of F32."""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.compile.emit import emitted, f32

from .lanes import (
    bits_of_f32,
    f32_of,
    f32_of_bits,
    fma,
    i32_of,
    inverse_root,
    select,
    splat,
    vabs,
    vfloor,
    vmax,
)
from .memory import load, store
from .types import LANES

_HALF_ROOT = 0x3F3504F3  # the bits of sqrt(1/2)
_QUARTER_PI = np.pi / 4
_ZERO = np.float32(0)


@emitted
def log2_lanes(x):
    """Return the binary logarithm of x > 0, normal; relative error below 3e-7, also near x = 1.

    Source: Moshier, Cephes, logf.
    """
    # x = 2^exponent (1 + f), with 1 + f between sqrt(1/2) and sqrt(2).
    shifted = bits_of_f32(x) - np.int32(_HALF_ROOT)
    exponent = f32_of(shifted >> np.int32(23))
    f = f32_of_bits((shifted & np.int32(0x7FFFFF)) + np.int32(_HALF_ROOT)) - np.float32(1)
    p = fma(f, np.float32(7.0376836292e-2), splat(np.float32(-1.1514610310e-1)))
    p = fma(p, f, np.float32(1.1676998740e-1))
    p = fma(p, f, np.float32(-1.2420140846e-1))
    p = fma(p, f, np.float32(1.4249322787e-1))
    p = fma(p, f, np.float32(-1.6668057665e-1))
    p = fma(p, f, np.float32(2.0000714765e-1))
    p = fma(p, f, np.float32(-2.4999993993e-1))
    p = fma(p, f, np.float32(3.3333331174e-1))
    square = f * f
    log = fma(p, f * square, fma(square, np.float32(-0.5), f))
    return fma(log, np.float32(1.4426950408889634), exponent)


@emitted
def exp2_lanes(x):
    """Return 2^x for x < 128; 0 below 2^-125. Relative error below 2e-7.

    Source: Moshier, Cephes, exp2f.
    """
    x = vmax(x, np.float32(-126))
    whole = vfloor(x + np.float32(0.5))
    f = x - whole
    p = fma(f, np.float32(1.535336188319500e-4), splat(np.float32(1.339887440266574e-3)))
    p = fma(p, f, np.float32(9.618437357674640e-3))
    p = fma(p, f, np.float32(5.550332471162809e-2))
    p = fma(p, f, np.float32(2.402264791363012e-1))
    p = fma(p, f, np.float32(6.931472028550421e-1))
    p = fma(p, f, np.float32(1))
    power = f32_of_bits((i32_of(whole) + np.int32(127)) << np.int32(23))
    return select(x > np.float32(-125), p * power, np.float32(0))


@emitted
def power_lanes(x, exponent):
    """Return x^exponent for 0 <= x <= 1 and a number exponent >= 1.

    The relative error is 1e-6 times 1 + |log2| of the result: tiny powers are less accurate.
    """
    return exp2_lanes(log2_lanes(vmax(x, np.float32(1e-37))) * exponent)


@emitted
def atan2_lanes(y, x):
    """Return the angle of (x, y) from the x axis, -pi to pi; 0 for (0, 0). Error below 3e-7.

    Source: Moshier, Cephes, atanf.
    """
    a, b = vabs(x), vabs(y)
    least, most = select(a < b, a, b), select(a < b, b, a)
    t = least / select(most > np.float32(0), most, np.float32(1))
    # Above pi / 8, use the angle's difference from pi / 4.
    is_steep = t > np.float32(0.41421356)
    t = select(is_steep, (t - np.float32(1)) / (t + np.float32(1)), t)
    square = t * t
    p = fma(square, np.float32(8.05374449538e-2), splat(np.float32(-1.38776856032e-1)))
    p = fma(p, square, np.float32(1.99777106478e-1))
    p = fma(p, square, np.float32(-3.33329491539e-1))
    angle = fma(p * square, t, t) + select(is_steep, splat(np.float32(_QUARTER_PI)), _ZERO)
    angle = select(a < b, np.float32(2 * _QUARTER_PI) - angle, angle)
    angle = select(x < _ZERO, np.float32(4 * _QUARTER_PI) - angle, angle)
    return select(y < _ZERO, -angle, angle)


@emitted
def dot_lanes(a, b):
    return fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]))


@emitted
def fma_lanes(s, a, b):
    """Return s a + b."""
    return fma(s, a[0], b[0]), fma(s, a[1], b[1]), fma(s, a[2], b[2])


@emitted
def each_fma(a, b, c):
    """Return a b + c, component by component."""
    return fma(a[0], b[0], c[0]), fma(a[1], b[1], c[1]), fma(a[2], b[2], c[2])


@emitted
def load3(memory, at):
    """Load three vectors, one after the other."""
    return load(memory, at), load(memory, at + LANES), load(memory, at + 2 * LANES)


@emitted
def store3(memory, at, a):
    """Store three vectors, one after the other."""
    store(memory, at, a[0])
    store(memory, at + LANES, a[1])
    store(memory, at + 2 * LANES, a[2])


@emitted
def splat_lanes(a):
    """Return a vector with the same numbers, as float32, in all lanes."""
    return splat(f32(a[0])), splat(f32(a[1])), splat(f32(a[2]))


@emitted
def inverse_length(a):
    """Return 1 / |a|; NaN or inf for 0."""
    return inverse_root(dot_lanes(a, a))


@emitted
def normalized_lanes(a):
    """Return a / |a|; a must not be 0."""
    scale = inverse_length(a)
    return scale * a[0], scale * a[1], scale * a[2]


@emitted
def select_lanes(mask, a, b):
    return select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])
