"""The images of a glTF file's materials, and the texture coordinates of its vertices.

A fault in them costs a note, not the model.
Source: Khronos, glTF 2.0 Specification; KHR_texture_transform; EXT_texture_webp.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.models.gltf_file import (
    GltfImage,
    GltfSampler,
    GltfTexture,
    OpenGltf,
    TextureInfo,
    entry_at,
)
from lucida.renderer.files.models.gltf_numbers import read_numbers, scaled
from lucida.renderer.files.texture_images import FoundImage, ModelImages, decode_image
from lucida.renderer.scene.limits import IMAGE_BYTES
from lucida.renderer.scene.texture import Texture
from lucida.renderer.system.errors import LucidaError

WRAP_NAMES = {10497: "repeat", 33648: "mirror", 33071: "clamp"}


def read_coordinates(file: OpenGltf, number: int) -> NDArray[Any]:
    """Return an accessor's texture coordinates, (n, 2), v up. Raises LucidaError."""
    raw = read_numbers(file, number, ("VEC2",), "TEXCOORD")
    uv = scaled(raw, file, number).astype(np.float32)
    uv[:, 1] = 1 - uv[:, 1]
    return uv


def read_texture(
    file: OpenGltf, info: TextureInfo, images: ModelImages, has_opacity: bool = False
) -> Texture | None:
    """Return the texture of a material's textureInfo; None if it cannot be read, which is noted.

    has_opacity: keep the image's opacity.
    """
    tree = file.tree
    try:
        texture: GltfTexture = entry_at(tree.textures, info.index, "textures")
        webp = texture.extensions.webp
        number = texture.source if webp is None else webp.source
        if number is None:
            problem = "has no image of a known kind"
            raise LucidaError(f"textures[{info.index}]", problem, "export it with PNG")
        image: GltfImage = entry_at(tree.images, number, "images")
        sampler = GltfSampler()
        if texture.sampler is not None:
            sampler = entry_at(tree.samplers, texture.sampler, "samplers")
        found = images.get(
            f"images[{number}]" + ", opacity" * has_opacity,
            lambda: _read(file, image, f"images[{number}]", has_opacity),
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


def _read(file: OpenGltf, image: GltfImage, field: str, has_opacity: bool) -> FoundImage:
    if image.uri is None:
        data, path = bytes(file.view(image.buffer_view, field)[0]), None
    else:
        data, path = file.resource(image.uri, field, IMAGE_BYTES)
    try:
        return FoundImage(decode_image(data, has_opacity), path)
    except LucidaError as error:
        name = f"{path.name!r} " if path is not None else ""
        raise LucidaError(field, name + error.problem, error.remedy) from None
