"""A scene for a page, unpacked again: arrays and images have the numbers of the flat scene."""

from __future__ import annotations

import base64
import io

import numpy as np
from PIL import Image

from lucida.app.web.packing import TYPES, packed
from lucida.renderer.images.shared_numbers import TEXEL_BITS
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.metal import Metal
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.scene.texture import Texture
from tests.support.textured import noise, wall

KINDS = {name: "<" + kind for kind, name in TYPES.items()}
CHANNELS = TEXEL_BITS * np.arange(3)


def unpacked(array):
    kind, text = array
    return np.frombuffer(base64.b64decode(text), KINDS[kind])


def texels_of(image):
    """Return the texels of a packed image, of one channel or three."""
    values = np.array(image["values"])
    picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(image["png"]))))
    return values[picture].reshape(-1, 1 if image["opacity"] else 3)


def test_arrays_and_images_are_those_of_the_flat_scene():
    opacity = np.random.default_rng(5).integers(0, 256, (4, 3, 1), np.uint8)
    cut = Texture(np.concatenate([noise(3, 4), opacity], axis=2))
    plain, shiny = Texture(noise(5, 2, 2)), Texture(noise(2, 2, 3))
    flat = flatten(
        Scene(
            (
                SceneObject(wall(cut), Material(texture=cut, cutout=0.5)),
                SceneObject(Sphere(), Material(texture=plain)),
                SceneObject(Sphere((3, 0, 0)), Material(texture=shiny, metal=Metal())),
            )
        )
    )
    scene = packed(flat, np.zeros((0, 3)))
    for name in ("vertices", "faces", "textures", "spheres", "uv", "bounds"):
        wanted = getattr(flat, name)
        np.testing.assert_array_equal(unpacked(scene["arrays"][name]), wanted.reshape(-1))
    assert scene["arrays"]["normals"][1] == ""  # none, and so zero everywhere
    assert scene["arrays"]["focus"] == scene["arrays"]["bounds"]

    (of_cut, _), (of_plain, _), (of_shiny, (gloss, *_)) = flat.textures
    hole = flat.textures[0, 1, 1]
    firsts = [of_cut[0], hole, of_plain[0], of_shiny[0], gloss]
    assert [image["first"] for image in scene["images"]] == firsts
    assert [image["opacity"] for image in scene["images"]] == [False, True, False, False, False]
    ends = [*firsts[1:], len(flat.texels)]
    for image, first, end in zip(scene["images"], firsts, ends, strict=True):
        wanted = flat.texels[first:end, None]
        if not image["opacity"]:
            wanted = wanted >> CHANNELS & (1 << TEXEL_BITS) - 1
        near = 3 if first in (of_shiny[0], gloss) else 0  # a metal's light is rounded
        np.testing.assert_allclose(texels_of(image), wanted, rtol=0, atol=near)


def test_the_focus_is_the_box_of_what_a_picture_must_contain():
    scene = packed(flatten(Scene((SceneObject(Sphere()),))), np.array([[1.0, 5, -2], [0, 7, 3]]))
    assert unpacked(scene["arrays"]["focus"]).tolist() == [0, 5, -2, 1, 7, 3]
