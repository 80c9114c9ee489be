"""No ray from inside a closed mesh gets out, wherever it is aimed."""

from __future__ import annotations

import numpy as np
import pytest
from trace_reference import ball, cast, random_basis, scene_of, tree_of

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.flat import FlatScene, flatten
from lucida.renderer.scene.model import Mesh
from lucida.renderer.scene.positions import world_vertices
from lucida.renderer.trace import Tracer


def leaks(flat: FlatScene, eye: np.ndarray, targets: np.ndarray, scale: float = 1.0) -> int:
    directions = (targets - eye) * scale
    origins = np.ascontiguousarray(np.broadcast_to(eye, directions.shape))
    _, primitive, _, _ = cast(tree_of(flat), origins, directions, 0.0, np.inf)
    return int((primitive < 0).sum())


def closed_mesh(kind: str) -> Mesh:
    mesh = ball()
    if kind == "ball":
        return mesh
    random = np.random.default_rng(3)
    if kind == "box":
        corners = np.array(list(np.ndindex(2, 2, 2)), float) * 2 - 1
        faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
        faces += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
        return Mesh(corners, np.array(faces))
    transform = np.eye(4)
    transform[:3, :3] = random_basis(random) @ np.diag([1, 30, 0.02])
    transform[:3, 3] = random.normal(size=3) * 100
    return Mesh(mesh.vertices, mesh.faces, transform=transform)


@pytest.mark.parametrize("kind", ["ball", "box", "squashed"])
def test_rays_at_vertices_and_edges_do_not_leak(kind):
    flat = flatten(scene_of(closed_mesh(kind)))
    vertices = world_vertices(flat)
    random = np.random.default_rng(4)
    centre = vertices.mean(axis=0)
    a, b = vertices[flat.faces], vertices[np.roll(flat.faces, 1, axis=1)]
    for spot in range(12):
        inside = random.integers(len(vertices), size=4)
        eye = centre if spot == 0 else 0.3 * centre + 0.7 * vertices[inside].mean(axis=0)
        along = random.uniform(size=(*a.shape[:2], 1))
        scale = 10.0 ** random.uniform(-6, 6)
        assert leaks(flat, eye, vertices, scale) == 0
        for part in (0.5, along):
            targets = (a + part * (b - a)).reshape(-1, 3)
            assert leaks(flat, eye, targets, scale) == 0


def test_a_symmetric_view_through_vertices_is_full():
    # Pixel centres fall on the vertices and diagonals of a grid.
    n = 9
    j, i = np.meshgrid(np.arange(n), np.arange(n))
    vertices = np.stack([j.ravel() - 4, 4 - i.ravel(), np.zeros(n * n)], axis=1)
    corner = (i[:-1, :-1] * n + j[:-1, :-1]).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + n, corner + n + 1], axis=1),
            np.stack([corner, corner + n + 1, corner + 1], axis=1),
        ]
    )
    scene = scene_of(Mesh(vertices, faces))
    camera = Camera((0, 0, 1), viewport=(-4.5, 4.5, -4.5, 4.5), projection="parallel")
    with Tracer(scene) as tracer:
        frame = tracer.render(camera, (9, 9), ("depth", "id", "primitive"))
    assert (frame.depth == 1).all()
    # Each vertex is shared: the lowest number wins.
    assert frame.primitive[0, 0] == 0
