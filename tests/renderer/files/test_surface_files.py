"""Metals, cutouts and backs in files: read from glTF, saved in scene files, exported."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import gltf_files
import numpy as np
import pytest
from gltf_files import CORNERS
from textured import noise, png, saved

from lucida.renderer.camera.camera import Camera
from lucida.renderer.editing.changing import set_field, table_of
from lucida.renderer.editing.materials import own_material, set_material
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene, save_scene
from lucida.renderer.files.export import export_scene
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

PLACES = np.array([[0, 0], [1, 0], [0, 1]], "<f4")
RGBA = np.concatenate([noise(4, 4), noise(4, 4, 7)[..., :1]], axis=2)
ROUGH_METAL = noise(4, 4, 9)


def gltf(folder: Path, material: dict[str, Any]) -> Scene:
    """A triangle with base.png and metal.png next to the file."""
    saved(folder, "base.png", RGBA)
    saved(folder, "metal.png", ROUGH_METAL)
    places = {"TEXCOORD_0": PLACES, "TEXCOORD_1": PLACES[::-1]}
    tree = gltf_files.gltf(
        {"POSITION": CORNERS, "material": 0} | places,
        materials=[material],
        textures=[{"source": 0}, {"source": 1}],
        images=[{"uri": "base.png"}, {"uri": "metal.png"}],
    )
    return gltf_files.load_gltf(tree, folder)


BASE, METAL = {"baseColorTexture": {"index": 0}}, {"metallicRoughnessTexture": {"index": 1}}
MASK = {"alphaMode": "MASK", "alphaCutoff": 0.3}
FULL: dict[str, Any] = {
    "pbrMetallicRoughness": {
        "baseColorTexture": {
            "index": 0,
            "extensions": {"KHR_texture_transform": {"rotation": 0.3, "offset": [0.1, 0.2]}},
        },
        "baseColorFactor": [0.9, 0.8, 0.7, 0.5],
    },
    **MASK,
}


def test_gltf_metals_have_both_channels_and_cutouts_their_opacity(tmp_path: Path) -> None:
    pbr = BASE | METAL | {"metallicFactor": 0.5, "roughnessFactor": 0.75}
    (entry,) = gltf(tmp_path, {"pbrMetallicRoughness": pbr, **MASK}).objects
    material = entry.material
    assert material.metal is not None and material.texture is not None
    np.testing.assert_array_equal(material.metal.texels, ROUGH_METAL)
    np.testing.assert_array_equal(material.texture.texels, RGBA)
    assert (material.metal.metalness, material.metal.roughness) == (0.5, 0.75)
    assert (material.cutout, material.single_sided) == (0.3, True)


@pytest.mark.parametrize(
    "other",
    [
        {"texCoord": 1},
        {"extensions": {"KHR_texture_transform": {"scale": [2, 2]}}},
    ],
)
def test_a_metal_with_coordinates_of_its_own_is_told_and_its_mean_shown(
    other: dict[str, Any], tmp_path: Path
) -> None:
    pbr = BASE | {"metallicRoughnessTexture": {"index": 1, **other}}
    scene = gltf(tmp_path, {"pbrMetallicRoughness": pbr})
    assert "a metal lies otherwise than its base colour; its mean is shown" in scene.notes[0]
    metal = scene.objects[0].material.metal
    assert metal is not None
    assert metal.metalness == pytest.approx(ROUGH_METAL[..., 2].mean() / 255)
    alone = gltf(
        tmp_path, {"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 1, **other}}}
    )
    assert not alone.notes and alone.objects[0].material.metal is not None


@pytest.mark.parametrize("material", [FULL, {"pbrMetallicRoughness": BASE | METAL, **MASK}])
def test_what_gltf_materials_say_a_scene_file_says_too(
    material: dict[str, Any], tmp_path: Path
) -> None:
    """A material of its own looks as the model's did; saved and read again, it stays so."""
    gltf(tmp_path, material)
    (tmp_path / "s.toml").write_text("[[objects]]\ntype = 'model'\nfile = 't.gltf'\n")
    scene = load_scene(tmp_path / "s.toml")
    item = outline(scene)[0].item
    assert item is not None
    own = own_material(pickle.loads(pickle.dumps(scene)), [item])  # models are read elsewhere
    save_scene(tmp_path / "again.toml", own)
    for other in (own, load_scene(tmp_path / "again.toml")):
        for name in ("materials", "uv", "textures", "texels", "single_sided"):
            np.testing.assert_array_equal(
                getattr(flatten(other), name), getattr(flatten(scene), name)
            )
    changed = set_material(own, [item], "diffuse", (0.1, 0.2, 0.3))
    before, after = own.objects[0].material, changed.objects[0].material
    assert after.texture is before.texture and after.metal is before.metal  # not read again


def test_backs_are_switched_of_models_and_shapes_alike(tmp_path: Path) -> None:
    gltf(tmp_path, FULL)
    model = "[[objects]]\ntype = 'model'\nfile = 't.gltf'\n"
    box = "[[objects]]\ntype = 'box'\nmaterial = 'm'\n"
    (tmp_path / "s.toml").write_text(f"[materials.m]\nshininess = 9\n{model}{model}{box}{box}")
    scene = load_scene(tmp_path / "s.toml")
    items = [row.item for row in outline(scene) if row.item is not None and not row.is_light]
    assert flatten(scene).single_sided.tolist() == [1, 1, 0, 0]
    seen = set_field(scene, items[1:2], "single_sided", False)
    assert flatten(seen).single_sided.tolist() == [1, 0, 0, 0]
    hidden = set_material(
        set_field(seen, items[1:2], "single_sided", True), items[2:], "single_sided", True
    )
    assert flatten(hidden).single_sided.tolist() == [1, 1, 1, 1]
    assert "material" not in table_of(hidden, items[1])  # its materials are still the file's
    save_scene(tmp_path / "s.toml", hidden)
    assert flatten(load_scene(tmp_path / "s.toml")).single_sided.all()


@pytest.mark.parametrize("material", [FULL, {"pbrMetallicRoughness": BASE | METAL, **MASK}])
def test_an_export_to_gltf_says_what_was_read(material: dict[str, Any], tmp_path: Path) -> None:
    scene = gltf(tmp_path, material)
    export_scene(tmp_path / "out.glb", scene, Camera(), (64, 48))
    one, other = flatten(scene), flatten(load_scene(tmp_path / "out.glb"))
    np.testing.assert_array_equal(one.single_sided, other.single_sided)
    np.testing.assert_array_equal(one.texels, other.texels)
    np.testing.assert_allclose(one.uv % 4, other.uv % 4, atol=1e-5)
    np.testing.assert_allclose(one.materials[0, 0, :3], other.materials[0, 0, :3], atol=1e-6)


WRONG = [
    ("cutout = 0", "materials.m.cutout: 0 is not an opacity above 0"),
    ("metal = { file = 'a.png', metalness = 2 }", "materials.m.metal.metalness: 2 is outside 0"),
    ("metal = 'a.png'\nchecker = {}", "materials.m.metal: is given, and so is a checker"),
    ("texture = { file = 'a.png', rotate_deg = 3 }", "objects[0].material: turns its texture"),
]


@pytest.mark.parametrize(("text", "problem"), WRONG)
def test_a_mistake_names_its_field(text: str, problem: str, tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(png(noise(2, 2)))
    objects = "[[objects]]\ntype = 'sphere'\nmaterial = 'm'\n"
    (tmp_path / "s.toml").write_text(f"[materials.m]\n{text}\n{objects}")
    with pytest.raises(LucidaError) as caught:
        load_scene(tmp_path / "s.toml")
    assert str(caught.value).partition("s.toml: ")[2].startswith(problem), str(caught.value)
