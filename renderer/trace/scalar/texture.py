"""The colour of a texture at a hit: where of its image the hit is, and four texels' light there.

Owns the lookup in float64, which shaders/chunks/texture.glsl computes alike. Knows nothing of how
hits are found, nor of lights.
"""

from __future__ import annotations

import math

import numpy as np

from renderer.scene import flat
from renderer.shared_numbers import CLAMP, MIRROR, TEXEL_BITS, WRAP_BITS
from renderer.trace.compile.compiled import inlined
from renderer.trace.scalar.vectors import plus, times

MOST = (1 << TEXEL_BITS) - 1  # what a texel's largest number is
_WRAPS = (1 << WRAP_BITS) - 1
PLACE = flat.CHECKER_DIFFUSE  # the material's row


@inlined
def texture_at(scene, number, outward, primitive, b1, b2):
    """The light, linear, that the texture of object `number` has at a hit. outward: from a sphere's
    centre to the hit; of a triangle, b1 and b2 tell the place."""
    if primitive < len(scene.faces):
        x, y = _between_corners(scene.uv, scene.faces[primitive], b1, b2)
    else:
        x, y = _on_sphere(scene.materials[number, PLACE], outward)
    return _sampled(scene.texels, scene.textures[number], x, y)


@inlined
def _between_corners(uv, face, b1, b2):
    """The texel coordinates at a point of a triangle."""
    p, q, r = _pair(uv, face[0]), _pair(uv, face[1]), _pair(uv, face[2])
    b0 = 1.0 - b1 - b2
    return b0 * p[0] + b1 * q[0] + b2 * r[0], b0 * p[1] + b1 * q[1] + b2 * r[1]


@inlined
def _pair(uv, vertex):
    return np.float64(uv[vertex, 0]), np.float64(uv[vertex, 1])


@inlined
def _on_sphere(place, n):
    """The texel coordinates of a direction from a sphere's centre: longitude and latitude."""
    u = 0.5 + math.atan2(n[0], n[2]) / (2.0 * math.pi)
    v = 0.5 + math.atan2(n[1], math.sqrt(n[0] * n[0] + n[2] * n[2])) / math.pi
    a, b, c, d = place[0], place[1], place[2], place[3]
    return np.float64(a) * u + np.float64(b), np.float64(c) * v + np.float64(d)


@inlined
def _sampled(texels, image, x, y):
    """The light between the middles of four texels."""
    width, height = np.int64(image[1]), np.int64(image[2])
    wrap_u, wrap_v = image[3] & _WRAPS, image[3] >> WRAP_BITS
    column, row = math.floor(x - 0.5), math.floor(y - 0.5)
    right, down = x - 0.5 - column, y - 0.5 - row
    c0, c1 = _wrapped(column, width, wrap_u), _wrapped(column + 1.0, width, wrap_u)
    stride = width + 1
    r0 = image[0] + stride * _wrapped(row, height, wrap_v)
    r1 = image[0] + stride * _wrapped(row + 1.0, height, wrap_v)
    upper = _mean(_light(texels[r0 + c0]), _light(texels[r0 + c1]), right)
    lower = _mean(_light(texels[r1 + c0]), _light(texels[r1 + c1]), right)
    return _mean(upper, lower, down)


@inlined
def _mean(a, b, part):
    return plus(times(1.0 - part, a), times(part, b))


@inlined
def _wrapped(index, size, wrap):
    """The number of a texel that may lie beyond an image of `size` texels in this direction."""
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
