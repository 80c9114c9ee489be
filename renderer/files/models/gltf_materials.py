"""The materials of a glTF file, as the nearest ones that Lucida has, with notes on the differences.

A faulty image causes a note; the model is still read.
Source: Khronos, glTF 2.0 Specification; KHR_texture_transform.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from lucida.renderer.files.texture_images import FoundImage, ModelImages, decode_image
from lucida.renderer.scene.limits import IMAGE_BYTES
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.metal import DIELECTRIC, Metal, exponent, reflectances
from lucida.renderer.scene.model import Color
from lucida.renderer.scene.texture import WHITE, Texture, placed_alike
from lucida.renderer.system.errors import LucidaError

from .gltf_file import (
    MATERIALS,
    GltfImage,
    GltfMaterial,
    GltfSampler,
    GltfTexture,
    OpenGltf,
    TextureInfo,
)

WRAP_NAMES = {10497: "repeat", 33648: "mirror", 33071: "clamp"}


def read_materials(
    file: OpenGltf, used: Iterable[int | None], images: ModelImages
) -> dict[int, Material]:
    """Return the used materials, with their images. Note features that are not shown."""
    found, missing = {}, {}
    for number in sorted(number for number in used if number is not None):
        given = file.tree.entry("materials", number)
        found[number] = _material(file, given, images)
        missing.update(dict.fromkeys(_not_shown(given)))
    if missing:
        images.note(f"not shown: {', '.join(missing)}", "materials")
    return found


def _not_shown(given: GltfMaterial) -> Iterator[str]:
    """Yield the features of a material that are not shown."""
    if given.alpha_mode == "BLEND":
        yield "transparency (BLEND), which is drawn opaque"
    if given.normal_texture is not None:
        yield "normal maps"
    if given.occlusion_texture is not None:
        yield "occlusion"
    if any(given.emissive_factor):  # it multiplies the texture
        yield "emission"
    for name in given.extensions:
        yield MATERIALS.sub("", name).replace("_", " ")[:40]


def _material(file: OpenGltf, given: GltfMaterial, images: ModelImages) -> Material:
    """Return a material with the base colour and a highlight by roughness; see metal.py."""
    pbr = given.pbr_metallic_roughness
    *rgb, alpha = np.clip(np.nan_to_num(pbr.base_color_factor), 0, 1).tolist()
    base: Color = (rgb[0], rgb[1], rgb[2])
    cutout = None
    if given.alpha_mode == "MASK" and given.alpha_cutoff > 0:
        # The factor multiplies the opacity. A cutout above 1 leaves nothing.
        cutout = min(given.alpha_cutoff / max(alpha, 1e-6), 1e6)
    single_sided = not given.double_sided
    texture, metal = None, None
    if (base_map := pbr.base_color_texture) is not None:
        texture = _texture(file, base_map, images, cutout is not None)
    metalness, roughness = _factor(pbr.metallic_factor), _factor(pbr.roughness_factor)
    if (metal_map := pbr.metallic_roughness_texture) is not None:
        of_metal = _texture(file, metal_map, images)
        if of_metal is not None:
            metal = Metal(of_metal.texels, metalness, roughness, of_metal.file)
            metalness, roughness = metal.mean
            if base_map is None:
                texture = _white(of_metal)
            elif (
                texture is None
                or metal_map.attribute != base_map.attribute
                or not placed_alike(of_metal, texture)
            ):
                images.note("a metal lies otherwise than its base colour; its mean is shown")
                metal = None
    if metal is None and texture is not None and metalness > 0:
        metal = Metal(metalness=metalness, roughness=roughness)
    shininess = float(exponent(roughness))
    if metal is not None:
        specular = (DIELECTRIC,) * 3
        return Material(base, specular, shininess, None, texture, metal, cutout, single_sided)
    diffuse, shine = reflectances(np.array(base), metalness, roughness, DIELECTRIC)
    colors = tuple(diffuse.tolist()), tuple(shine.tolist())
    return Material(*colors, shininess, None, texture, None, cutout, single_sided)


def _factor(value: float) -> float:
    return min(max(value, 0.0), 1.0) if math.isfinite(value) else 1.0


def _white(metal: Texture) -> Texture | None:
    """Return white with the placement of a metal; None if none is needed."""
    if placed_alike(metal, WHITE):
        return None
    place = metal.wrap, metal.scale, metal.offset
    return Texture(WHITE.texels, *place, None, metal.rotate_deg)


def _texture(
    file: OpenGltf, info: TextureInfo, images: ModelImages, has_opacity: bool = False
) -> Texture | None:
    """Return the texture of a material's textureInfo; None if it cannot be read, which is noted.

    has_opacity: keep the image's opacity.
    """
    tree = file.tree
    try:
        given: GltfTexture = tree.entry("textures", info.index)
        if given.source is None:
            raise LucidaError("textures", "have no image of a known kind", "export it with PNG")
        image: GltfImage = tree.entry("images", given.source)
        sampler = GltfSampler()
        if given.sampler is not None:
            sampler = tree.entry("samplers", given.sampler)
        found = images.get(
            f"images[{given.source}]" + ", opacity" * has_opacity,
            lambda: _image(file, image, has_opacity),
        )
        if found is None:
            return None
        transform, wrap = info.extensions.transform, WRAP_NAMES.get
        (scale_u, scale_v), (offset_u, offset_v) = transform.scale, transform.offset
        # In glTF, v counts downwards, and the rotation is about the upper left corner.
        sine, cosine = math.sin(transform.rotation), math.cos(transform.rotation)
        return Texture(
            found.pixels,
            (wrap(sampler.wrap_s, "repeat"), wrap(sampler.wrap_t, "repeat")),
            (scale_u, scale_v),
            (offset_u + scale_v * sine, 1.0 - scale_v * cosine - offset_v),
            found.file,
            math.degrees(transform.rotation),
        )
    except LucidaError as error:
        images.note(f"{error}; the plain colour is shown")
    return None


def _image(file: OpenGltf, image: GltfImage, has_opacity: bool) -> FoundImage:
    if image.uri is None:
        data, path = bytes(file.view(image.buffer_view)[0]), None
    else:
        data, path = file.resource(image.uri, IMAGE_BYTES)
    return FoundImage(decode_image(data, has_opacity), path)
