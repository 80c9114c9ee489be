"""Metalness and roughness: a physically based material in Blinn's and Phong's terms.

A base colour is split into diffuse and specular reflectance. A metal's highlight has its base
colour, and little of it is diffuse; any other surface reflects a few percent, and is otherwise
diffuse. The weights yield mean colours like those of microfacets (f3d).
Source: Karis, "Specular BRDF Model Reference", 2013 (the exponent).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import number
from lucida.renderer.images.display import from_srgb
from lucida.renderer.system.errors import LucidaError

from .texture import packed_light

DIELECTRIC = 0.04  # the reflectance of non-metals, seen head on
# The diffuse part of a metal's base colour, in place of the reflection of surroundings that a scene
# does not have.
METAL_DIFFUSE = 0.3
SMOOTHEST = 0.05  # less roughness needs too large an exponent
NARROW = 14.0  # highlights have full strength if exponent + 2 is at least this

ROWS = 256  # of an image at a time, so that intermediate results stay small

EVERYWHERE = np.full((1, 1, 3), 255, np.uint8)
EVERYWHERE.setflags(write=False)

Floats = NDArray[np.floating]


@dataclass(frozen=True, eq=False)
class Metal:
    """A map of metalness and roughness, as in glTF, over the same area as the texture.

    texels: uint8 (height, width, 3), of which green is the roughness and blue the metalness;
    read-only; EVERYWHERE for a uniform surface. metalness, roughness: factors of these, 0 to 1.
    file: the image file; None for an image that was made, or is inside another file.
    """

    texels: NDArray[np.uint8] = field(default_factory=lambda: EVERYWHERE, repr=False)
    metalness: float = 1.0
    roughness: float = 1.0
    file: Path | None = None

    def __post_init__(self) -> None:
        for name in ("metalness", "roughness"):
            value = number(name, getattr(self, name))
            if not 0 <= value <= 1:
                raise LucidaError(name, f"{value:g} is outside 0 to 1", "give e.g. 1")
            object.__setattr__(self, name, value)

    @property
    def is_everywhere(self) -> bool:
        """Return True if two numbers describe the whole surface, even after a copy between
        processes.
        """
        return self.texels.shape == EVERYWHERE.shape and bool((self.texels == EVERYWHERE).all())

    @property
    def mean(self) -> tuple[float, float]:
        """Return the mean metalness, and the mean roughness weighted by reflectance."""
        _, roughness, metalness = self.texels.reshape(-1, 3).T / 255
        rough = np.average(roughness, weights=metalness * self.metalness + DIELECTRIC)
        return float(metalness.mean()) * self.metalness, float(rough) * self.roughness


def exponent(roughness: Floats | float) -> Floats:
    """Return the highlight's exponent of a roughness, within a material's bounds."""
    alpha = np.clip(roughness, SMOOTHEST, 1.0) ** 2
    found: Floats = np.clip(2 / alpha**2 - 2, 1.0, 1000.0)
    return found


def reflectances(
    base: Floats, metalness: Floats | float, roughness: Floats | float, specular: Floats | float
) -> tuple[Floats, Floats]:
    """Return the diffuse and the specular reflectance of base colours (..., 3), 0 to 1.

    metalness, roughness: numbers, or (..., 1). specular: of the parts that are not metal.
    """
    # A wide highlight would reflect too much light, because Blinn and Phong's is not normalized.
    strength = np.minimum((exponent(roughness) + 2) / NARROW, 1.0)
    diffuse = base * (1 - (1 - METAL_DIFFUSE) * metalness)
    return diffuse, strength * (specular + (base - specular) * metalness)


def sized_alike(texels: NDArray[np.uint8], metal: Metal) -> tuple[NDArray[np.uint8], ...]:
    """Return a texture's texels and the metal's in one size: that of the larger image."""
    large = max(texels.shape[:2], metal.texels.shape[:2], key=lambda size: size[0] * size[1])
    return tuple(_resized(image, large) for image in (texels, metal.texels))


def _resized(texels: NDArray[np.uint8], size: tuple[int, int]) -> NDArray[np.uint8]:
    if texels.shape[:2] == size:
        return texels
    from PIL import Image

    image = Image.fromarray(np.ascontiguousarray(texels))
    return np.asarray(image.resize((size[1], size[0]), Image.Resampling.BILINEAR))


def packed_metal(
    texels: NDArray[np.uint8],
    metal_texels: NDArray[np.uint8],
    metal: Metal,
    diffuse: tuple[float, float, float],
    specular: tuple[float, float, float],
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the images that a material with a metal shows, packed: the diffuse light, which
    `diffuse` multiplies, and the specular light. texels, metal_texels: of sized_alike()."""
    light = from_srgb(np.arange(256, dtype=np.float32) / np.float32(255))
    steps = np.arange(256, dtype=np.float32) / np.float32(255)
    found = np.empty((2, *texels.shape[:2]), np.int32)
    for start in range(0, len(texels), ROWS):
        rows = slice(start, start + ROWS)
        base = light[texels[rows, :, :3]]
        roughness = steps[metal_texels[rows, :, 1:2]] * np.float32(metal.roughness)
        metalness = steps[metal_texels[rows, :, 2:3]] * np.float32(metal.metalness)
        tinted = base * np.array(diffuse, np.float32)
        _, shine = reflectances(tinted, metalness, roughness, np.array(specular, np.float32))
        matt, _ = reflectances(base, metalness, roughness, 0.0)
        found[0, rows], found[1, rows] = packed_light(matt), packed_light(shine)
    return found[0], found[1]
