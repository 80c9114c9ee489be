"""A flat scene as JSON: arrays in base64, textures as PNG pictures.

modules/scene.js reads it.
"""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.png import png_of
from lucida.renderer.images.shared_numbers import TEXEL_BITS
from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.scene.texture import packed_texels
from lucida.renderer.system.errors import LucidaError

MOST_TRIANGLES = 200_000
MOST_TEXELS = 8_000_000
TYPES = {"f4": "Float32Array", "f8": "Float64Array", "i4": "Int32Array", "u1": "Uint8Array"}
DERIVED = (
    "face_object",
    "sphere_object",
    "object_sphere",
    "texels",
)  # by modules/scene.js
# The values of vertices without their own.
EMPTY = {"normals": 0.0, "colors": 1.0, "uv": 0.0}


def packed(flat: FlatScene, framed: NDArray[np.float64]) -> dict[str, Any]:
    """Return the scene as a JSON value.

    framed: points (n, 3) that a picture of it must contain. Raises LucidaError for more than
    MOST_TRIANGLES triangles or MOST_TEXELS texels.
    """
    _check(len(flat.faces), MOST_TRIANGLES, "triangles", "simplify the model")
    _check(len(flat.texels), MOST_TEXELS, "texels", "use smaller textures")
    arrays = {
        name: _array(np.zeros(0, array.dtype) if _is_empty(name, array) else array)
        for name, array in flat._asdict().items()
        if name not in DERIVED
    }
    if len(framed):
        arrays["focus"] = _array(np.concatenate([framed.min(axis=0), framed.max(axis=0)]))
    else:
        arrays["focus"] = arrays["bounds"]
    spheres = flat.sphere_object.tolist()
    return {"arrays": arrays, "sphere_object": spheres, "images": _images(flat)}


def _check(count: int, most: int, what: str, remedy: str) -> None:
    if count > most:
        raise LucidaError("scene", f"{count:,} {what} are more than {most:,}", remedy)


def _is_empty(name: str, array: NDArray[Any]) -> bool:
    return name in EMPTY and bool((array == EMPTY[name]).all())


def _array(array: NDArray[Any]) -> list[str]:
    little = array.astype(array.dtype.newbyteorder("<"), copy=False)
    kind = TYPES[array.dtype.str[1:]]
    return [kind, base64.b64encode(little.tobytes()).decode()]


def _images(flat: FlatScene) -> list[dict[str, Any]]:
    """Return the images of FlatScene.texels, each once, with their borders."""
    places: dict[int, tuple[int, int, bool]] = {}
    for (first, width, height, _), (gloss, opacity, _, _) in flat.textures.tolist():
        if width:
            places[first] = width + 1, height + 1, False
            if gloss >= 0:
                places[gloss] = width + 1, height + 1, False
            if opacity >= 0:
                places[opacity] = width + 1, height + 1, True
    images = []
    for first, (width, height, is_opacity) in sorted(places.items()):
        texels = flat.texels[first : first + width * height].reshape(height, width)
        picture, values = _opacity(texels) if is_opacity else _colors(texels)
        png = base64.b64encode(png_of(picture)).decode()
        images.append({"first": first, "opacity": is_opacity, "values": values, "png": png})
    return images


def _opacity(texels: NDArray[np.int32]) -> tuple[NDArray[np.uint8], list[int]]:
    """Return an index into the values for each texel, (height, width), and the values."""
    values, numbers = np.unique(texels, return_inverse=True)
    return numbers.reshape(texels.shape).astype(np.uint8), values.tolist()


def _colors(texels: NDArray[np.int32]) -> tuple[NDArray[np.uint8], list[int]]:
    """Return a picture in sRGB, (height, width, 3), and FlatScene's number for each of the 256
    bytes.
    """
    gray = np.arange(256, dtype=np.uint8)[None, :, None].repeat(3, axis=2)
    most = (1 << TEXEL_BITS) - 1
    values = packed_texels(gray)[0] & most
    # Every value of an 8-bit picture is among these. A metal's light becomes the nearest one.
    middles = (values[1:] + values[:-1] + 1) // 2
    shifts = TEXEL_BITS * np.arange(3)
    channels = (texels[..., None] >> shifts) & most
    return np.searchsorted(middles, channels, "right").astype(np.uint8), values.tolist()
