"""Model files: each format read rightly, repaired where it can be, its normals and colours."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import ArrayLike

from lucida.renderer.files import load_scene
from lucida.renderer.files.models.models import load_model
from lucida.renderer.files.models.parts import Part, build_mesh, linear_colors
from lucida.renderer.scene import Mesh, SceneObject, framing, shapes
from lucida.renderer.scene.focus import object_corners
from lucida.renderer.system.errors import LucidaError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
OBJ_TRIANGLE = f"{TRIANGLE}f 1 2 3\n"
ENDINGS = ("obj", "ply", "stl", "off", "glb", "gltf")


def write(path: Path, content: str | bytes) -> Path:
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def mesh_of(entry: SceneObject) -> Mesh:
    assert isinstance(entry.shape, Mesh)
    return entry.shape


def load_one(path: Path) -> Mesh:
    (entry,) = load_model(path).objects
    return mesh_of(entry)


def corners(mesh: Mesh) -> np.ndarray:
    """The faces' corners in world space, each face beginning at its smallest corner, sorted."""
    world = mesh.vertices @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]
    faces = [
        min(tuple(map(tuple, np.roll(face, -k, axis=0).round(5).tolist())) for k in range(3))
        for face in world[mesh.faces] + 0.0
    ]
    return np.array(sorted(faces))


# All formats.


@pytest.mark.parametrize("size", [1e-3, 0.15, 1.0, 1e3])
def test_the_image_plane_is_framed_between_the_eye_and_the_model(size: float) -> None:
    model = SceneObject(replace(shapes.torus(), transform=np.diag([size, size, size, 1.0])))
    camera = framing.framing_view([model]).camera
    seen = camera.project(size * shapes.torus().vertices, (1, 1))
    away = max(np.abs(seen.row).max(), np.abs(seen.column).max())
    assert away == pytest.approx(0.5 / framing.MARGIN, rel=0.01)
    nearest = min(camera.project(one, (1, 1)).parameter for one in object_corners(model))
    assert 1.2 < nearest < 5  # in distances of the image plane
    side = camera.viewport[1] - camera.viewport[0]
    assert f"{side:.0e}"[0] in "125"
    assert np.isclose(side, float(f"{side:.0e}"))


@pytest.mark.parametrize("ending", ENDINGS)
def test_every_format_gives_the_same_triangles(ending: str, tmp_path: Path) -> None:
    torus = shapes.torus(0.5, 0.2, 24, 12)
    path = tmp_path / f"t.{ending}"
    source = trimesh.Trimesh(torus.vertices, torus.faces, process=False)
    if ending == "gltf":
        for name, data in source.export(file_type="gltf").items():
            write(tmp_path / (path.name if name == "model.gltf" else name), data)
    else:
        source.export(path)
    read = load_scene(path)
    assert [entry.name for entry in read.objects] == [
        "geometry_0" if ending == "gltf" else "t"
    ] or (ending in ("glb", "gltf"))
    np.testing.assert_allclose(corners(mesh_of(read.objects[0])), corners(torus), atol=2e-5)
    assert read.lights == framing.LIGHTS
    assert read.view.fit
    assert read.name == "t"


@pytest.mark.parametrize("ending", ["ply", "stl", "off", "obj"])
def test_files_without_normals_get_the_surface_s(ending: str, tmp_path: Path) -> None:
    torus = shapes.torus(0.5, 0.2, 96, 48)
    path = tmp_path / f"t.{ending}"
    trimesh.Trimesh(torus.vertices, torus.faces, process=False).export(
        path, **({"include_normals": False} if ending == "obj" else {})
    )
    mesh = load_one(path)
    assert len(mesh.vertices) == len(torus.vertices)  # merged where the format repeats them
    p = mesh.vertices.astype(float)
    ring = p * (1, 0, 1)
    ring *= 0.5 / np.linalg.norm(ring, axis=1, keepdims=True)
    expected = (p - ring) / 0.2
    assert mesh.normals is not None
    cosine = np.einsum("ij,ij->i", mesh.normals, expected)
    assert np.degrees(np.arccos(cosine.clip(-1, 1))).max() < 1.0


# OBJ.


def test_obj_objects_and_materials_become_scene_objects_in_order(tmp_path: Path) -> None:
    write(
        tmp_path / "m.mtl",
        "newmtl red\nKd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 90\nmap_Kd /etc/hostname\n"
        "newmtl wild\nKd 7 -1 nan\nNs 1e9\n",
    )
    text = (
        "mtllib m.mtl\n" + TRIANGLE + "v 0 0 1\no first\nusemtl red\nf 1 2 3\n"
        "o second\nusemtl wild\nf 1 2 4\no third\nusemtl none\nf 1 3 4\n"
    )
    first, second, third = load_model(write(tmp_path / "t.obj", text)).objects
    assert [e.name.split("_")[0] for e in (first, second, third)] == ["first", "second", "third"]
    assert first.material.diffuse == (0.8, 0.1, 0.1)
    assert first.material.specular == (0.5, 0.5, 0.5)
    assert first.material.shininess == 90
    assert second.material.shininess == 1000
    assert third.material == framing.MATERIAL


@pytest.mark.parametrize(
    "text",
    [
        "v 9 9 9\n" + TRIANGLE + "f -3/-1 -2/-1 -1/-1\n",
        "  v\t0 0 0\n\tv 1 0 0 # x\nv 0 1 0\nf\t1 2 3\n",
        TRIANGLE + "f 1 2\\\n  3\n",
        TRIANGLE + "vn 0 0 1\nf 1//9 2//1 3//1\n",
        "mtllib ../../../../../etc/passwd\nusemtl x\n" + TRIANGLE + "f 1 2 3\n",
    ],
)
def test_every_dialect_of_obj_is_read(text: str, tmp_path: Path) -> None:
    mesh = load_one(write(tmp_path / "t.obj", text))
    np.testing.assert_array_equal(corners(mesh), [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]])


def test_obj_with_more_groups_than_objects_is_one_object(tmp_path: Path) -> None:
    text = TRIANGLE + "".join(f"v {k} 0 1\no {k}\nf 1 2 {k + 4}\n" for k in range(10_001))
    (entry,) = load_model(write(tmp_path / "t.obj", text)).objects
    assert len(mesh_of(entry).faces) == 10_001


# Colours.

HALF = ((128 / 255 + 0.055) / 1.055) ** 2.4  # sRGB 128, in linear light

PLY_HEADER = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
{vertex}element face 1
property list uchar int vertex_indices
{face}end_header
"""
RGB = "property uchar red\nproperty uchar green\nproperty uchar blue\n"


def test_ply_colours_are_srgb_and_those_of_faces_are_named(tmp_path: Path) -> None:
    header = PLY_HEADER.format(vertex=RGB, face=RGB)
    rows = "".join(f"{row} 255 128 0\n" for row in ("0 0 0", "1 0 0", "0 1 0", "3 0 1 2"))
    path = write(tmp_path / "t.ply", header + rows)
    model = load_model(path)
    (entry,) = model.objects
    colors = mesh_of(entry).colors
    np.testing.assert_allclose(colors, [[1, HALF, 0]] * 3, atol=1e-6)
    assert entry.material.diffuse == (1, 1, 1)
    assert model.notes == (f"{path}: PLY: not read: colours of faces",)


def test_colours_of_any_type() -> None:
    np.testing.assert_allclose(
        linear_colors(np.array([[255, 128, 0]], np.uint8)), [[1, HALF, 0]], rtol=1e-6
    )
    np.testing.assert_allclose(linear_colors([[1.0, 128 / 255, 0.0]]), [[1, HALF, 0]], rtol=1e-6)
    np.testing.assert_allclose(linear_colors([[255.0, 128.0, 0.0]]), [[1, HALF, 0]], rtol=1e-6)
    linear = np.array([[65535, 0, 0, 7]], np.uint16)
    np.testing.assert_allclose(linear_colors(linear, linear=True), [[1, 0, 0]])
    np.testing.assert_allclose(linear_colors([[math.nan, -1, 0.5]], linear=True), [[0, 0, 0.5]])


# PLY, STL, OFF.


@pytest.mark.parametrize("order", ["<", ">"])
def test_a_binary_ply_is_read_in_both_byte_orders(order: str, tmp_path: Path) -> None:
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    header = PLY_HEADER.format(vertex="", face="").replace("ascii", name)
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], f"{order}f4")
    face = b"\3" + np.arange(3, dtype=f"{order}i4").tobytes()
    mesh = load_one(write(tmp_path / "t.ply", header.encode() + points.tobytes() + face))
    np.testing.assert_array_equal(corners(mesh), [points])


def test_ply_with_edges_comments_and_empty_lines(tmp_path: Path) -> None:
    header = PLY_HEADER.format(vertex="", face="").replace(
        "end_header",
        "element edge 1\nproperty int vertex1\nproperty int vertex2\ncomment caf\u00e9\nend_header",
    )
    text = f"{header}0 0 0\n\n1 0 0\r\n0 1 0\n3 0 1 2\n0 1\n\n\n"
    assert len(load_one(write(tmp_path / "t.ply", text.encode("latin-1"))).faces) == 1


FACET = (
    "facet normal 0 0 1\nouter loop\nvertex 0 0 {z}\nvertex 1 0 {z}\nvertex 0 1 {z}\n"
    "endloop\nendfacet\n"
)


def test_solids_of_a_text_stl_are_one_mesh(tmp_path: Path) -> None:
    text = "".join(
        f"solid {name}\n{FACET.format(z=z)}endsolid {name}\n"
        for z, name in enumerate(["left", "left", ""])
    )
    objects = load_model(write(tmp_path / "t.stl", text)).objects
    assert [entry.name for entry in objects] == ["t"]
    assert sorted({z for _, _, z in mesh_of(objects[0]).vertices.tolist()}) == [0, 1, 2]


@pytest.mark.parametrize(
    ("text", "faces"),
    [
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 1),
        ("OFF 4 1 0 # counts beside it\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", 2),
        ("# first\nCOFF\n\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n", 1),
        ("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 1\n0 1 0\n4 0 1 2 3\n3 0 1 3\n2 0 1\n", 3),
        ("\ufeff# marked\noff\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 1),
    ],
)
def test_every_dialect_of_off_is_read(text: str, faces: int, tmp_path: Path) -> None:
    assert len(load_one(write(tmp_path / "t.off", text)).faces) == faces


def test_a_comment_that_ends_in_a_backslash_takes_no_line_away(tmp_path: Path) -> None:
    text = OBJ_TRIANGLE.replace("v 1", "# from C:\\models\\\nv 1").replace(" 2 3", " 2\\\n 3")
    assert len(load_one(write(tmp_path / "t.obj", text)).vertices) == 3


# Numbers that are none.

SIGNALLING = np.full((3, 3), 0x7F800001, np.uint32).view(np.float32)  # NaN that complains


@pytest.mark.parametrize(
    ("vertices", "more", "refused"),
    [
        (np.eye(3), {}, ""),
        ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1e300, np.nan, -np.inf]], {}, ""),
        (np.eye(3), {"normals": [[np.nan] * 3, [1e300] * 3, [1e-300] * 3]}, ""),
        (np.eye(3), {"normals": SIGNALLING}, ""),
        (np.eye(3), {"colors": SIGNALLING}, "colors: holds NaN"),
    ],
)
def test_hostile_numbers_give_a_sound_mesh_or_an_error_without_a_warning(
    vertices: ArrayLike, more: dict[str, ArrayLike], refused: str
) -> None:
    part = Part("", vertices, [[0, 1, 2]], **more)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        if refused:
            with pytest.raises(LucidaError, match=refused):
                build_mesh(part)
            return
        mesh = build_mesh(part)
    assert mesh is not None
    assert np.linalg.norm(mesh.normals, axis=1) == pytest.approx(1.0, abs=1e-6)
    there = mesh.vertices @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]
    assert there == pytest.approx(np.asarray(vertices, float)[:3], rel=1e-6)


# Polygons.


def area_of(mesh: Mesh) -> float:
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


@pytest.mark.parametrize(
    ("ending", "text", "area"),
    [
        (
            "obj",
            "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 2 2 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
            "f 1 2 3 4 5 6 7 8\n",
            5,
        ),
        (
            "obj",
            "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv .5 .5 0\nv .5 1.5 0\nv 1.5 1.5 0\n"
            "v 1.5 .5 0\nf 1 2 3 4 1 5 6 7 8 5\n",
            3,
        ),
        ("off", "OFF\n4 1 0\n0 0 0\n1 1 0\n2 0 0\n1 2 0\n4 0 1 2 3\n", 1),
        (
            "ply",
            PLY_HEADER.format(vertex="", face="")
            .replace("vertex 3", "vertex 5")
            .replace("face 1", "face 2")
            + "0 0 0\n1 1 0\n2 0 0\n1 2 0\n3 2 0\n4 0 1 2 3\n3 2 4 3\n",
            3,
        ),
    ],
)
def test_concave_polygons_and_holes_are_cut_right(
    ending: str, text: str, area: float, tmp_path: Path
) -> None:
    assert area_of(load_one(write(tmp_path / f"t.{ending}", text))) == pytest.approx(area)


def test_binary_ply_of_triangles_and_quads(tmp_path: Path) -> None:
    header = PLY_HEADER.format(vertex="", face=RGB).replace("ascii", "binary_little_endian")
    header = header.replace("vertex 3", "vertex 5").replace("face 1", "face 2")
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]], "<f4")
    faces = [b"\4" + np.array([0, 1, 2, 3], "<i4").tobytes() + b"\xff\0\0"]
    faces.append(b"\3" + np.array([1, 4, 2], "<i4").tobytes() + b"\0\xff\0")
    data = header.encode() + points.tobytes() + b"".join(faces)
    mesh = load_one(write(tmp_path / "t.ply", data))
    assert area_of(mesh) == pytest.approx(1.5) and mesh.colors is None
