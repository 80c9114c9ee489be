"""Materials, and the checks of colours, vectors and lengths."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from lucida.renderer.camera.checks import number, numbers
from lucida.renderer.images.display import from_srgb
from lucida.renderer.system.errors import LucidaError

from .metal import Metal, reflectances
from .texture import WHITE, Texture

Color = tuple[float, float, float]

BRIGHTEST = 1e6
_HEX = re.compile(r"#([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})")


def vector(name: str, value: Iterable[float]) -> tuple[float, float, float]:
    """Return three finite numbers as a tuple. Raises LucidaError that names them."""
    x, y, z = numbers(name, value, 3)
    return x, y, z


def color(name: str, value: Iterable[float]) -> Color:
    """Return three finite numbers >= 0 as a tuple. Raises LucidaError that names them."""
    rgb = vector(name, value)
    for component in rgb:
        if not 0 <= component <= BRIGHTEST:
            raise LucidaError(
                name, f"{component:g} is outside 0 to {BRIGHTEST:g}", "give red, green, blue >= 0"
            )
    return rgb


def length(field: str, value: float, least: float, remedy: str) -> float:
    """Return a length of at least `least`. Raises LucidaError naming it."""
    found = number(field, value)
    if found < least:
        wrong = f"is below {least:g}" if found > 0 else "is not above 0"
        raise LucidaError(field, f"{found:g} {wrong}", remedy)
    return found


def parse_color(name: str, value: str | Iterable[float]) -> Color:
    """Return a colour as linear light: [red, green, blue] unchanged, or an sRGB "#rrggbb"."""
    if not isinstance(value, str):
        return color(name, value)
    match = _HEX.fullmatch(value)
    if not match:
        raise LucidaError(
            name, f"{value[:40]!r} is not a colour", 'give "#rrggbb" or [red, green, blue]'
        )
    red, green, blue = from_srgb(np.array([int(part, 16) for part in match.groups()], np.uint8))
    return float(red), float(green), float(blue)


@dataclass(frozen=True)
class Checker:
    """A solid pattern of cubes in object space: every other cell takes `diffuse`.

    size: a cell's side, in the object's units; one cell is centred on the object's origin.
    """

    diffuse: Color = (0.05, 0.05, 0.05)
    size: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "diffuse", color("diffuse", self.diffuse))
        size = length("size", self.size, 1e-6, "give a cell's side, e.g. 1")
        object.__setattr__(self, "size", size)


@dataclass(frozen=True)
class Material:
    """Blinn and Phong's shading: diffuse and specular reflectance, and the highlight's exponent.

    The pattern is a checker, a texture, whose colours diffuse multiplies, or none. metal: a map of
    the parts that are metal; specular is then the reflectance of the other parts. cutout and
    single_sided apply only to triangles. There is a hole where the texture's opacity is less than
    cutout. Single-sided triangles are visible only from the side on which their corners are
    counter-clockwise in the object's space, but still cast shadows.
    """

    diffuse: Color = (0.7, 0.7, 0.7)
    specular: Color = (0.0, 0.0, 0.0)
    shininess: float = 50.0
    checker: Checker | None = None
    texture: Texture | None = None
    metal: Metal | None = None
    cutout: float | None = None
    single_sided: bool = False

    @property
    def image(self) -> Texture | None:
        """Return the image on the surface: the texture, or white if there is only a metal."""
        return self.texture or (WHITE if self.metal is not None else None)

    def __post_init__(self) -> None:
        for name in ("diffuse", "specular"):
            object.__setattr__(self, name, color(name, getattr(self, name)))
        object.__setattr__(self, "single_sided", bool(self.single_sided))
        for name in ("shininess", "cutout"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, number(name, value))
        if not 1 <= self.shininess <= 1000:
            raise LucidaError(
                "shininess", f"{self.shininess:g} is outside 1 to 1000", "give e.g. 50"
            )
        if self.checker is not None and self.image is not None:
            given = "metal" if self.texture is None else "texture"
            raise LucidaError(given, "is given, and so is a checker", "give one of them")
        if self.cutout is not None and not 0 < self.cutout <= 1e6:
            problem = f"{self.cutout:g} is not an opacity above 0"
            raise LucidaError("cutout", problem, "give e.g. 0.5")


def without_metal(material: Material) -> Material:
    """Return a material without a metal and with the same texture, if any, that looks alike from
    far away.
    """
    if material.metal is None or material.image is None:
        return material
    light = from_srgb(material.image.texels[..., :3].reshape(-1, 3).mean(axis=0) / np.float32(255))
    diffuse, metal = np.array(material.diffuse), material.metal
    matt, _ = reflectances(diffuse, *metal.mean, 0.0)
    _, shine = reflectances(diffuse * light, *metal.mean, np.array(material.specular))
    return replace(
        material, diffuse=tuple(matt.tolist()), specular=tuple(shine.tolist()), metal=None
    )
