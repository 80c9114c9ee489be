"""Images of models and scene files: what is read, what is refused, and what that costs."""

from __future__ import annotations

import base64
import os
from pathlib import Path

import gltf_files
import numpy as np
import pytest
from gltf_files import CORNERS
from textured import noise, png, saved, slopes

from lucida.renderer.editing.changing import set_field
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene
from lucida.renderer.files.saving import save_scene
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, Sphere
from lucida.renderer.scene.texture import Texture
from lucida.renderer.system.errors import LucidaError

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 2 1\nvt 0 1\n"
PLACES = np.array([(0, 0), (1, 0), (0, 0.25)], "<f4")


def obj(folder: Path, mtl: str, name: str = "m.obj") -> Scene:
    (folder / "m.mtl").write_text(f"newmtl a\n{mtl}\nnewmtl b\nKd 0.1 0.2 0.3\n")
    faces = "usemtl a\nf 1/1 2/2 3/3 4/4\nusemtl b\nf 1 2 3\n"
    (folder / name).write_text(f"mtllib m.mtl\n{SQUARE}{faces}")
    return load_scene(folder / name)


def gltf(
    folder: Path,
    image: dict,
    extra: dict | None = None,
    info: dict | None = None,
    places: np.ndarray = PLACES,
) -> Scene:
    """Load one triangle with a base colour image; its PNG is in buffer view 2."""
    pbr = {"baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0}
    pbr |= {"baseColorTexture": {"index": 0} | (info or {})}
    primitive = {"POSITION": CORNERS, "TEXCOORD_0": places, "TEXCOORD_1": places, "material": 0}
    entries = {
        "materials": [{"pbrMetallicRoughness": pbr}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071, "wrapT": 33648}],
        "images": [image],
    }
    tree = gltf_files.gltf(primitive, blobs=(png(slopes(3, 2)),), **entries | (extra or {}))
    return gltf_files.load_gltf(tree, folder)


def scene_file(folder: Path, material: str, shape: str = "type = 'box'") -> Scene:
    path = folder / "s.toml"
    path.write_text(f"[materials.m]\n{material}\n[[objects]]\n{shape}\nmaterial = 'm'\n")
    return load_scene(path)


def test_an_obj_files_image(tmp_path: Path) -> None:
    saved(tmp_path, "textures/a b.png", slopes(5, 4))
    scene = obj(tmp_path, "Kd 0.5 1 1\nmap_Kd -s 2 3 1 -clamp on textures\\a b.png")
    textured = next(entry for entry in scene.objects if entry.material.texture)
    texture = textured.material.texture
    assert texture is not None and textured.material.diffuse == (0.5, 1, 1)
    np.testing.assert_array_equal(texture.texels, slopes(5, 4))
    assert texture.wrap == ("repeat", "repeat")
    assert isinstance(textured.shape, Mesh) and textured.shape.uv is not None
    np.testing.assert_array_equal(np.sort(textured.shape.uv[:, 0]), [0, 0, 2, 2])
    plain = next(entry for entry in scene.objects if entry.material.texture is None)
    assert isinstance(plain.shape, Mesh) and plain.shape.uv is None
    assert scene.notes[0].endswith("materials: not shown: options of map_kd")


WRONG_NAMES = {
    "missing": ("gone.png", "'gone.png' does not exist"),
    "above": ("../a.png", "'../a.png' is not in the folder"),
    "no image": ("m.mtl", "'m.mtl' is not one of PNG"),
    "a link": ("link.png", "'link.png' is not in the folder"),
}


@pytest.mark.parametrize("case", WRONG_NAMES)
def test_an_image_that_cannot_be_had_costs_one_line(tmp_path: Path, case: str) -> None:
    folder = tmp_path / "model"
    folder.mkdir()
    outside = saved(tmp_path, "a.png", slopes(5, 4))
    os.symlink(outside, folder / "link.png")
    name, problem = WRONG_NAMES[case]
    scene = obj(folder, f"Kd 0.5 1 1\nmap_Kd {name}")
    assert len(scene.objects) == 2
    assert all(entry.material.texture is None for entry in scene.objects)
    assert any(entry.material.diffuse == (0.5, 1, 1) for entry in scene.objects)
    (note,) = scene.notes
    assert problem in note
    assert "the plain colour is shown" in note and str(folder / "m.obj") in note


def test_gltf_images_wherever_they_are(tmp_path: Path) -> None:
    saved(tmp_path, "a b.png", slopes(3, 2))
    uri = "data:image/png;base64," + base64.b64encode(png(slopes(3, 2))).decode()
    for image in ({"bufferView": 2, "mimeType": "image/png"}, {"uri": "a%20b.png"}, {"uri": uri}):
        scene = gltf(tmp_path, image)
        (entry,) = scene.objects
        texture = entry.material.texture
        assert scene.notes == () and texture is not None
        np.testing.assert_array_equal(texture.texels, slopes(3, 2))
        assert texture.wrap == ("clamp", "mirror") and entry.material.diffuse == (0.5, 1, 1)
        assert isinstance(entry.shape, Mesh) and entry.shape.uv is not None
        # v counts upwards here.
        np.testing.assert_allclose(entry.shape.uv, [(0, 1), (1, 1), (0, 0.75)])


@pytest.mark.parametrize("rotation", [0.0, 0.4, -np.pi / 2])
@pytest.mark.parametrize(("kind", "largest"), [("<f4", 1), ("u1", 255), ("<u2", 65535)])
def test_a_gltf_textures_transform_moves_the_same_place(
    rotation: float, kind: str, largest: int, tmp_path: Path
) -> None:
    """KHR_texture_transform: offset * rotation * scale, counter-clockwise as one sees the image."""
    transform = {"offset": [0.1, 0.2], "scale": [2, 3], "texCoord": 1, "rotation": rotation}
    info = {"texCoord": 7, "extensions": {"KHR_texture_transform": transform}}
    whole = np.array([[0, 0], [1, 0], [0, 1]])
    places = (whole * largest).astype(kind)
    (entry,) = gltf(tmp_path, {"bufferView": 2}, None, info, places).objects
    texture = entry.material.texture
    matrix = texture.in_texels()
    cosine, sine = np.cos(rotation), np.sin(rotation)
    turn = np.array([[cosine, sine], [-sine, cosine]])  # of coordinates whose v counts downwards
    expected = ((whole * (2, 3)) @ turn.T + (0.1, 0.2)) * (3, 2)
    found = entry.shape.uv @ matrix[:, :2].T + matrix[:, 2]
    np.testing.assert_allclose(found, expected, atol=1e-5)


WRONG_GLTF = {
    "no image": ({}, {}, "bufferView: is missing"),
    "a damaged one": ({"bufferView": 0}, {}, "is not one of PNG"),
    "no texture": ({"bufferView": 2}, {"textures": []}, "names entry 0"),
    "another kind": ({"bufferView": 2}, {"textures": [{}]}, "have no image of a known kind"),
}


@pytest.mark.parametrize("case", WRONG_GLTF)
def test_a_gltf_image_that_cannot_be_had_costs_one_line(tmp_path: Path, case: str) -> None:
    image, extra, problem = WRONG_GLTF[case]
    scene = gltf(tmp_path, image, extra)
    (entry,) = scene.objects
    assert entry.material.texture is None and entry.material.diffuse == (0.5, 1, 1)
    (note,) = scene.notes
    assert problem in note and "\n" not in note


SHAPES = {
    "box": "type = 'box'",
    "rectangle": "type = 'rectangle'",
    "disk": "type = 'disk'",
    "cylinder": "type = 'cylinder'",
    "cone": "type = 'cone'\nsegments = 7",
    "torus": "type = 'torus'",
}


@pytest.mark.parametrize("shape", SHAPES)
def test_shapes_have_the_whole_image_and_their_own_surface(tmp_path: Path, shape: str) -> None:
    saved(tmp_path, "a.png", slopes(4, 4))
    scene = scene_file(tmp_path, "texture = 'a.png'", SHAPES[shape])
    plain = scene_file(tmp_path, "diffuse = [1, 1, 1]", SHAPES[shape])
    mesh, bare = scene.objects[0].shape, plain.objects[0].shape
    assert isinstance(mesh, Mesh) and isinstance(bare, Mesh) and mesh.uv is not None
    assert bare.uv is None and scene.objects[0].material.diffuse == (1, 1, 1)
    # The same triangles in the same order, whichever vertices are doubled.
    np.testing.assert_array_equal(mesh.vertices[mesh.faces], bare.vertices[bare.faces])
    if bare.normals is not None:
        assert mesh.normals is not None
        np.testing.assert_array_equal(mesh.normals[mesh.faces], bare.normals[bare.faces])
    uv = mesh.uv[mesh.faces].astype(float)
    np.testing.assert_allclose(uv.min(axis=(0, 1)), 0, atol=0.08)
    np.testing.assert_allclose(uv.max(axis=(0, 1)), 1, atol=0.08)
    # No image is mirrored: u, v and the normal are right-handed.
    corners = mesh.vertices[mesh.faces].astype(float)
    to_b, to_c = (uv[:, k] - uv[:, 0] for k in (1, 2))
    area = to_b[:, 0] * to_c[:, 1] - to_b[:, 1] * to_c[:, 0]
    assert (area > 0).all()
    assert np.abs(uv - uv[:, :1]).max() <= 1 + 1e-6  # no triangle runs round the seam
    assert len(corners) == len(uv)


def test_a_scene_files_texture_table(tmp_path: Path) -> None:
    saved(tmp_path, "a.png", slopes(4, 4))
    table = "{ file = 'a.png', wrap = ['mirror', 'clamp'], scale = 3, offset = [0.5, 0] }"
    scene = scene_file(tmp_path, f"diffuse = [0.5, 1, 1]\ntexture = {table}", "type = 'sphere'")
    material = scene.objects[0].material
    texture = material.texture
    assert texture is not None and material.diffuse == (0.5, 1, 1)
    assert texture.wrap == ("mirror", "clamp") and texture.scale == (3, 3)
    assert scene.origin is not None and tmp_path / "a.png" in scene.origin.files


WRONG_TABLES = {
    "'gone.png'": r"materials\.m\.texture: 'gone.png' does not exist",
    "'../a.png'": r"materials\.m\.texture: '../a.png' is not in the folder",
    "{ file = 'a.png', wrap = 'tile' }": r"texture\.wrap: 'tile' is unknown; give two of repeat",
    "'a.png'\nchecker = {}": r"materials\.m\.texture: is given, and so is a checker",
}


@pytest.mark.parametrize("given", WRONG_TABLES)
def test_mistakes_in_a_scene_file_name_the_field(tmp_path: Path, given: str) -> None:
    saved(tmp_path, "a.png", slopes(4, 4))
    with pytest.raises(LucidaError, match=WRONG_TABLES[given]) as caught:
        scene_file(tmp_path, f"texture = {given}")
    assert caught.value.source.endswith("s.toml")


def test_a_texture_needs_places_on_a_mesh(tmp_path: Path) -> None:
    saved(tmp_path, "a.png", slopes(4, 4))
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.raises(
        LucidaError,
        match=r"objects\[0\]\.material: has a texture; 't' of 't.obj' has no texture coord",
    ):
        scene_file(tmp_path, "texture = 'a.png'", "type = 'model'\nfile = 't.obj'")
    mesh = Mesh(CORNERS, [(0, 1, 2)])
    with pytest.raises(LucidaError, match="the mesh has no texture coordinates"):
        SceneObject(mesh, Material(texture=Texture(slopes(2, 2))))


@pytest.mark.parametrize("kind", ["obj", "gltf"])
def test_a_scene_file_textures_a_model_that_has_places_and_no_image(tmp_path: Path, kind) -> None:
    saved(tmp_path, "a.png", slopes(4, 4))
    if kind == "obj":
        (tmp_path / "m.obj").write_text(f"{SQUARE}f 1/1 2/2 3/3 4/4\n")
    else:
        gltf(tmp_path, {}, {"materials": [{}]})
    file = "m.obj" if kind == "obj" else "t.gltf"
    model = f"type = 'model'\nfile = '{file}'\n"
    scene = scene_file(tmp_path, "texture = 'a.png'", f"{model}[[objects]]\n{model}")
    mapped = scene.objects[1].shape
    assert isinstance(mapped, Mesh) and mapped.uv is not None
    wanted = [(0, 0), (2, 1)] if kind == "obj" else [(0, 0.75), (1, 1)]
    np.testing.assert_allclose([mapped.uv.min(axis=0), mapped.uv.max(axis=0)], wanted)
    item = outline(scene)[1].item
    assert item is not None
    moved = set_field(scene, [item], "translate", [1, 0, 0]).objects[1].shape
    assert isinstance(moved, Mesh) and moved.uv is mapped.uv  # it is not read again


def test_scenes_with_textures_are_saved_where_their_images_are(tmp_path: Path) -> None:
    image = saved(tmp_path, "sub/a.png", noise(4, 4))
    scene = scene_file(tmp_path, "texture = 'sub/a.png'", "type = 'sphere'")
    save_scene(tmp_path / "again.toml", scene)
    made = Texture(noise(4, 4), ("mirror", "clamp"), (2, 2), file=image)
    save_scene(
        tmp_path / "made.toml",
        Scene((SceneObject(Sphere(), Material((1, 1, 1), texture=made)),)),
    )
    for name in ("again.toml", "made.toml"):
        texture = load_scene(tmp_path / name).objects[0].material.texture
        assert texture is not None
        np.testing.assert_array_equal(texture.texels, noise(4, 4))
    (tmp_path / "other").mkdir()
    with pytest.raises(LucidaError, match=r"materials\.m\.texture: 'a.png' is not in"):
        save_scene(tmp_path / "other" / "s.toml", scene)
    nowhere = Scene((SceneObject(Sphere(), Material(texture=Texture(noise(2, 2)))),))
    with pytest.raises(LucidaError, match="made in Python, or is inside"):
        save_scene(tmp_path / "n.toml", nowhere)


def test_coordinates_that_are_no_numbers_are_zero(tmp_path: Path) -> None:
    saved(tmp_path, "a.png", slopes(5, 4))
    (tmp_path / "m.mtl").write_text("newmtl a\nmap_Kd a.png\n")
    wrong = SQUARE.replace("vt 2 0", "vt nan 0").replace("vt 0 1", "vt 0 -2e6")
    (tmp_path / "m.obj").write_text(f"mtllib m.mtl\n{wrong}usemtl a\nf 1/1 2/2 3/3 4/4\n")
    shape = load_scene(tmp_path / "m.obj").objects[0].shape
    assert isinstance(shape, Mesh) and shape.uv is not None
    assert np.abs(shape.uv).max() <= 2
