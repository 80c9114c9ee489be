"""The images of a glTF file's materials, and the texture coordinates of its vertices.

A fault in them costs a note, not the model.
Source: Khronos, glTF 2.0 Specification; KHR_texture_transform; EXT_texture_webp.
"""

from __future__ import annotations

import math
import urllib.parse
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene.gltf_file import (
    Gltf,
    Index,
    OpenGltf,
    Primitive,
    entry_at,
    from_base64,
    invalid,
)
from renderer.scene.gltf_numbers import read_numbers
from renderer.scene.images import FoundImage, ModelImages, decode_image, read_image, shown
from renderer.scene.texture import Texture

WRAP_NAMES = {10497: "repeat", 33648: "mirror", 33071: "clamp"}
TRANSFORM, WEBP = "KHR_texture_transform", "EXT_texture_webp"


class TextureInfo(msgspec.Struct, rename="camel"):
    index: Index
    tex_coord: Index = 0
    extensions: dict[str, Any] = {}

    @property
    def transform(self) -> TextureTransform:
        return msgspec.convert(self.extensions.get(TRANSFORM, {}), TextureTransform)

    @property
    def attribute(self) -> str:
        own = self.transform.tex_coord
        return f"TEXCOORD_{self.tex_coord if own is None else own}"


class TextureTransform(msgspec.Struct, rename="camel"):
    offset: tuple[float, float] = (0.0, 0.0)
    scale: tuple[float, float] = (1.0, 1.0)
    rotation: float = 0.0
    tex_coord: Index | None = None


class GltfTexture(msgspec.Struct, rename="camel"):
    source: Index | None = None
    sampler: Index | None = None
    extensions: dict[str, Any] = {}


class GltfImage(msgspec.Struct, rename="camel"):
    uri: str | None = None
    buffer_view: Index | None = None


class GltfSampler(msgspec.Struct, rename="camel"):
    wrap_s: int = 10497
    wrap_t: int = 10497


def coordinates_of(tree: Gltf, primitive: Primitive, is_mapped: bool) -> int | None:
    """Return the accessor of a primitive's texture coordinates, if its material has an image.

    is_mapped: without an image, the accessor of its first coordinates.
    """
    number, given = primitive.material, None
    if number is not None and number < len(tree.materials):
        pbr = tree.materials[number].pbr_metallic_roughness
        given = pbr.base_color_texture
        given = pbr.metallic_roughness_texture if given is None else given
    if given is None:
        return primitive.attributes.get("TEXCOORD_0") if is_mapped else None
    try:
        return primitive.attributes.get(msgspec.convert(given, TextureInfo).attribute)
    except msgspec.ValidationError:
        return None


def read_coordinates(file: OpenGltf, number: int) -> NDArray[Any]:
    """Return an accessor's texture coordinates, (n, 2), v up. Raises LucidaError."""
    raw = read_numbers(file, number, ("VEC2",), "TEXCOORD")
    uv = raw.astype(np.float32)
    if raw.dtype.kind in "ui" and file.tree.accessors[number].normalized:
        uv = np.maximum(uv / np.float32(np.iinfo(raw.dtype).max), -1)
    uv[:, 1] = 1 - uv[:, 1]
    return uv


def read_texture(
    file: OpenGltf, given: Any, images: ModelImages, has_opacity: bool = False
) -> tuple[Texture, str] | None:
    """Return the texture of a material's textureInfo, and the attribute with its coordinates; None
    if it cannot be read, which is noted.

    has_opacity: keep the image's opacity.
    """
    tree = file.tree
    try:
        info = msgspec.convert(given, TextureInfo)
        texture = _entry(tree.textures, info.index, GltfTexture, "textures")
        webp = texture.extensions.get(WEBP)
        number = texture.source
        if isinstance(webp, dict) and isinstance(webp.get("source"), int):
            number = webp["source"]
        if number is None:
            problem = "has no image of a known kind"
            raise LucidaError(f"textures[{info.index}]", problem, "export it with PNG")
        image = _entry(tree.images, number, GltfImage, "images")
        sampler = GltfSampler()
        if texture.sampler is not None:
            sampler = _entry(tree.samplers, texture.sampler, GltfSampler, "samplers")
        transform = info.transform
        found = images.get(
            f"images[{number}]" + ", opacity" * has_opacity,
            lambda: _read(file, image, f"images[{number}]", has_opacity),
        )
        if found is None:
            return None
        (scale_u, scale_v), (offset_u, offset_v) = transform.scale, transform.offset
        # In glTF, v counts downwards, and the rotation is about the upper left corner.
        sine, cosine = math.sin(transform.rotation), math.cos(transform.rotation)
        made = Texture(
            found.pixels,
            (_wrap(sampler.wrap_s), _wrap(sampler.wrap_t)),
            (scale_u, scale_v),
            (offset_u + scale_v * sine, 1.0 - scale_v * cosine - offset_v),
            found.file,
            math.degrees(transform.rotation),
        )
        return made, info.attribute
    except msgspec.ValidationError as error:
        images.note(f"{invalid(error)}; the plain colour is shown")
    except LucidaError as error:
        images.note(f"{error}; the plain colour is shown")
    return None


def _wrap(number: int) -> str:
    return WRAP_NAMES.get(number, "repeat")


def _entry(entries: Any, number: int, kind: Any, field: str) -> Any:
    found = entry_at(entries if isinstance(entries, list) else [], number, field)
    return msgspec.convert(found, kind)


def _read(file: OpenGltf, image: GltfImage, field: str, has_opacity: bool) -> FoundImage:
    try:
        if image.buffer_view is not None:
            return FoundImage(decode_image(bytes(file.view(image.buffer_view, field)), has_opacity))
        if image.uri is None:
            raise LucidaError("", "has neither uri nor bufferView", "export it again")
        if image.uri.startswith("data:"):
            head, _, text = image.uri.partition(",")
            if not head.endswith(";base64"):
                raise LucidaError("", "is not base64", "export it again")
            return FoundImage(decode_image(from_base64(text, ""), has_opacity))
        if urllib.parse.urlsplit(image.uri).scheme:
            raise LucidaError("", f"{shown(image.uri)} is not a file", "put the image beside it")
        return read_image(urllib.parse.unquote(image.uri), file.path.parent, has_opacity)
    except LucidaError as error:  # an error of the buffer view names its own field
        raise LucidaError(error.field or field, error.problem, error.remedy) from None
    except ValueError:  # an address that is none
        raise LucidaError(field, "is not base64", "export it again") from None
