"""An object among others is written as it is alone: what is shared between objects is the same."""

from __future__ import annotations

import itertools
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.files.export import export_scene
from lucida.renderer.scene import Scene, flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, DirectionalLight, Mesh, SceneObject
from lucida.renderer.scene.texture import WRAPS, Texture

SIZE = (12, 8)
CAMERA = Camera.look_at((3, 2, 6), (0, 0, 0), fov_y_deg=40, aspect=1.5)


def frozen(values, dtype=np.float32) -> np.ndarray:
    array = np.array(values, dtype)
    array.setflags(write=False)
    return array


# Two of each, so that any two objects have some of it in common. Vertices are told apart by all.
CORNERS = [frozen([[0, 0, k], [2, 0, 0], [2, 1 + k, 0], [0, 1, 0.5]]) for k in range(2)]
FACES = [frozen(f, np.int32) for f in ([[0, 1, 2], [0, 2, 3]], [[0, 1, 2], [3, 2, 0]])]
NORMALS = [None, *(frozen(np.tile(n, (4, 1))) for n in ((0, 0, 1.0), (0, 0.6, 0.8)))]
COLORS = [None, *(frozen(np.arange(12).reshape(4, 3) / 12 * k) for k in (1, 0.5))]
UV = [None, *(frozen([[0, 0], [k, 0], [k, 1], [0, 0.5]]) for k in (1, 2))]
TEXELS = [frozen(np.arange(18).reshape(2, 3, 3) * k, np.uint8) for k in (10, 14)]
TURNS = [
    np.eye(4),
    np.diag([-1.0, 1, 1, 1]),
    np.array([[2.0, 1, 0, 3], [0, 1, 0, 1], [0, 0, 1, 2], [0, 0, 0, 1]]),
]
PAIRS: list[object] = [(1.0, 1.0), (2.0, 0.5)]
COLOURS: list[object] = [(0.5, 0.25, 0.75), (1.0, 1.0, 1.0)]


POOLS: dict[str, list[object]] = {
    "vertices": [*CORNERS],
    "faces": [*FACES],
    "normals": [*NORMALS],
    "colors": [*COLORS],
    "uv": [*UV],
    "transform": [*TURNS],
    "pattern": ["plain", "checker", "texture"],
    "texels": [*TEXELS],
    "wrap": [*itertools.product(WRAPS, WRAPS)],
    "scale": PAIRS,
    "offset": PAIRS,
    "diffuse": COLOURS,
    "other": COLOURS,
    "size": [0.5, 1.0],
    "specular": [(0.0, 0.0, 0.0), (0.2, 0.1, 0.3), (0.3, 0.3, 0.3)],
    "shininess": [1.0, 40.0],
}


def made_of(chosen: dict[str, Any]) -> SceneObject:
    arrays = {name: chosen[name] for name in ("vertices", "faces", "normals", "colors", "uv")}
    mesh, pattern = Mesh(**arrays, transform=chosen["transform"]), {}
    if chosen["pattern"] == "texture" and mesh.uv is not None:
        texture = Texture(*(chosen[name] for name in ("texels", "wrap", "scale", "offset")))
        pattern = {"texture": texture}
    elif chosen["pattern"] == "checker":
        pattern = {"checker": Checker(chosen["other"], chosen["size"])}
    looks = {name: chosen[name] for name in ("diffuse", "specular", "shininess")}
    return SceneObject(mesh, Material(**looks, **pattern))


choices = st.fixed_dictionaries({name: st.sampled_from(pool) for name, pool in POOLS.items()})
objects = choices.map(made_of)


def scene_of(*entries: SceneObject) -> Scene:
    return Scene(entries, (DirectionalLight((-1, -2, -3)),))


@given(st.lists(objects, min_size=1, max_size=5))
@settings(max_examples=25, deadline=None, derandomize=True, phases=[Phase.generate])
def test_a_glb_read_again_is_the_same_flat_scene(entries: list[SceneObject]):
    scene = scene_of(*entries)
    with tempfile.TemporaryDirectory() as folder:
        export_scene(Path(folder) / "a.glb", scene, CAMERA, SIZE)
        again = load_scene(Path(folder) / "a.glb")
    for mine, other in zip(scene.objects, again.objects, strict=True):
        # Without the checker, which is an image there.
        plain = replace(mine, material=replace(mine.material, checker=None))
        if mine.material.checker is not None:
            other = replace(other, material=replace(other.material, texture=None))
        a, b = (corners(Scene((entry,))) for entry in (plain, other))
        assert len(a["places"]) == len(b["places"])
        # A file's mesh without normals is smoothed where it is read.
        has_normals = isinstance(mine.shape, Mesh) and mine.shape.normals is not None
        for name in ("places", "colors", "uv", *(["normals"] if has_normals else [])):
            ordered = sorted_corners(a, b, name)
            np.testing.assert_allclose(ordered[1], ordered[0], atol=2e-5, err_msg=name)
        np.testing.assert_array_equal(a["image"], b["image"])
        assert a["wraps"] == b["wraps"]
        if mine.material.checker is None:
            assert other.material.diffuse == pytest.approx(mine.material.diffuse)


def corners(scene: Scene) -> dict[str, np.ndarray]:
    """Return for each triangle's corners the position in the world and the attributes there."""
    flat = flatten(scene)
    at = flat.faces.reshape(-1)
    world = flat.world_from_object[0]
    uv = flat.uv[at] if len(flat.uv) else np.zeros((len(at), 2), np.float32)
    return {
        "places": (flat.vertices[at] @ world[:3, :3].T + world[:3, 3]).reshape(-1, 3, 3),
        "normals": flat.normals[at].reshape(-1, 3, 3),
        "colors": flat.colors[at].reshape(-1, 3, 3),
        "uv": uv.reshape(-1, 3, 2),
        "image": flat.texels,
        "wraps": flat.textures[0].tolist(),
    }


def sorted_corners(a, b, name: str) -> tuple[np.ndarray, np.ndarray]:
    """One quantity of both, each triangle beginning at the same corner: its winding may differ."""
    found = []
    for part in (a, b):
        order = np.lexsort(np.round(part["places"], 3).transpose(2, 0, 1), axis=1)
        values = np.take_along_axis(part[name], order[..., None], axis=1)
        found.append(values)
    return found[0], found[1]
