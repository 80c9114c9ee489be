"""The classes of a scene: what they take, what they keep, and how they are packed."""

import re

import numpy as np
import pytest

from lucida.renderer.images.shared_numbers import TEXEL_BITS
from lucida.renderer.scene import flat_textures
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.limits import TEXTURE_SIDE
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.metal import METAL_DIFFUSE, Metal, packed_metal
from lucida.renderer.scene.model import DirectionalLight, Scene, SceneObject, Sphere
from lucida.renderer.scene.texture import (
    OPACITY_STEPS,
    Texture,
    packed_light,
    packed_opacity,
    packed_texels,
)
from lucida.renderer.system.errors import LucidaError
from tests.support.textured import noise

WHITE = np.full((1, 1, 3), 255, np.uint8)
PACKED_WHITE = (1 << 3 * TEXEL_BITS) - 1  # every bit is set


def test_a_scene_keeps_tuples_of_what_its_caller_may_change():
    objects, lights = [SceneObject(Sphere())], [DirectionalLight((0, 0, -1))]
    scene = Scene(objects, lights)
    objects.clear()
    lights.clear()
    assert len(scene.objects) == len(scene.lights) == 1


def test_a_textures_turn_is_a_float_of_python():
    assert type(Texture(WHITE, rotate_deg=np.float32(90)).rotate_deg) is float


@pytest.mark.parametrize(
    ("texels", "told"),
    [
        (np.zeros((2, 2, 3)), "texels: is float64 of shape (2, 2, 3)"),
        (np.zeros((2, 2), np.uint8), "texels: is uint8 of shape (2, 2)"),
        (np.zeros((2, 2, 2), np.uint8), "texels: is uint8 of shape (2, 2, 2)"),
        (np.zeros((2, 0, 3), np.uint8), "texels: is 0x2"),
        (np.zeros((1, TEXTURE_SIDE + 1, 3), np.uint8), f"texels: is {TEXTURE_SIDE + 1}x1"),
    ],
)
def test_texels_of_another_kind_or_size_are_refused(texels, told):
    with pytest.raises(LucidaError, match=re.escape(told)):
        Texture(texels)


def test_white_texels_and_full_light_set_every_bit():
    assert packed_texels(WHITE) == packed_light(np.full((1, 1, 3), 1.5)) == PACKED_WHITE


def test_opacity_is_told_from_the_cutout_and_is_full_without_a_channel():
    assert packed_opacity(WHITE, 0.25) == 0.75 * OPACITY_STEPS
    half = np.array([[[9, 9, 9, 51]]], np.uint8)
    assert packed_opacity(half, 0.7) == -0.5 * OPACITY_STEPS


def test_a_white_dielectric_is_white_and_a_white_metal_has_metals_diffuse_part():
    one = 1.0, 1.0, 1.0
    matt, _ = packed_metal(WHITE, WHITE, Metal(metalness=0), one, one)
    assert matt == packed_light(np.full((1, 1, 3), 1.0))
    matt, shine = packed_metal(WHITE, WHITE, Metal(metalness=1, roughness=0.2), one, one)
    assert matt == packed_light(np.full((1, 1, 3), METAL_DIFFUSE))
    assert shine == PACKED_WHITE


def test_the_images_of_a_scene_may_have_only_so_many_texels_together(monkeypatch):
    balls = [SceneObject(Sphere(), Material(texture=Texture(noise(3, 4, k)))) for k in (1, 2)]
    monkeypatch.setattr(flat_textures, "TEXELS", 2 * 4 * 5)  # each has a border
    assert flatten(Scene(balls)).textures[:, 0].tolist() == [[0, 3, 4, 0], [20, 3, 4, 0]]
    monkeypatch.setattr(flat_textures, "TEXELS", 2 * 4 * 5 - 1)
    with pytest.raises(LucidaError, match=r"textures: the scene's images have more than"):
        flatten(Scene(balls))


def test_the_arrays_of_a_scene_with_other_images_are_its_own():
    first, other = (
        Scene([SceneObject(Sphere(), Material(texture=Texture(noise(3, 4, k))))]) for k in (1, 2)
    )
    known = flatten(first)
    assert flatten(first, (first, known)).texels is known.texels
    changed = flatten(other, (first, known)).texels
    assert changed.tolist() == flatten(other).texels.tolist() != known.texels.tolist()
