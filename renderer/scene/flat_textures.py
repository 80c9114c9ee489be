"""The textures of a scene as flat arrays: one array of all texels, and the texel coordinates of
each vertex.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import WRAP_BITS
from lucida.renderer.system.errors import LucidaError

from .limits import TEXELS
from .metal import packed_metal, sized_alike
from .model import Mesh, Scene
from .texture import WRAPS, Texture, packed_opacity, packed_texels

# Texture coordinates stay within this many texels of 0, because float32 is too coarse beyond.
FARTHEST_TEXEL = float(1 << 22)

F32 = NDArray[np.float32]
I32 = NDArray[np.int32]


class TextureArrays(NamedTuple):
    """The texture arrays of a FlatScene."""

    uv: F32
    textures: I32
    texels: I32


def texture_arrays(
    scene: Scene, object_vertices: I32, known: tuple[Scene, I32, TextureArrays] | None
) -> TextureArrays:
    """Return the arrays of a scene's textures.

    object_vertices: the scene's (see FlatScene).
    known: another scene, its object_vertices and its arrays, which are reused if the same images
        are on the same vertices.

    Raises LucidaError if the images have too many texels for one scene.
    """
    if known is not None and _key(scene, object_vertices) == _key(known[0], known[1]):
        return known[2]
    textures = np.zeros((len(scene.objects), 2, 4), np.int32)
    textures[:, 1] = -1
    images = _Images()
    for (row, more), entry in zip(textures, scene.objects, strict=True):
        material, image = entry.material, entry.material.image
        if image is None:
            continue
        texels, metal = image.texels, material.metal
        key: tuple[object, ...] = (id(texels), id(metal))
        if metal is None:
            (row[0],) = images.place(key, image.wrap, partial(packed_texels, texels))
        else:
            texels, metal_texels = sized_alike(texels, metal)
            colors = material.diffuse, material.specular
            pair = partial(packed_metal, texels, metal_texels, metal, *colors)
            row[0], more[0] = images.place((*key, *colors), image.wrap, pair)
        if material.cutout is not None and isinstance(entry.shape, Mesh):
            made = partial(packed_opacity, texels, material.cutout)
            (more[1],) = images.place((*key, material.cutout), image.wrap, made)
        row[1:] = texels.shape[1], texels.shape[0], _wraps(image)
    every = np.concatenate(images.parts) if images.parts else np.zeros(0, np.int32)
    vertices = int(object_vertices[:, 1].sum()) if images.parts else 0
    uv = np.zeros((vertices, 2), np.float32)
    sizes = textures[:, 0, 1:3]
    for (first, count), entry, size in zip(object_vertices, scene.objects, sizes, strict=True):
        image, shape = entry.material.image, entry.shape
        if image is not None and count and isinstance(shape, Mesh) and shape.uv is not None:
            uv[first : first + count] = _in_texels(shape.uv, image, tuple(size.tolist()))
    return TextureArrays(uv, textures, every)


class _Images:
    """The images of a scene, each stored once, one after another. parts: their texels."""

    def __init__(self) -> None:
        self.parts: list[I32] = []
        self._places: dict[tuple[object, ...], list[int]] = {}
        self._total = 0

    def place(
        self,
        key: tuple[object, ...],
        wrap: tuple[str, str],
        made: Callable[[], I32 | tuple[I32, ...]],
    ) -> list[int]:
        """Return the first texels of images, one or more. key: everything that they depend on
        except the wrap. made: returns the packed texels. Raises LucidaError if there are too many.
        """
        key = *key, wrap
        if key not in self._places:
            firsts = []
            images = made()
            for image in images if isinstance(images, tuple) else (images,):
                firsts.append(self._total)
                self._total += (image.shape[0] + 1) * (image.shape[1] + 1)
                if self._total > TEXELS:
                    most = f"more than {TEXELS // 10**6} million pixels together"
                    problem = f"the scene's images have {most}"
                    raise LucidaError("textures", problem, "use smaller or fewer images")
                self.parts.append(_with_border(image, wrap))
            self._places[key] = firsts
        return self._places[key]


def _wraps(image: Texture) -> int:
    return WRAPS.index(image.wrap[0]) | WRAPS.index(image.wrap[1]) << WRAP_BITS


def on_sphere(texture: Texture, size: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return (a, b, c, d) such that (a u + b, c v + d) are a sphere's texel coordinates at u and v
    from 0 to 1. They are near 0 if the image repeats. size: (width, height).
    """
    (a, _, b), (_, c, d) = texture.in_texels(size)
    b -= _shift(texture, size, 0, b + a / 2)
    return a, b, c, d - _shift(texture, size, 1, d + c / 2)


def _shift(texture: Texture, size: tuple[int, int], axis: int, middle: float) -> float:
    """Return the distance of texel coordinates from 0, in whole periods of the image."""
    if texture.wrap[axis] == "clamp":
        return 0.0
    # The period is twice the image, because every other one may be mirrored.
    period = 2.0 * size[axis]
    return period * math.floor(middle / period)


def _with_border(texels: I32, wrap: tuple[str, str]) -> I32:
    """Return texels (height, width) as in FlatScene: with a copy of the texels that follow the last
    column and the last row, so that four neighbours are two pairs in memory.
    """
    height, width = texels.shape
    around = np.empty((height + 1, width + 1), np.int32)
    around[:-1, :-1] = texels
    around[:-1, -1] = texels[:, 0 if wrap[0] == "repeat" else -1]
    around[-1] = around[0 if wrap[1] == "repeat" else -2]
    return around.reshape(-1)


def _key(scene: Scene, object_vertices: I32) -> list[tuple[object, ...]]:
    """Return a key of everything that the arrays depend on, valid while the scene lives."""
    materials = [entry.material for entry in scene.objects]
    if all(material.image is None for material in materials):
        return [(len(scene.objects),)]
    return [
        (int(first), int(count), id(m.image), id(getattr(e.shape, "uv", None)), m.cutout)
        + ((id(m.metal), m.diffuse, m.specular) if m.metal is not None else ())
        for e, m, (first, count) in zip(scene.objects, materials, object_vertices, strict=True)
    ]


def _in_texels(uv: F32, texture: Texture, size: tuple[int, int]) -> F32:
    """Return vertices' coordinates (n, 2) in texels, near 0 if the image repeats."""
    place = texture.in_texels(size)
    places = uv.astype(np.float64) @ place[:, :2].T + place[:, 2]
    for axis in range(2):
        middle = (places[:, axis].min() + places[:, axis].max()) / 2
        places[:, axis] -= _shift(texture, size, axis, middle)
    kept: F32 = np.clip(places, -FARTHEST_TEXEL, FARTHEST_TEXEL).astype(np.float32)
    return kept
