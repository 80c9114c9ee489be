"""The numbers in exported files: zeros, signs, what is hidden; and the files that are left."""

from __future__ import annotations

import json
import math
import re
import tempfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from mitsuba_formulas import ply_arrays
from test_company import CAMERA, SIZE, objects, relatives, scene_of

from renderer.errors import LucidaError
from renderer.scene import Scene, shapes
from renderer.scene.model import (
    Checker,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    SceneObject,
    Sphere,
)
from renderer.scene_export import ENDINGS, export_scene
from renderer.scene_export.meshes import Triangles, arrays_of, shows_backs, turned_to
from tests.conformance.pbrt_grammar import Directive, parse

BLACK = (0.0, 0.0, 0.0)
SUN = DirectionalLight((-1, -2, -3), (0.5, 0.25, 1.0))


def written(scene: Scene, folder: Path, ending: str) -> Path:
    export_scene(folder / f"a{ending}", scene, CAMERA, SIZE)
    return folder / f"a{ending}"


def glb(path: Path) -> tuple[dict, bytes]:
    """A .glb file's tree, in which no number is NaN or infinite, and its binary chunk."""
    data = path.read_bytes()
    assert data[:8] == b"glTF\2\0\0\0" and int.from_bytes(data[8:12], "little") == len(data)
    length = int.from_bytes(data[12:16], "little")
    assert length % 4 == 0 and data[16:20] == b"JSON"
    tree = json.loads(data[20 : 20 + length], parse_constant=pytest.fail)
    binary = data[20 + length :]
    if binary:
        assert int.from_bytes(binary[:4], "little") == len(binary) - 8 and len(binary) % 4 == 0
        assert binary[4:8] == b"BIN\0"
    return tree, binary[8:]


def xml(path: Path) -> ElementTree.Element:
    """A .xml file's tree, in which no number is NaN or infinite."""
    root = ElementTree.parse(path).getroot()
    for element in root.iter():
        words = re.split(r"[ ,]+", " ".join(element.get(k, "") for k in ("value", "x", "y", "z")))
        assert not {"nan", "inf", "-inf"} & set(words)
    return root


def of_kind(found: list[Directive], name: str) -> list[Directive]:
    return [part for part in found if part.name == name]


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
def test_no_number_is_infinite_where_something_is_zero(scene: Scene, tmp_path: Path):
    with np.errstate(all="raise", under="ignore"):
        root = xml(written(scene, tmp_path, ".xml"))
        found = parse(written(scene, tmp_path, ".pbrt").read_text())  # takes no nan, no inf
        tree, binary = glb(written(scene, tmp_path, ".glb"))
    assert np.isfinite(np.frombuffer(binary, "<f4")).all()
    # Mitsuba samples a light; where there is none, a black one.
    assert len(root.findall("emitter")) == max(len(scene.lights), 1)
    (pbrt, gltf) = len(of_kind(found, "LightSource")), tree.get("extensions", {})
    assert pbrt == len(scene.lights) + any(scene.ambient)
    assert len(gltf.get("KHR_lights_punctual", {}).get("lights", ())) == len(scene.lights)
    # A light that shines is not dark for where it is.
    strong = [light for light in of_kind(found, "LightSource") if light.kind == "point"]
    points = [light for light in scene.lights if isinstance(light, PointLight)]
    for light, there in zip(points, strong, strict=True):
        assert any(light.color) == any(there.parameters["I"])
    for material in of_kind(found, "Material"):
        assert 1 <= material.parameters.get("eta", [1.0])[0] < 40


def test_lights_are_as_strong_as_a_diffuse_surface_wants_them(tmp_path: Path):
    # An object at a distance of 5, and one that is hidden and does not count.
    hidden = SceneObject(Sphere((0, 0, 100)), hidden=True)
    scene = Scene(
        (SceneObject(Sphere((0, 3, 0))), hidden), (PointLight((4, 0, 0), (1, 0.5, 0)), SUN)
    )
    strong = [25 * math.pi * np.array((1, 0.5, 0)), math.pi * np.array(SUN.color)]
    root = xml(written(scene, tmp_path, ".xml"))
    values = [light.find("rgb").get("value").split(",") for light in root.findall("emitter")]
    np.testing.assert_allclose(np.array(values, float), strong)
    lights = of_kind(parse(written(scene, tmp_path, ".pbrt").read_text()), "LightSource")
    assert [light.kind for light in lights] == ["point", "distant", "infinite"]
    np.testing.assert_allclose([lights[0].parameters["I"], lights[1].parameters["L"]], strong)
    np.testing.assert_allclose(lights[1].parameters["to"], SUN.direction)
    np.testing.assert_allclose(lights[2].parameters["L"], scene.ambient)
    tree, _ = glb(written(scene, tmp_path, ".glb"))
    found = tree["extensions"]["KHR_lights_punctual"]["lights"]
    products = [np.array(light["color"]) * light["intensity"] for light in found]
    np.testing.assert_allclose(products, strong)
    assert all(max(light["color"]) == 1 for light in found)


@given(st.floats(1, 1000), st.tuples(*[st.floats(0.001, 2)] * 3))
@settings(max_examples=20, deadline=None, derandomize=True, phases=[Phase.generate])
def test_highlights_are_as_wide_and_as_bright_in_the_middle(tmp_path_factory, shininess, specular):
    folder = tmp_path_factory.mktemp("a")
    scene = Scene((SceneObject(Sphere(), Material(BLACK, specular, shininess)),), (SUN,))
    squared = 2 / (shininess + 2)
    f0 = np.minimum(4 * squared * np.array(specular), 0.9)
    (material,) = of_kind(parse(written(scene, folder, ".pbrt").read_text()), "Material")
    (roughness,), (eta,) = material.parameters["roughness"], material.parameters["eta"]
    assert roughness**2 == pytest.approx(squared) and material.parameters["remaproughness"] == [0]
    assert ((eta - 1) / (eta + 1)) ** 2 == pytest.approx(f0.max())
    (table,) = glb(written(scene, folder, ".glb"))[0]["materials"]
    extension = table["extensions"]["KHR_materials_specular"]
    np.testing.assert_allclose(np.array(extension["specularColorFactor"]) * 0.04, f0)
    assert table["pbrMetallicRoughness"]["roughnessFactor"] ** 4 == pytest.approx(squared)


# What is seen.


@pytest.mark.parametrize("ending", ENDINGS)
def test_what_is_hidden_is_not_written(ending: str, tmp_path: Path):
    seen = SceneObject(shapes.box(), name="seen")
    hidden = SceneObject(shapes.torus(), Material(specular=(1, 1, 1)), "hidden", hidden=True)
    path = written(Scene((hidden, seen)), tmp_path, ending)
    assert b"hidden" not in path.read_bytes() and b"seen" in path.read_bytes()
    if ending == ".xml":
        assert [shape.get("id") for shape in xml(path).findall("shape")] == ["object-1"]


@given(relatives())
@settings(max_examples=25, deadline=None, derandomize=True, phases=[Phase.generate])
def test_a_mesh_s_file_has_its_arrays(entries: list[SceneObject]):
    with tempfile.TemporaryDirectory() as folder:
        scene = replace(scene_of(*entries), ambient=BLACK)  # without, nothing is turned to the eye
        shapes_there = xml(written(scene, Path(folder), ".xml")).findall("shape")
        for entry, shape in zip(entries, shapes_there, strict=True):
            name = shape.find("string[@name='filename']").get("value")
            check_arrays(entry, shape, ply_arrays(Path(folder) / name))


def check_arrays(entry: SceneObject, shape: ElementTree.Element, found: dict[str, np.ndarray]):
    mesh, material = entry.shape, entry.material
    assert isinstance(mesh, Mesh)
    flat = shape.find("boolean[@name='face_normals']")
    assert (flat is not None and flat.get("value") == "true") == (mesh.normals is None)

    def at_corners(*names: str) -> np.ndarray:
        return np.sort(np.stack([found[n] for n in names], axis=-1)[found["faces"]], axis=1)

    def mine(values: np.ndarray) -> np.ndarray:
        return np.sort(values[mesh.faces].astype(float), axis=1)

    np.testing.assert_allclose(at_corners("x", "y", "z"), mine(mesh.vertices))
    if mesh.normals is None:
        assert "nx" not in found
    else:
        np.testing.assert_allclose(at_corners("nx", "ny", "nz"), mine(mesh.normals))
    if mesh.uv is not None and material.checker is None:
        np.testing.assert_allclose(at_corners("u", "v"), mine(mesh.uv))
    assert ("r" in found) == (mesh.colors is not None and material.texture is None)
    matrix = np.array(shape.find("transform/matrix").get("value").split(), float).reshape(4, 4)
    np.testing.assert_array_equal(matrix, mesh.transform)
    # In the world, a triangle winds about its normals; without, as here.
    corners = np.stack([found[axis] for axis in "xyz"], axis=-1)[found["faces"]]
    turn = np.linalg.inv(matrix[:3, :3])
    normals = winding(mesh.vertices[mesh.faces].astype(float))
    if mesh.normals is not None:
        normals = mesh.normals[mesh.faces].sum(axis=1)
    outward = winding(corners @ matrix[:3, :3].T)
    assert ((outward * (normals @ turn)).sum(axis=1) > -1e-5).all()


def winding(corners: np.ndarray) -> np.ndarray:
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


@given(objects)
@settings(max_examples=25, deadline=None, derandomize=True, phases=[Phase.generate])
def test_a_glb_is_aligned_and_its_bounds_hold(entry: SceneObject):
    with tempfile.TemporaryDirectory() as folder:
        tree, binary = glb(written(scene_of(entry), Path(folder), ".glb"))
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


viewers = st.tuples(
    *[st.integers(-40, 40).map(lambda n: n / 4 + 0.1)] * 3, st.sampled_from([0.0, 1.0])
)


@given(viewers, st.sampled_from([shapes.box(), shapes.torus(), shapes.cone()]))
@settings(max_examples=60, deadline=None, derandomize=True, phases=[Phase.generate])
def test_triangles_turn_their_front_to_the_viewer(viewer, mesh: Mesh):
    own = arrays_of(mesh)
    found, before = turned_to(viewer, own), own.apart()
    corners = found.vertices[found.faces].astype(float)
    to_viewer = np.array(viewer[:3]) - viewer[3] * corners[:, 0]
    assert ((winding(corners) * to_viewer).sum(axis=1) >= -1e-9).all()
    turned = (found.faces != before.faces).any(axis=1)
    np.testing.assert_array_equal(found.vertices, before.vertices)
    if before.normals is not None:
        assert found.normals is not None
        signs = np.where(turned, -1, 1).repeat(3)[:, None]
        np.testing.assert_array_equal(found.normals, before.normals * signs)


def test_backs_are_seen_of_open_or_inverted_surfaces_and_from_inside():
    box, plane = arrays_of(shapes.box()), arrays_of(shapes.rectangle(2, 2))
    inverted = replace(box, faces=box.faces[:, ::-1])
    for mesh, viewer, seen in (
        (box, (5.0, 4.0, 3.0, 1.0), False),
        (box, (0.1, 0.1, 0.2, 1.0), True),
        (box, (1.0, 1.0, 1.0, 0.0), True),  # whose parallel rays may begin inside
        (inverted, (5.0, 4.0, 3.0, 1.0), True),
        (Triangles(box.vertices, box.faces[1:]), (5.0, 4.0, 3.0, 1.0), True),
        (plane, (0.0, 2.0, 0.0, 1.0), False),
        (plane, (0.0, -2.0, 0.0, 1.0), True),
        (plane, (0.0, 2.0, 0.0, 0.0), False),
    ):
        assert shows_backs(viewer, mesh) == seen, viewer


# Files.


@pytest.mark.parametrize("ending", [".xml", ".pbrt"])
def test_what_was_there_stays_where_an_export_fails(ending: str, tmp_path: Path, monkeypatch):
    entries = [SceneObject(shapes.box((k, 1, 1)), name=f"box {k}") for k in (1, 2, 3)]
    path = written(Scene(tuple(entries[:1])), tmp_path, ending)
    before = {file: file.read_bytes() for file in tmp_path.rglob("*") if file.is_file()}
    assert len(before) == 2

    def full(*_: object) -> bytes:
        raise LucidaError("", "no room")

    scene = Scene((*entries, SceneObject(shapes.torus(), name="last")))
    room = f"renderer.scene_export.{'mitsuba' if ending == '.xml' else 'pbrt'}_scene.ply_bytes"
    real = __import__("renderer.scene_export.meshes", fromlist=["ply_bytes"]).ply_bytes
    monkeypatch.setattr(
        room, lambda mesh, *rest: (full if len(mesh.faces) > 12 else real)(mesh, *rest)
    )
    with pytest.raises(LucidaError, match="no room"):
        written(scene, tmp_path, ending)
    assert {file: file.read_bytes() for file in tmp_path.rglob("*") if file.is_file()} == before
    assert path in before


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("", "0.ply"),
        ("x" * 100, f"0-{'x' * 40}.ply"),
        ("..", "0.ply"),
        ("a/b\\c: d.", "0-a-b-c-d.ply"),
    ],
)
def test_files_next_to_a_scene_have_names_that_any_system_takes(name, file, tmp_path: Path):
    written(Scene((SceneObject(shapes.box(), name=name),)), tmp_path, ".xml")
    assert [path.name for path in (tmp_path / "a_meshes").iterdir()] == [file]


@pytest.mark.parametrize("ending", ENDINGS)
def test_what_is_left_out_is_a_line_each(ending: str, tmp_path: Path):
    odd = SceneObject(shapes.torus(), Material((2, 2, 2), (1, 0, 0), checker=Checker()), "a\nb")
    told = export_scene(tmp_path / f"a{ending}", Scene((odd, odd), (SUN,)), CAMERA, SIZE)
    assert len(set(told)) == len(told) and not any("\n" in line for line in told)
    assert any("reflects more than all light" in line for line in told)
    assert any(line.startswith("highlight") for line in told)
    assert any(line.startswith("shadows: ") for line in told) == (ending != ".glb")


def test_a_place_is_far_as_the_scene_is_small(tmp_path: Path):
    for x, size, is_told in ((3e3, 0.1, True), (3e3, 10.0, False), (0.0, 1e-5, False)):
        scene = Scene((SceneObject(Sphere((x, 0, 0), size)),))
        told = export_scene(tmp_path / "a.xml", scene, CAMERA, SIZE)
        assert any(line.startswith("place: ") for line in told) == is_told
        sensor = xml(tmp_path / "a.xml").find("sensor")
        near, far = (
            float(sensor.find(f"float[@name='{name}_clip']").get("value"))
            for name in ("near", "far")
        )
        away = math.dist(CAMERA.eye, (x, 0, 0))
        assert near < away - size and away + size < far < 2 * away + 4 * size
