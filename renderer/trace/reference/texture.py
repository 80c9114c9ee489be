"""The colour of a texture at a hit, interpolated from the four texels around it.

The lookup is float64; shaders/chunks/texture.glsl has the same formulas.
"""

from __future__ import annotations

import math

import numpy as np

from lucida.renderer.images.shared_numbers import CLAMP, MIRROR, TEXEL_BITS, WRAP_BITS
from lucida.renderer.scene import flat
from lucida.renderer.trace.compile.compiled import inlined

from .vectors import plus, times

MOST = (1 << TEXEL_BITS) - 1  # a texel's largest number
_WRAPS = (1 << WRAP_BITS) - 1
PLACE = flat.CHECKER_DIFFUSE  # the material's row
BASE, MORE = np.int64(0), np.int64(1)  # an object's rows of FlatScene.textures


@inlined
def place_at(scene, number, outward, primitive, b1, b2):
    """Return the texel coordinates of a hit on object `number`. outward: from a sphere's centre to
    the hit; b1, b2: the place on a triangle."""
    if primitive < len(scene.faces):
        return _between_corners(scene.uv, scene.faces[primitive], b1, b2)
    return _on_sphere(scene.materials[number, PLACE], outward)


@inlined
def light_at_place(scene, number, first, x, y):
    """Return the linear light of one of an object's images. first: its first texel."""
    texels, row = scene.texels, scene.textures[number, BASE]
    upper, lower, right, down = _four_texels(first, row[1], row[2], row[3], x, y)
    above = _mean(_light(texels[upper[0]]), _light(texels[upper[1]]), right)
    below = _mean(_light(texels[lower[0]]), _light(texels[lower[1]]), right)
    return _mean(above, below, down)


@inlined
def opacity_at_place(texels, first, width, height, wraps, x, y):
    """Return the opacity minus the cutout, negative in a hole. texels: an array or pointer.

    first: of the opacity's image, whose size and wraps follow.
    """
    upper, lower, right, down = _four_texels(first, width, height, wraps, x, y)
    above = (1.0 - right) * texels[upper[0]] + right * texels[upper[1]]
    below = (1.0 - right) * texels[lower[0]] + right * texels[lower[1]]
    return (1.0 - down) * above + down * below


@inlined
def _between_corners(uv, face, b1, b2):
    """Return the texel coordinates at a point of a triangle."""
    p, q, r = _pair(uv, face[0]), _pair(uv, face[1]), _pair(uv, face[2])
    b0 = 1.0 - b1 - b2
    return b0 * p[0] + b1 * q[0] + b2 * r[0], b0 * p[1] + b1 * q[1] + b2 * r[1]


@inlined
def _pair(uv, vertex):
    return np.float64(uv[vertex, 0]), np.float64(uv[vertex, 1])


@inlined
def _on_sphere(place, n):
    """Return the texel coordinates of a direction from a sphere's centre."""
    u = 0.5 + math.atan2(n[0], n[2]) / (2.0 * math.pi)
    v = 0.5 + math.atan2(n[1], math.sqrt(n[0] * n[0] + n[2] * n[2])) / math.pi
    a, b, c, d = place[0], place[1], place[2], place[3]
    return np.float64(a) * u + np.float64(b), np.float64(c) * v + np.float64(d)


@inlined
def _four_texels(first, width, height, wraps, x, y):
    """Return the numbers of the four texels around a place, upper two and lower two, and the
    place's distances to the right of and below the middle of the first.
    """
    width, height = np.int64(width), np.int64(height)
    wrap_u, wrap_v = wraps & _WRAPS, wraps >> WRAP_BITS
    column, row = math.floor(x - 0.5), math.floor(y - 0.5)
    right, down = x - 0.5 - column, y - 0.5 - row
    c0, c1 = _wrapped(column, width, wrap_u), _wrapped(column + 1.0, width, wrap_u)
    stride = width + 1
    r0 = first + stride * _wrapped(row, height, wrap_v)
    r1 = first + stride * _wrapped(row + 1.0, height, wrap_v)
    return (r0 + c0, r0 + c1), (r1 + c0, r1 + c1), right, down


@inlined
def _mean(a, b, part):
    return plus(times(1.0 - part, a), times(part, b))


@inlined
def _wrapped(index, size, wrap):
    """Return the number of a texel; `index` may be outside an image of `size` texels."""
    i = np.int64(index)
    if wrap == CLAMP:
        return min(max(i, 0), size - 1)
    if wrap == MIRROR:
        i = i % (2 * size)
        return 2 * size - 1 - i if i >= size else i
    return i % size


@inlined
def _light(texel):
    red, green, blue = texel & MOST, (texel >> TEXEL_BITS) & MOST, texel >> 2 * TEXEL_BITS
    return (red / MOST) ** 2, (green / MOST) ** 2, (blue / MOST) ** 2
