"""The textures of a scene as flat arrays: one array of all texels, and where in it each vertex is.

Owns their layout, and what of them is kept while a scene changes. Knows nothing of who samples.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene.limits import TEXELS
from renderer.scene.model import Mesh, Scene
from renderer.scene.texture import WRAPS, Texture, packed_texels
from renderer.shared_numbers import WRAP_BITS

# Texture coordinates are kept within this many texels of 0: beyond, float32 tells none apart.
FARTHEST_TEXEL = float(1 << 22)

F32 = NDArray[np.float32]
I32 = NDArray[np.int32]


class TextureArrays(NamedTuple):
    """As FlatScene has them."""

    uv: F32
    textures: I32
    texels: I32


def texture_arrays(
    scene: Scene, object_vertices: I32, known: tuple[Scene, I32, TextureArrays] | None
) -> TextureArrays:
    """The arrays of a scene whose objects have such vertices (FlatScene). known: another scene,
    its object_vertices and arrays, which are taken where the same images are on the same vertices.

    Raises LucidaError where the images have too many texels for one scene.
    """
    if known is not None and _key(scene, object_vertices) == _key(known[0], known[1]):
        return known[2]
    textures = np.zeros((len(scene.objects), 4), np.int32)
    places: dict[tuple[int, int], int] = {}  # the first texel of each image that is there
    parts: list[I32] = []
    total = 0
    for row, entry in zip(textures, scene.objects, strict=True):
        texture = entry.material.texture
        if texture is None:
            continue
        width, height = texture.size
        wraps = WRAPS.index(texture.wrap[0]) | WRAPS.index(texture.wrap[1]) << WRAP_BITS
        key = id(texture.texels), wraps
        if key not in places:
            places[key] = total
            total += (width + 1) * (height + 1)
            if total > TEXELS:
                raise LucidaError(
                    "textures",
                    f"the scene's images have more than {TEXELS // 10**6} million pixels together",
                    "use smaller or fewer images",
                )
            parts.append(_with_border(packed_texels(texture.texels), texture.wrap))
        row[:] = places[key], width, height, wraps
    texels = np.concatenate(parts) if parts else np.zeros(0, np.int32)
    vertices = int(object_vertices[:, 1].sum()) if parts else 0
    uv = np.zeros((vertices, 2), np.float32)
    for (first, count), entry in zip(object_vertices, scene.objects, strict=True):
        texture, shape = entry.material.texture, entry.shape
        if texture is not None and count and isinstance(shape, Mesh) and shape.uv is not None:
            uv[first : first + count] = _in_texels(shape.uv, texture)
    return TextureArrays(uv, textures, texels)


def on_sphere(texture: Texture) -> tuple[float, float, float, float]:
    """As Texture.in_texels(), near 0 where the image repeats: of what a sphere shows of it, for u
    and v from 0 to 1."""
    a, b, c, d = texture.in_texels()
    return a, b - _shift(texture, 0, b + a / 2), c, d - _shift(texture, 1, d + c / 2)


def _shift(texture: Texture, axis: int, middle: float) -> float:
    """How far from 0 texel coordinates are, in whole periods of an image that repeats."""
    if texture.wrap[axis] == "clamp":
        return 0.0
    # Twice the image, as every other one may be mirrored.
    period = 2.0 * texture.size[axis]
    return period * math.floor(middle / period)


def _with_border(texels: I32, wrap: tuple[str, str]) -> I32:
    """Texels (height, width) as they lie in FlatScene: with what follows behind the last column and
    the last row, so that four neighbours are two and two in memory."""
    height, width = texels.shape
    around = np.empty((height + 1, width + 1), np.int32)
    around[:-1, :-1] = texels
    around[:-1, -1] = texels[:, 0 if wrap[0] == "repeat" else -1]
    around[-1] = around[0 if wrap[1] == "repeat" else -2]
    return around.reshape(-1)


def _key(scene: Scene, object_vertices: I32) -> list[tuple[int, ...]]:
    """What the arrays depend on, while the scene lives."""
    if all(entry.material.texture is None for entry in scene.objects):
        return [(len(scene.objects),)]
    return [
        (int(first), int(count), id(e.material.texture), id(getattr(e.shape, "uv", None)))
        for e, (first, count) in zip(scene.objects, object_vertices, strict=True)
    ]


def _in_texels(uv: F32, texture: Texture) -> F32:
    """Vertices' coordinates (n, 2) in texels, near 0 where the image repeats."""
    a, b, c, d = texture.in_texels()
    places = uv.astype(np.float64) * (a, c) + (b, d)
    for axis in range(2):
        middle = (places[:, axis].min() + places[:, axis].max()) / 2
        places[:, axis] -= _shift(texture, axis, middle)
    kept: F32 = np.clip(places, -FARTHEST_TEXEL, FARTHEST_TEXEL).astype(np.float32)
    return kept
