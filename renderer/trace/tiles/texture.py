"""Textures on a square's 16 pixels, in float32 lanes.

This module computes wrapped texel coordinates between a triangle's vertices or on a sphere, and the
light of four texels. Scenes without textures are compiled without any of it. The formulas are
reference/texture.py's.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import MIRROR, TEXEL_BITS, WRAP_BITS
from lucida.renderer.scene.flat import CHECKER_DIFFUSE
from lucida.renderer.trace.compile.emit import choose, emitted, f32, i32, i64
from lucida.renderer.trace.reference.vectors import each_times
from lucida.renderer.trace.vector.gather import gather_fours, prefetch_lanes
from lucida.renderer.trace.vector.lanes import (
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
from lucida.renderer.trace.vector.math import atan2_lanes, select_lanes

_MOST = (1 << TEXEL_BITS) - 1
# The bits of a texel that hold each colour, and the factors that turn their squares into light.
_RED, _GREEN, _BLUE = (np.int32(_MOST << shift) for shift in (0, TEXEL_BITS, 2 * TEXEL_BITS))
_PER_RED, _PER_GREEN, _PER_BLUE = (np.float32(float(bits) ** -2) for bits in (_RED, _GREEN, _BLUE))
_REPEAT = 0  # the wrap that is neither CLAMP nor MIRROR
_U_WRAP = (1 << WRAP_BITS) - 1
_PER_TURN, _PER_HALF_TURN = np.float32(0.5 / math.pi), np.float32(1 / math.pi)
_SMALL = 1 << 22  # texels of an image that stays in the caches
_FAR_APART = np.float32(8)  # texels; if the next ones are nearer, they are already in the cache
_PER_NEXT = np.float32(4 / 3)  # a square's width over the distance of its first and last columns
_HALF, _ONE, _ZERO = np.float32(0.5), np.float32(1), np.float32(0)


class PacketTextures(NamedTuple):
    """Arrays of a FlatScene; None each in kernels without textures."""

    uv: NDArray[np.float32] | None
    textures: NDArray[np.int32] | None
    texels: NDArray[np.int32] | None


NO_TEXTURES = PacketTextures(None, None, None)


@emitted
def nowhere():
    """Return the initial texel coordinates."""
    return splat(_ZERO), splat(_ZERO)


@emitted
def between_vertices(textures, mask, vertices, weights, places):
    """Return the places, after setting the mask's lanes to the points on one triangle."""
    a, b, c = vertices.a // 3 * 2, vertices.b // 3 * 2, vertices.c // 3 * 2
    return (
        _between(textures.uv, mask, a, b, c, weights, places[0]),
        _between(textures.uv, mask, a + 1, b + 1, c + 1, weights, places[1]),
    )


@emitted
def _between(uv, mask, a, b, c, weights, place):
    if uv is None:
        return place
    start = uv[a]
    own = fma(weights[1], uv[b] - start, fma(weights[2], uv[c] - start, splat(start)))
    return select(mask, own, place)


@emitted
def on_sphere(textures, materials, number, n):
    """Return the texture coordinates of a sphere's pixels with outward unit normals n."""
    if textures.textures is None:
        return nowhere()
    place = 12 * i64(number) + 4 * CHECKER_DIFFUSE
    u = fma(atan2_lanes(n[0], n[2]), _PER_TURN, splat(_HALF))
    across = vsqrt(fma(n[0], n[0], n[2] * n[2]))
    v = fma(atan2_lanes(n[1], across), _PER_HALF_TURN, splat(_HALF))
    return (
        fma(u, materials[place], splat(materials[place + 1])),
        fma(v, materials[place + 2], splat(materials[place + 3])),
    )


@emitted
def textured(textures, number, places, tint, is_wanted):
    """Return the tint of an object's pixels, times its texture's light at their places."""
    texels, images, at = textures.texels, textures.textures, 8 * i64(number)
    if texels is None:
        return tint

    def coloured():
        light = _light_of(texels, images, at, images[at], places)
        return each_times(tint, light)

    return choose(is_wanted & (images[at + 1] != 0), coloured, lambda: tint)


@emitted
def glossy(textures, number, places, mask, gloss):
    """Return the gloss, multiplied in the lanes of the mask by the light of an object's metal
    texture at its pixels' places.
    """
    texels, images, at = textures.texels, textures.textures, 8 * i64(number)
    if texels is None:
        return gloss

    def metallic():
        return select_lanes(mask, _light_of(texels, images, at, images[at + 4], places), gloss)

    return choose(images[at + 4] < 0, lambda: gloss, metallic)


@emitted
def times_gloss(textures, gloss, color):
    """Return specular light, three F32, times the gloss."""
    return color if textures.texels is None else each_times(color, gloss)


@emitted
def are_holes(world, number, vertices, weights):
    """Return the mask of points of one triangle that lie in holes."""
    a, b, c = vertices.a // 3 * 2, vertices.b // 3 * 2, vertices.c // 3 * 2
    zero = splat(_ZERO)
    all_lanes = zero == zero
    x = _between(world.uv, all_lanes, a, b, c, weights, zero)
    y = _between(world.uv, all_lanes, a + 1, b + 1, c + 1, weights, zero)
    at = 8 * i64(number)
    upper, stride, of = _corner(world.textures, at, world.textures[at + 5], (x, y))
    p, q, r, s = gather_fours(world.texels, upper, stride)
    above = fma(f32_of(p), of[0], f32_of(q) * of[1])
    return fma(f32_of(r), of[2], fma(f32_of(s), of[3], above)) < _ZERO


@emitted
def _light_of(texels, images, at, first, places):
    """Return the light of one of an object's images at the places. first: its first texel."""
    upper, stride, weights = _corner(images, at, first, places)
    width, height = images[at + 1], images[at + 2]
    is_seldom = width * height > _SMALL
    is_seldom = is_seldom & (_width(places[0]) + _width(places[1]) > _FAR_APART)
    choose(
        is_seldom, lambda: _ask_for_next(texels, images, at, first, places, stride), lambda: None
    )
    a, b, c, d = gather_fours(texels, upper, stride)
    return (
        _light(a, b, c, d, _RED, _PER_RED, weights),
        _light(a, b, c, d, _GREEN, _PER_GREEN, weights),
        _light(a, b, c, d, _BLUE, _PER_BLUE, weights),
    )


@emitted
def _corner(images, at, first, places):
    """Return the numbers of the upper left of the four texels around each place, the length of a
    row in memory, and the weights of the four."""
    width, height, wraps = images[at + 1], images[at + 2], images[at + 3]
    column, right = _texel(places[0], f32(width), wraps & _U_WRAP)
    row, down = _texel(places[1], f32(height), wraps >> WRAP_BITS)
    stride = i32(width) + np.int32(1)  # each row repeats the texel that follows its last one
    left, up = _ONE - right, _ONE - down
    weights = left * up, right * up, left * down, right * down
    return row * stride + column + i32(first), stride, weights


@emitted
def _ask_for_next(texels, images, at, first, places, stride):
    """Prefetch the texels of the square to the right, since a large image's are in no cache.

    Without this, a wall with a texture of 8192 x 4096 takes 19.6 ms instead of 14.6.
    """
    width, height, wraps = images[at + 1], images[at + 2], images[at + 3]
    column, _right = _texel(_next(places[0]), f32(width), wraps & _U_WRAP)
    row, _down = _texel(_next(places[1]), f32(height), wraps >> WRAP_BITS)
    upper = row * stride + column + i32(first)
    prefetch_lanes(texels, upper)
    prefetch_lanes(texels, upper + stride)


@emitted
def _width(place):
    """Return the distance between the first and the last pixel of a square."""
    return abs(lane_of(place, LANES - 1) - lane_of(place, 0))


@emitted
def _next(place):
    return fma(last_of_four(place) - first_of_four(place), _PER_NEXT, place)


@emitted
def _light(a, b, c, d, bits, scale, weights):
    p, q, r, s = f32_of(a & bits), f32_of(b & bits), f32_of(c & bits), f32_of(d & bits)
    upper = fma(p * p, weights[0], q * q * weights[1])
    return fma(r * r, weights[2], fma(s * s, weights[3], upper)) * scale


@emitted
def _texel(place, size, wrap):
    """Return the number of the texel before a place in one direction, I32, and the place's distance
    from its middle, F32. The next one follows in memory."""
    last = size - _ONE

    def mirrored():
        there_and_back = size * np.float32(2)
        inside = place - there_and_back * vfloor(place * (_ONE / there_and_back))
        return select(inside > size, there_and_back - inside, inside)

    def within():
        own = choose(wrap == MIRROR, mirrored, lambda: place)
        own = vmin(vmax(own - _HALF, _ZERO), splat(last))
        index = vfloor(own)
        return i32_of(index), own - index

    def repeated():
        own = place - _HALF
        index = vfloor(own)
        part = own - index
        # In the middle of a texel, rounding the quotient does no harm.
        index = index - size * vfloor((index + _HALF) * (_ONE / size))
        return i32_of(vmin(vmax(index, _ZERO), splat(last))), part

    return choose(wrap != _REPEAT, within, repeated)
