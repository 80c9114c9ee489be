"""No ray from inside a closed mesh gets out, wherever it is aimed."""

import numpy as np
import pytest
from trace_reference import ball, cast, random_basis, scene_of, tree_of

from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Mesh
from lucida.renderer.scene.positions import world_vertices


def leaks(flat, eye, targets, scale=1.0):
    directions = (targets - eye) * scale
    origins = np.ascontiguousarray(np.broadcast_to(eye, directions.shape))
    _, primitive, _, _ = cast(tree_of(flat), origins, directions, 0.0, np.inf)
    return int((primitive < 0).sum())


def closed_mesh(kind):
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
    for spot in range(6):
        inside = random.integers(len(vertices), size=4)
        eye = centre if spot == 0 else 0.3 * centre + 0.7 * vertices[inside].mean(axis=0)
        along = random.uniform(size=(*a.shape[:2], 1))
        scale = 10.0 ** random.uniform(-6, 6)
        assert leaks(flat, eye, vertices, scale) == 0
        for part in (0.5, along):
            targets = (a + part * (b - a)).reshape(-1, 3)
            assert leaks(flat, eye, targets, scale) == 0
