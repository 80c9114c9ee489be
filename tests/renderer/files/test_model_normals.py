"""Normals of models: computed at creases, kept where the file has them; and repaired faces."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from test_models import TRIANGLE, load_one, write

from lucida.renderer.files.models.parts import Part, build_mesh
from lucida.renderer.scene import Mesh, shapes
from lucida.renderer.scene.normals import face_normals, merge_positions

# Normals and repair.


def part(mesh: Mesh, **fields) -> Part:
    return Part("p", mesh.vertices, mesh.faces, **fields)


def test_edges_stay_sharp_and_round_sides_smooth() -> None:
    box = build_mesh(part(shapes.box()))
    assert box is not None
    assert len(box.vertices) == 24
    g = face_normals(box.vertices, box.faces.astype(np.int64))
    assert box.normals is not None
    np.testing.assert_allclose(box.normals[box.faces], np.repeat(g[:, None], 3, 1), atol=1e-6)

    drum = build_mesh(part(shapes.cylinder(1.0, 1.0, 32)))
    assert drum is not None
    assert drum.normals is not None
    heights = np.abs(drum.normals[:, 1])
    assert ((heights < 1e-6) | (heights > 1 - 1e-6)).all()
    side = heights < 0.5
    radial = drum.vertices[side] * (1, 0, 1)
    np.testing.assert_allclose(drum.normals[side], radial, atol=1e-5)


@pytest.mark.parametrize(("turn_deg", "vertices"), [(35, 4), (45, 6)])
def test_the_crease_angle_decides(turn_deg: float, vertices: int) -> None:
    a = math.radians(turn_deg)
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -math.cos(a), -math.sin(a)]]
    mesh = build_mesh(Part("p", points, [[0, 1, 2], [1, 0, 3]]))
    assert mesh is not None
    assert len(mesh.vertices) == vertices


def test_faces_without_area_and_repeated_faces_go() -> None:
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0], [0, 0, 0], [9, 9, 9], [1, 1e-12, 0]]
    faces = [[0, 1, 2], [0, 1, 3], [1, 1, 2], [2, 1, 4], [1, 2, 4], [0, 1, 6]]
    mesh = build_mesh(Part("p", points, faces))
    assert mesh is not None
    assert len(mesh.faces) == 1
    assert len(mesh.vertices) == 3
    assert build_mesh(Part("p", points, [[0, 1, 3]])) is None
    assert build_mesh(Part("p", np.zeros((0, 3)), np.zeros((0, 3), int))) is None


def test_normals_of_the_file_are_kept_and_made_unit(tmp_path: Path) -> None:
    text = TRIANGLE + "vn 0 3 4\nvn 0 0 0\nvn nan 0 1\nf 1//1 2//2 3//3\n"
    mesh = load_one(write(tmp_path / "t.obj", text))
    assert mesh.normals is not None
    by_position = {tuple(v): n for v, n in zip(mesh.vertices.tolist(), mesh.normals, strict=True)}
    np.testing.assert_allclose(by_position[0, 0, 0], [0, 0.6, 0.8], atol=1e-7)
    np.testing.assert_array_equal(by_position[1, 0, 0], 0)  # flat there
    np.testing.assert_array_equal(by_position[0, 1, 0], 0)


def test_merging_is_exact_and_knows_no_negative_zero() -> None:
    points = np.array(
        [[0, 0, 0], [1, 2, 3], [-0.0, 0, -0.0], [1, 2, 3 + 1e-6], [1, 2, 3]], np.float32
    )
    np.testing.assert_array_equal(merge_positions(points), [0, 1, 0, 3, 1])
