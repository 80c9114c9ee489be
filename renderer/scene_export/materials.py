"""Materials and lights of physically based renderers that look like Lucida's.

Blinn and Phong's highlight, specular * (n . h)^p, becomes a microfacet highlight with the same
width and peak: a roughness alpha with alpha^2 = 2 / (p + 2), whose peak is F0 / (4 alpha^2).
Source: Karis 2013, "Specular BRDF reference"; Walter et al. 2007, "Microfacet models".
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.images.display import from_srgb, to_srgb8
from renderer.images.png import write_png
from renderer.scene.flat import FlatScene
from renderer.scene.model import Color, Material, PointLight, Scene, without_metal
from renderer.scene.texture import Texture
from renderer.scene_export.what import LeftOut, called

MOST_REFLECTED = 0.9  # of the light at normal incidence
FAR = 1e4  # in units of the scene's size: farther from the origin, float32's rounding is visible


@dataclass(frozen=True)
class Microfacets:
    """A microfacet lobe. alpha: the roughness, root mean square slope. f0: the reflectance at
    normal incidence, each 0 to 1.
    """

    alpha: float
    f0: Color

    @property
    def strongest(self) -> float:
        return max(self.f0)

    @property
    def eta(self) -> float:
        """The refractive index with the strongest colour's reflectance."""
        root = math.sqrt(self.strongest)
        return (1 + root) / (1 - root)


def microfacets(material: Material) -> Microfacets | None:
    """Return the equivalent of the highlight; None for a material without one."""
    if not any(material.specular):
        return None
    squared = 2 / (material.shininess + 2)
    red, green, blue = (min(4 * squared * part, MOST_REFLECTED) for part in material.specular)
    return Microfacets(math.sqrt(squared), (red, green, blue))


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


def note_texture(material: Material, name: str, left: LeftOut) -> None:
    """Note a texture that is lost in targets, or shapes of theirs, without images."""
    if material.texture is not None:
        left.add(f"texture of {name}", "no image was written; the mean of its colours was")


def note_surface(material: Material, name: str, left: LeftOut) -> Material:
    """Return a material for targets without metals and holes, and note what is lost."""
    if material.metal is not None:
        left.add(f"metal of {name}", "no image was written; what it looks like from far away was")
    if material.cutout is not None:
        left.add(f"holes of {name}", "they are closed there")
    if material.single_sided:
        left.add(f"backs of {name}", "they are seen there")
    return without_metal(material)


def product(color: Color, by: Iterable[float]) -> Color:
    red, green, blue = (part * factor for part, factor in zip(color, by, strict=True))
    return red, green, blue


class Tiling(NamedTuple):
    """An image for a target that repeats it in the same way along both u and v.

    is_doubled: append its mirror image, along u and v. place: (2, 3), maps (u, v, 1) to the
    position in the image.
    """

    wrap: str
    is_doubled: tuple[bool, bool]
    place: NDArray[np.float64]


def tiling(texture: Texture, mirrors: bool, name: str, left: LeftOut) -> Tiling:
    """Return a texture's tiling for a target. mirrors: the target supports mirrored images."""
    first, second = texture.wrap
    if first == second and (mirrors or first != "mirror"):
        return Tiling(first, (False, False), texture.place)
    if "clamp" in texture.wrap:
        left.add(f"texture of {name}", "it goes on along u and v in one way there, by repetition")
    doubled = first == "mirror", second == "mirror"
    return Tiling("repeat", doubled, texture.place / [[1 + is_one] for is_one in doubled])


def picture_bytes(texture: Texture, tint: Color, is_doubled: tuple[bool, bool]) -> bytes:
    """Return a texture's image as a PNG file, its light multiplied by a colour, without opacity."""
    texels = np.ascontiguousarray(texture.texels[..., :3])
    if tint != (1.0, 1.0, 1.0):
        light = from_srgb(np.arange(256, dtype=np.uint8))[:, None] * np.array(tint, np.float32)
        texels = np.take_along_axis(to_srgb8(light), texels.reshape(-1, 3), axis=0)
        texels = texels.reshape(*texture.texels.shape[:2], 3)
    if is_doubled[0]:
        texels = np.concatenate([texels, texels[:, ::-1]], axis=1)
    if is_doubled[1]:
        texels = np.concatenate([texels[::-1], texels])
    file = io.BytesIO()
    write_png(file, texels)
    return file.getvalue()


def light_strengths(scene: Scene, flat: FlatScene, left: LeftOut) -> list[Color]:
    """Return each light's strength in radiometric units, with which a diffuse surface is as bright
    as in Lucida.

    It is the irradiance of a directional light, and the intensity of a point light. For a point
    light, the brightness is equal at the centre of an object at the median distance.
    """
    middles = np.ones((len(scene.objects), 4))
    middles[:, :3] = flat.object_bounds.mean(axis=1)
    places = np.einsum("nij,nj->ni", flat.world_from_object, middles)[:, :3]
    places = places[[not entry.hidden for entry in scene.objects]]
    strengths = []
    for number, light in enumerate(scene.lights):
        factor = math.pi
        if isinstance(light, PointLight):
            distances = np.linalg.norm(places - np.asarray(light.position), axis=1)
            away = float(np.median(distances)) if len(distances) else 1.0
            factor *= away**2 or 1.0
            left.add(
                called("light", number, ""),
                "its light falls off with the square of the distance there; it is as bright as "
                f"here {away:.3g} units away",
            )
        red, green, blue = (factor * part for part in light.color)
        strengths.append((red, green, blue))
    return strengths


def note_highlights(scene: Scene, left: LeftOut) -> None:
    if any(any(entry.material.specular) for _, entry in scene.visible):
        left.add(
            "highlights",
            "microfacets, as wide and as bright in the middle, stand for (n . h)^shininess",
        )


def note_shadows(scene: Scene, left: LeftOut) -> None:
    if scene.lights and scene.visible:
        left.add("shadows", "objects shade one another there, as here with shadows on")


def note_surroundings(scene: Scene, left: LeftOut) -> None:
    """Note the losses for renderers whose ambient light is also the visible background."""
    if any(scene.ambient):
        left.add(
            "ambient", "a constant light from all around, which surfaces also shade from each other"
        )
    if scene.background != scene.ambient:
        behind = "the ambient light" if any(scene.ambient) else "black"
        left.add("background", f"its colour would light the scene; {behind} is seen there")


def note_far(bounds: NDArray[np.float64], left: LeftOut) -> None:
    """Note if the scene is too far from the origin for renderers whose world space is float32."""
    away, extent = float(np.abs(bounds).max()), float((bounds[1] - bounds[0]).max())
    if away > FAR * extent > 0:
        step = float(np.spacing(np.float32(away)))
        left.add("place", f"points {away:.3g} units from the origin are {step:.2g} apart there")
