"""The probe's index: crossings of lines with triangles and spheres, up to their borders."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lucida.app.instruments.probe.crossings import RUN, Index
from lucida.renderer.scene import shapes
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, Sphere

SQUARE = Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
AHEAD = (0, 0, -1)


def index(*shapes: Mesh | Sphere) -> Index:
    return Index(flatten(Scene(tuple(SceneObject(shape) for shape in shapes))))


def moved(mesh: Mesh, x: float, y: float, z: float) -> Mesh:
    transform = np.eye(4)
    transform[:3, 3] = x, y, z
    return Mesh(mesh.vertices, mesh.faces, transform=transform)


def test_every_crossing_is_found_in_order():
    """Compare with an intersection of each triangle, and with the roots for a sphere."""
    mesh = shapes.torus(segments=40, sides=20)
    scene = Scene((SceneObject(mesh), SceneObject(Sphere((0.5, 0, 0), 0.5))))
    flat = flatten(scene)
    assert len(flat.faces) > 10 * RUN
    torus, rng = Index(flat), np.random.default_rng(2)
    corners = torus.vertices[flat.faces]
    for _ in range(200):
        origin, toward = rng.normal(size=3) * 2, rng.normal(size=3) * 0.3
        direction = toward - origin
        # Möller and Trumbore, over all triangles.
        e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        p = np.cross(direction, e2)
        det = (p * e1).sum(axis=1)
        s = origin - corners[:, 0]
        b1 = (s * p).sum(axis=1) / det
        q = np.cross(s, e1)
        b2 = q @ direction / det
        t = (q * e2).sum(axis=1) / det
        inside = (b1 >= 0) & (b2 >= 0) & (b1 + b2 <= 1)
        out = origin - (0.5, 0, 0)
        roots = np.roots([direction @ direction, 2 * direction @ out, out @ out - 0.25])
        expected = np.sort([*t[inside], *roots[np.isreal(roots)].real])
        np.testing.assert_allclose(torus.crossings(origin, direction).t, expected, rtol=1e-9)


def test_a_common_edge_is_met_once():
    """The edge is a square's diagonal. Two squares are crossed twice, even in one place."""
    square = index(SQUARE)
    for origin, t in (((0.5, 0.5, 3), [3]), ((0.5, 0.5, 0), [0]), ((0.5, 0.5, -2), [-2])):
        assert square.crossings(origin, AHEAD).t.tolist() == t
    two = index(SQUARE, moved(SQUARE, 0, 0, -2)).crossings((0.5, 0.5, 3), AHEAD)
    assert (two.t.tolist(), two.object.tolist()) == ([3, 5], [0, 1])
    same = index(SQUARE, SQUARE).crossings((0.5, 0.25, 3), AHEAD)
    assert (same.t.tolist(), same.primitive.tolist()) == ([3, 3], [0, 2])


@pytest.mark.parametrize("faces", [[0, 1, 2], [1, 2, 0], [2, 1, 0]])
@pytest.mark.parametrize("edge", [(0, -1), (1, 0), (0, 0)])
def test_an_edge_is_met_from_both_sides(edge, faces):
    half = index(Mesh(SQUARE.vertices, [faces]))
    for side in (1, -1):
        assert half.crossings((*edge, 2 * side), (0, 0, -side)).t.tolist() == [2]


def test_a_triangle_seen_edge_on_and_one_without_area_are_not_met():
    edge_on = index(SQUARE)
    assert not len(edge_on.crossings((0, 0, 0), (1, 0, 0)).t)
    assert not len(edge_on.crossings((0, 0, 1), (1, 0, 0)).t)
    thin = Mesh([[0, 0, 0], [1, 0, 0], [0.5, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 1, 3]])
    assert index(thin).crossings((0.25, 0, 2), AHEAD).primitive.tolist() == [1]


def test_a_tangent_meets_a_sphere_once():
    ball = index(Sphere((0, 0, 0), 0.5))
    # A tangent from its point of contact does not meet it.
    assert ball.crossings((0.5, 0, 2), AHEAD).t.tolist() == [2]
    assert not len(ball.crossings((0.5, 0, 0), AHEAD).t)
    assert not len(ball.crossings((math.nextafter(0.5, 1), 0, 2), AHEAD).t)
    # The line begins on the sphere.
    assert ball.crossings((0, 0, 0.5), AHEAD).t.tolist() == [0, 1]
    assert ball.crossings((0, 0, -0.5), AHEAD).t.tolist() == [-1, 0]
    small = index(Sphere((3, 4, 5), 0.001), Sphere((3, 4, 9), 0.5))
    found = small.crossings((3, 4, 0), (0, 0, 2))
    np.testing.assert_allclose(found.t, [2.4995, 2.5005, 4.25, 4.75], rtol=1e-12)
    assert found.primitive.tolist() == [0, 0, 1, 1]
    assert found.b1.tolist() == found.b2.tolist() == [0, 0, 0, 0]


def test_the_closest_hit_is_strictly_between_t_min_and_t_max():
    squares = index(*(moved(SQUARE, 0, 0, -z) for z in (1, 2, 3)))

    def closest(t_min: float, t_max: float) -> float:
        return squares.closest((0.5, 0.25, 0), AHEAD, t_min, t_max)

    assert closest(0, math.inf) == 1
    assert closest(1, math.inf) == 2
    assert closest(1.5, 2) == math.inf
    assert closest(1.5, 2.5) == 2
    assert index().closest((0, 0, 0), AHEAD, 0, math.inf) == math.inf


def test_a_mesh_returns_its_own_first_hit():
    """Among the meshes are a sphere, which has no triangles, and a mesh of several runs."""
    many = np.tile(SQUARE.faces, (RUN, 1))
    meshes = index(
        SQUARE, Sphere((0, 0, -1), 0.5), moved(Mesh(SQUARE.vertices, many), 0, 0, -2),
        moved(SQUARE, 0, 0, -3),
    )  # fmt: skip

    def hit(number: int, t_min: float = 0.0, t_max: float = math.inf):
        return meshes.mesh_hit(number, (0.5, 0.25, 1), AHEAD, t_min, t_max)

    assert hit(0) == (1, 0, 0.125, 0.625)  # of (-1, -1), (1, -1), (1, 1)
    # The first of equal triangles.
    assert hit(2) == (3, 2, 0.125, 0.625)
    assert hit(3) == (4, 2 + 2 * RUN, 0.125, 0.625)
    assert hit(1) is None
    assert hit(3, 3.5, 4) is None and hit(3, 4, 5) is None
    assert hit(3, 3.5, 4.5) is not None
