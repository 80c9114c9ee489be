"""Procedural meshes: closed, outward, of the volume and area that geometry gives them."""

import math

import numpy as np
import pytest

from lucida.renderer.scene import shapes
from lucida.renderer.scene.normals import face_normals, merge_positions
from lucida.renderer.system.errors import LucidaError

CLOSED = {
    "box": (lambda: shapes.box((1, 2, 3)), 6.0, 2),
    "cylinder": (lambda: shapes.cylinder(0.5, 2.0, 256), math.pi / 4 * 2, 2),
    "flat cylinder": (lambda: shapes.cylinder(0.5, 2.0, 256, smooth=False), math.pi / 4 * 2, 2),
    "cone": (lambda: shapes.cone(0.5, 2.0, 256), math.pi / 4 * 2 / 3, 2),
    "torus": (lambda: shapes.torus(1.0, 0.25, 256, 256), 2 * math.pi**2 * 0.25**2, 0),
    "three-sided cylinder": (lambda: shapes.cylinder(1.0, 1.0, 3), 3 * math.sqrt(3) / 4, 2),
}


def volume(mesh):
    a, b, c = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


@pytest.mark.parametrize("name", CLOSED)
def test_closed_shapes_have_their_volume_and_no_gap(name):
    make, expected, euler = CLOSED[name]
    mesh = make()
    assert volume(mesh) == pytest.approx(expected, rel=3e-4)  # above 0: faces look outward
    faces = merge_positions(mesh.vertices)[mesh.faces]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    to, fro = (np.sort(edges @ weights) for weights in ((1 << 32, 1), (1, 1 << 32)))
    assert (np.diff(to) > 0).all()
    assert np.array_equal(to, fro)  # each edge once in either direction
    assert len(np.unique(faces)) - len(edges) // 2 + len(faces) == euler


@pytest.mark.parametrize("name", CLOSED)
def test_vertex_normals_are_unit_and_on_the_side_of_their_faces(name):
    mesh = CLOSED[name][0]()
    if mesh.normals is None:
        assert name in ("box", "flat cylinder")
        return
    lengths = np.linalg.norm(mesh.normals, axis=1)
    assert np.all((np.abs(lengths - 1) < 1e-6) | (lengths == 0))
    g = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
    g /= np.linalg.norm(g, axis=1, keepdims=True)
    at_corners = mesh.normals[mesh.faces].astype(float)
    agreement = np.einsum("fi,fki->fk", g, at_corners)
    smooth = np.linalg.norm(at_corners, axis=2) > 0
    assert (agreement[smooth] > 0.49).all()  # a triangle's three-sided cylinder turns by 60 degrees


def test_flat_shapes_have_their_area_and_face_upwards():
    for mesh, area in ((shapes.rectangle(2, 3), 6.0), (shapes.disk(0.5, 256), math.pi / 4)):
        doubled = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
        assert (doubled[:, 1] > 0).all()
        assert doubled.sum(axis=0) / 2 == pytest.approx([0, area, 0], rel=3e-4)


def test_every_side_of_a_cone_leads_to_its_tip():
    mesh = shapes.cone(0.5, 2.0, 12)
    sides = mesh.vertices[mesh.faces[:12]].astype(float)
    np.testing.assert_allclose(sides[:, 2], np.tile([0, 1, 0], (12, 1)), atol=1e-7)
    np.testing.assert_allclose(np.hypot(sides[:, :2, 0], sides[:, :2, 2]), 0.5, atol=1e-7)
    left, right, tip = np.moveaxis(mesh.normals[mesh.faces[:12]].astype(float), 1, 0)
    middle = (left + right) * (1, 0, 1)
    level = tip * (1, 0, 1)
    np.testing.assert_allclose(np.cross(middle, level), 0, atol=1e-6)
    assert ((middle * level).sum(axis=1) > 0).all()


def test_torus_normals_are_those_of_the_surface():
    mesh = shapes.torus(1.0, 0.25, 32, 16)
    p = mesh.vertices.astype(float)
    ring = p * (1, 0, 1)
    ring /= np.linalg.norm(ring, axis=1, keepdims=True)
    assert mesh.normals is not None
    np.testing.assert_allclose(mesh.normals, (p - ring) / 0.25, atol=1e-6)


@pytest.mark.parametrize("make", [lambda: shapes.rectangle(2, 3), lambda: shapes.disk(1.0, 12)])
def test_flat_shapes_face_up(make):
    mesh = make()
    g = face_normals(mesh.vertices, mesh.faces.astype(np.int64))
    assert (g[:, 1] > 0).all()
    np.testing.assert_allclose(g[:, [0, 2]], 0, atol=1e-12)
    area = g[:, 1].sum() / 2
    assert area == pytest.approx(6.0 if len(g) == 2 else 12 * math.sin(math.pi / 6) / 2, rel=1e-6)


def test_placement_scales_then_rotates_about_x_y_z_then_translates():
    matrix = shapes.placement((10, 20, 30), (90, 0, 90), (1, 2, 3))
    # x: 1 -> about x: x -> about z: y. y: 2 -> about x: z. z: 3 -> about x: -y -> about z: x.
    np.testing.assert_array_equal(matrix[:3, :3], [[0, 0, 3], [1, 0, 0], [0, 2, 0]])
    np.testing.assert_array_equal(matrix[:, 3], [10, 20, 30, 1])
    np.testing.assert_array_equal(shapes.placement(rotate_deg=(0, 3600, 0)), np.eye(4))


def test_moving_a_mesh_moves_it_in_world_space():
    mesh = shapes.transformed(shapes.box(), shapes.placement((1, 0, 0)))
    mesh = shapes.transformed(mesh, shapes.placement(rotate_deg=(0, 90, 0)))
    mesh = shapes.transformed(mesh, shapes.placement(scale=2))
    np.testing.assert_array_equal(mesh.transform[:3, 3], [0, 0, -2])
    np.testing.assert_array_equal(mesh.transform[:3, :3], [[0, 0, 2], [0, 2, 0], [-2, 0, 0]])


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: shapes.cylinder(segments=10**9), "segments"),
        (lambda: shapes.torus(sides=2), "sides"),
        (lambda: shapes.cone(segments=3.0), "segments"),
        (lambda: shapes.cone(radius=0), "radius"),
        (lambda: shapes.disk(radius=math.nan), "radius"),
        (lambda: shapes.rectangle(width=math.inf), "width"),
        (lambda: shapes.rectangle(depth="1"), "depth"),
        (lambda: shapes.box((1, -1, 1)), "size"),
        (lambda: shapes.box((1, 1)), "size"),
        (lambda: shapes.torus(0.5, 0.5), "tube_radius"),
        (lambda: shapes.transformed(shapes.box(), shapes.placement(scale=0)), "scale"),
        (lambda: shapes.transformed(shapes.box(), shapes.placement((0, 0, math.nan))), "translate"),
    ],
)
def test_wrong_numbers_are_named(make, field):
    with pytest.raises(LucidaError) as caught:
        make()
    assert caught.value.field == field
    assert caught.value.remedy
