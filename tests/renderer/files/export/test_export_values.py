"""The numbers in exported files: zeros, lights, highlights, hidden objects, bounds."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from test_company import CAMERA, SIZE, objects, scene_of

from lucida.renderer.files.export.gltf_scene import glb_of
from lucida.renderer.scene import Scene, shapes
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    Checker,
    DirectionalLight,
    Mesh,
    PointLight,
    SceneObject,
    Sphere,
)

BLACK = (0.0, 0.0, 0.0)
SUN = DirectionalLight((-1, -2, -3), (0.5, 0.25, 1.0))


def glb(scene: Scene) -> tuple[dict, bytes]:
    """A .glb file's tree, in which no number is NaN or infinite, and its binary chunk."""
    data, _ = glb_of(scene, CAMERA, SIZE)
    assert data[:8] == b"glTF\2\0\0\0" and int.from_bytes(data[8:12], "little") == len(data)
    length = int.from_bytes(data[12:16], "little")
    assert length % 4 == 0 and data[16:20] == b"JSON"
    tree = json.loads(data[20 : 20 + length], parse_constant=pytest.fail)
    binary = data[20 + length :]
    if binary:
        assert int.from_bytes(binary[:4], "little") == len(binary) - 8 and len(binary) % 4 == 0
        assert binary[4:8] == b"BIN\0"
    return tree, binary[8:]


# Zeros.

NOTHING = [
    Scene((), ambient=BLACK),
    Scene((SceneObject(shapes.box(), Material(BLACK, checker=Checker(BLACK))),), ambient=BLACK),
    Scene((SceneObject(Sphere()),), (DirectionalLight((0, -1, 0), BLACK),)),
    Scene((SceneObject(Sphere((1, 2, 3))),), (PointLight((1, 2, 3)), PointLight((1, 2, 3), BLACK))),
    Scene((SceneObject(Mesh([[0, 0, 0]] * 3, [[0, 1, 2]]), Material(checker=Checker())),)),
    Scene((SceneObject(Mesh([[0, 0, 0]] * 3, [[0, 1, 2]], [[0, 1, 0], [0, 0, 0], [0, 1, 0]])),)),
    Scene((SceneObject(Sphere(), Material(BLACK, (50.0, 50.0, 50.0), 1)),), (SUN,)),
]


@pytest.mark.parametrize("scene", NOTHING)
def test_no_number_is_infinite_where_something_is_zero(scene: Scene):
    with np.errstate(all="raise", under="ignore"):
        tree, binary = glb(scene)
    assert np.isfinite(np.frombuffer(binary, "<f4")).all()
    lights = tree.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for light, there in zip(scene.lights, lights, strict=True):
        assert any(light.color) == bool(there["intensity"])  # wherever a point light is


def test_lights_are_as_strong_as_a_diffuse_surface_wants_them():
    # An object at a distance of 5, and one that is hidden and does not count.
    hidden = SceneObject(Sphere((0, 0, 100)), hidden=True)
    scene = Scene(
        (SceneObject(Sphere((0, 3, 0))), hidden), (PointLight((4, 0, 0), (1, 0.5, 0)), SUN)
    )
    strong = [25 * math.pi * np.array((1, 0.5, 0)), math.pi * np.array(SUN.color)]
    found = glb(scene)[0]["extensions"]["KHR_lights_punctual"]["lights"]
    products = [np.array(light["color"]) * light["intensity"] for light in found]
    np.testing.assert_allclose(products, strong)
    assert all(max(light["color"]) == 1 for light in found)


@given(st.floats(1, 1000), st.tuples(*[st.floats(0.001, 2)] * 3))
@settings(max_examples=20, deadline=None, derandomize=True, phases=[Phase.generate])
def test_highlights_are_as_wide_and_as_bright_in_the_middle(shininess, specular):
    scene = Scene((SceneObject(Sphere(), Material(BLACK, specular, shininess)),), (SUN,))
    squared = 2 / (shininess + 2)
    f0 = np.minimum(4 * squared * np.array(specular), 0.9)
    (table,) = glb(scene)[0]["materials"]
    extension = table["extensions"]["KHR_materials_specular"]
    np.testing.assert_allclose(np.array(extension["specularColorFactor"]) * 0.04, f0)
    assert table["pbrMetallicRoughness"]["roughnessFactor"] ** 4 == pytest.approx(squared)


# What is seen.


def test_what_is_hidden_is_not_written():
    seen = SceneObject(shapes.box(), name="seen")
    hidden = SceneObject(shapes.torus(), Material(specular=(1, 1, 1)), "hidden", hidden=True)
    data, _ = glb_of(Scene((hidden, seen)), CAMERA, SIZE)
    assert b"hidden" not in data and b"seen" in data


@given(objects)
@settings(max_examples=25, deadline=None, derandomize=True, phases=[Phase.generate])
def test_a_glb_is_aligned_and_its_bounds_hold(entry: SceneObject):
    tree, binary = glb(scene_of(entry))
    (buffer,), end = tree["buffers"], 0
    for view in tree["bufferViews"]:
        assert view["byteOffset"] % 4 == 0 and view["byteOffset"] >= end
        end = view["byteOffset"] + view["byteLength"]
    assert end <= buffer["byteLength"] == len(binary)
    for primitive in (p for mesh in tree["meshes"] for p in mesh["primitives"]):
        accessor = tree["accessors"][primitive["attributes"]["POSITION"]]
        view = tree["bufferViews"][accessor["bufferView"]]
        values = np.frombuffer(binary, "<f4", 3 * accessor["count"], view["byteOffset"])
        np.testing.assert_array_equal(values.reshape(-1, 3).min(axis=0), accessor["min"])
        np.testing.assert_array_equal(values.reshape(-1, 3).max(axis=0), accessor["max"])
    assert tree["extensionsUsed"] == ["KHR_lights_punctual", "KHR_materials_specular"]


def test_what_is_left_out_is_a_line_each():
    odd = SceneObject(shapes.torus(), Material((2, 2, 2), (1, 0, 0), checker=Checker()), "a\nb")
    _, told = glb_of(Scene((odd, odd), (SUN,)), CAMERA, SIZE)
    assert len(set(told)) == len(told) and not any("\n" in line for line in told)
    assert any("reflects more than all light" in line for line in told)
    assert any(line.startswith("highlight") for line in told)
