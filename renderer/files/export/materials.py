"""Materials and lights of physically based renderers that look like Lucida's.

Blinn and Phong's highlight, specular * (n . h)^p, becomes a microfacet highlight with the same
width and peak: a roughness alpha with alpha^2 = 2 / (p + 2), whose peak is F0 / (4 alpha^2).
Source: Karis 2013, "Specular BRDF reference"; Walter et al. 2007, "Microfacet models".
"""

from __future__ import annotations

import math

import numpy as np

from lucida.renderer.images.display import from_srgb
from lucida.renderer.scene.framing import median_distance
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Color, PointLight, Scene
from lucida.renderer.system.errors import one_line

MOST_REFLECTED = 0.9  # of the light at normal incidence


class LeftOut:
    """A list of what could not be carried over, without duplicates."""

    def __init__(self) -> None:
        self._lines: dict[str, None] = {}

    def add(self, what: str, why: str) -> None:
        """Add the line `what: why`."""
        self._lines[one_line(f"{what}: {why}")] = None

    @property
    def lines(self) -> tuple[str, ...]:
        return tuple(self._lines)


def microfacets(material: Material) -> tuple[float, Color] | None:
    """Return the equivalent of the highlight; None for a material without one: the roughness alpha,
    the root mean square slope, and the reflectance at normal incidence, each 0 to 1.
    """
    if not any(material.specular):
        return None
    squared = 2 / (material.shininess + 2)
    red, green, blue = (min(4 * squared * part, MOST_REFLECTED) for part in material.specular)
    return math.sqrt(squared), (red, green, blue)


def reflectance(color: Color, what: str, left: LeftOut) -> Color:
    """Return a diffuse colour limited to 1, so that it reflects no more light than it receives."""
    if max(color) > 1:
        left.add(what, "its diffuse colour reflects more than all light; 1 was written")
    red, green, blue = (min(part, 1.0) for part in color)
    return red, green, blue


def mean_of_pattern(material: Material) -> Color:
    """Return the mean colour of a checker or a texture."""
    if material.texture is not None:
        light = from_srgb(material.texture.texels[..., :3].reshape(-1, 3) / np.float32(255))
        red, green, blue = (light.mean(axis=0, dtype=np.float64) * material.diffuse).tolist()
        return red, green, blue
    if material.checker is None:
        return material.diffuse
    red, green, blue = (
        (one + other) / 2
        for one, other in zip(material.diffuse, material.checker.diffuse, strict=True)
    )
    return red, green, blue


def light_strengths(scene: Scene, left: LeftOut) -> list[Color]:
    """Return each light's strength in radiometric units, with which a diffuse surface is as bright
    as in Lucida.

    It is the irradiance of a directional light, and the intensity of a point light. For a point
    light, the brightness is equal at the centre of an object at the median distance.
    """
    strengths = []
    for number, light in enumerate(scene.lights):
        factor = math.pi
        if isinstance(light, PointLight):
            away = median_distance(scene.objects, light.position)
            factor *= away**2
            left.add(
                f"light {number}",
                "its light falls off with the square of the distance there; it is as bright as "
                f"here {away:.3g} units away",
            )
        red, green, blue = (factor * part for part in light.color)
        strengths.append((red, green, blue))
    return strengths
