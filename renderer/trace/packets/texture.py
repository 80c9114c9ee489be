"""Textures on a square's 16 pixels, in float32 lanes.

Owns the lookup: texel coordinates between a triangle's vertices or on a sphere, wrapped, and the
light of four texels. Scenes without textures are compiled without any of it. The formulas are
scalar/texture.py's.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.scene.flat import CHECKER_DIFFUSE, FlatScene
from renderer.shared_numbers import MIRROR, TEXEL_BITS, WRAP_BITS
from renderer.trace.compile.compiled import inlined
from renderer.trace.simd.lanes import (
    LANES,
    f32_of,
    first_of_four,
    fma,
    i32_of,
    lane_of,
    last_of_four,
    select,
    splat,
    vfloor,
    vmax,
    vmin,
    vsqrt,
)
from renderer.trace.simd.math import atan2_lanes
from renderer.trace.simd.memory import gather_fours, pointer, prefetch_lanes

_MOST = (1 << TEXEL_BITS) - 1
# The bits of a texel's colours, where they are; and what makes their squares light.
_RED, _GREEN, _BLUE = (np.int32(_MOST << shift) for shift in (0, TEXEL_BITS, 2 * TEXEL_BITS))
_PER_RED, _PER_GREEN, _PER_BLUE = (np.float32(float(bits) ** -2) for bits in (_RED, _GREEN, _BLUE))
_REPEAT = 0  # neither of the shared ones
_U_WRAP = (1 << WRAP_BITS) - 1
_PER_TURN, _PER_HALF_TURN = np.float32(0.5 / math.pi), np.float32(1 / math.pi)
_SMALL = 1 << 22  # texels: of an image that stays in the caches
_FAR_APART = np.float32(8)  # texels: nearer to one another, the next ones were loaded with these
_PER_NEXT = np.float32(4 / 3)  # a square's width, of what its first and last columns are apart
_HALF, _ONE, _ZERO = np.float32(0.5), np.float32(1), np.float32(0)


class PacketTextures(NamedTuple):
    """A FlatScene's arrays; None each where nothing of it is textured. A function whose argument
    is one of these is compiled for None without what is behind its first line."""

    uv: NDArray[np.float32] | None
    textures: NDArray[np.int32] | None
    texels: NDArray[np.int32] | None


def textures_of(flat: FlatScene) -> PacketTextures:
    if not len(flat.texels):
        return PacketTextures(None, None, None)
    return PacketTextures(flat.uv, flat.textures, flat.texels)


@inlined
def texture_pointers(textures):
    return PacketTextures(
        pointer(textures.uv), pointer(textures.textures), pointer(textures.texels)
    )


@inlined
def nowhere():
    """Texel coordinates that are yet to be found."""
    return splat(_ZERO), splat(_ZERO)


@inlined
def between_vertices(textures, mask, vertices, weights, places):
    """The places, with those of one triangle's points in the lanes of the mask."""
    a, b, c = vertices.a // 3 * 2, vertices.b // 3 * 2, vertices.c // 3 * 2
    return (
        _between(textures.uv, mask, a, b, c, weights, places[0]),
        _between(textures.uv, mask, a + 1, b + 1, c + 1, weights, places[1]),
    )


@inlined
def _between(uv, mask, a, b, c, weights, place):
    if uv is None:
        return place
    start = uv[a]
    own = fma(weights[1], uv[b] - start, fma(weights[2], uv[c] - start, splat(start)))
    return select(mask, own, place)


@inlined
def on_sphere(textures, materials, number, n):
    """Where of its texture a sphere's pixels with outward unit normals n are."""
    return _on_sphere(textures.textures, materials, number, n)


@inlined
def _on_sphere(images, materials, number, n):
    if images is None:
        return nowhere()
    place = 12 * np.int64(number) + 4 * CHECKER_DIFFUSE
    u = fma(atan2_lanes(n[0], n[2]), _PER_TURN, splat(_HALF))
    across = vsqrt(fma(n[0], n[0], n[2] * n[2]))
    v = fma(atan2_lanes(n[1], across), _PER_HALF_TURN, splat(_HALF))
    return (
        fma(u, materials[place], splat(materials[place + 1])),
        fma(v, materials[place + 2], splat(materials[place + 3])),
    )


@inlined
def textured(textures, number, places, tint, is_wanted):
    """The tint of an object's pixels, times its texture's light at their places, if it has one."""
    at = 4 * np.int64(number)
    return _textured(textures.texels, textures.textures, at, places, tint, is_wanted)


@inlined
def _textured(texels, images, at, places, tint, is_wanted):
    if texels is None:
        return tint
    if not is_wanted or images[at + 1] == 0:
        return tint
    first, width, height, wraps = images[at], images[at + 1], images[at + 2], images[at + 3]
    column, right = _texel(places[0], np.float32(width), wraps & _U_WRAP)
    row, down = _texel(places[1], np.float32(height), wraps >> WRAP_BITS)
    stride = np.int32(width) + np.int32(1)  # beyond its last texel, a row goes on with what follows
    upper = row * stride + column + np.int32(first)
    if width * height > _SMALL and _width(places[0]) + _width(places[1]) > _FAR_APART:
        _ask_for_next(texels, images, at, places, stride)
    a, b, c, d = gather_fours(texels, upper, stride)
    left, up = _ONE - right, _ONE - down
    weights = left * up, right * up, left * down, right * down
    return (
        tint[0] * _light(a, b, c, d, _RED, _PER_RED, weights),
        tint[1] * _light(a, b, c, d, _GREEN, _PER_GREEN, weights),
        tint[2] * _light(a, b, c, d, _BLUE, _PER_BLUE, weights),
    )


@inlined
def _ask_for_next(texels, images, at, places, stride):
    """Asks for the texels of the square to the right, where it would see more of the same: of a
    large image they are in none of the caches."""
    first, width, height, wraps = images[at], images[at + 1], images[at + 2], images[at + 3]
    column, _right = _texel(_next(places[0]), np.float32(width), wraps & _U_WRAP)
    row, _down = _texel(_next(places[1]), np.float32(height), wraps >> WRAP_BITS)
    upper = row * stride + column + np.int32(first)
    prefetch_lanes(texels, upper)
    prefetch_lanes(texels, upper + stride)


@inlined
def _width(place):
    """How far the first and the last pixel of a square are apart."""
    return abs(lane_of(place, LANES - 1) - lane_of(place, 0))


@inlined
def _next(place):
    return fma(last_of_four(place) - first_of_four(place), _PER_NEXT, place)


@inlined
def _light(a, b, c, d, bits, scale, weights):
    p, q, r, s = f32_of(a & bits), f32_of(b & bits), f32_of(c & bits), f32_of(d & bits)
    upper = fma(p * p, weights[0], q * q * weights[1])
    return fma(r * r, weights[2], fma(s * s, weights[3], upper)) * scale


@inlined
def _texel(place, size, wrap):
    """The number of the texel before a place in one direction, I32, and how far behind its middle
    that is, F32: the next one follows in memory."""
    last = size - _ONE
    if wrap != _REPEAT:
        if wrap == MIRROR:
            there_and_back = size * np.float32(2)
            place = place - there_and_back * vfloor(place * (_ONE / there_and_back))
            place = select(place > size, there_and_back - place, place)
        place = vmin(vmax(place - _HALF, _ZERO), splat(last))
        index = vfloor(place)
        return i32_of(index), place - index
    place = place - _HALF
    index = vfloor(place)
    part = place - index
    # In the middle of a texel, rounding the quotient does no harm.
    index = index - size * vfloor((index + _HALF) * (_ONE / size))
    return i32_of(vmin(vmax(index, _ZERO), splat(last))), part
