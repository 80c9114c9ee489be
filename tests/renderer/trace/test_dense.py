"""Packets where triangles are smaller than pixels: what is left out there, no pixel's centre sees.

A node's children are dropped between the pixels' centres, and behind what the pixels of their own
squares see; a leaf of few pixels is asked pixel by pixel, one on few squares square by square. All
must give what one ray after another gives, in float64: the same triangle wherever a pixel's centre
is not on an edge, to what float32 can tell of edges.
"""

from dataclasses import replace

import numpy as np
import pytest
from both_engines import Both
from trace_reference import ball, random_basis

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, Sphere
from lucida.renderer.trace.arguments.image import new_image
from lucida.renderer.trace.threads.thread_pool import new_control

# From less than one triangle a pixel to about a hundred.
SIZES = [(230, 170), (90, 70), (33, 47), (16, 16), (9, 5)]


def rough(rows=150, columns=220):
    """A closed ball of many small dents: 65,000 triangles, far denser at its poles."""
    mesh = ball(rows, columns)
    v = np.asarray(mesh.vertices, float)
    dents = 0.08 * np.sin(v @ [9, 4, -7]) * np.sin(v @ [-5, 11, 3])
    dents += 0.01 * np.sin(v @ [71, 53, -67.0]) + 0.004 * np.sin(v @ [-171, 193, 157.0])
    return Mesh(v * (1 + dents)[:, None], mesh.faces)


@pytest.fixture(scope="module")
def dense():
    """A rough ball; a smaller one, squashed and turned; spheres before and behind."""
    turned = np.eye(4)
    turned[:3, :3] = random_basis(np.random.default_rng(2)) * 0.15
    turned[:3, 3] = 0.9, 0.7, 0.8
    mesh = rough()
    objects = (
        SceneObject(mesh),
        SceneObject(Mesh(mesh.vertices, mesh.faces, transform=turned)),
        SceneObject(Sphere((0.3, 0.9, 1.1), 0.3)),
        SceneObject(Sphere((-0.9, -0.2, -0.9), 0.6)),
    )
    pair = Both(Scene(objects))
    yield pair
    pair.close()


@pytest.fixture(scope="module")
def alone():
    pair = Both(Scene((SceneObject(rough()),)))
    yield pair
    pair.close()


def outside(projection):
    camera = Camera.look_at((2.6, 1.7, 3.1), (0.1, 0.1, 0.2), fov_y_deg=40)
    if projection == "parallel":
        return replace(camera, projection=projection, viewport=(-1.7, 1.7, -1.4, 1.4))
    return camera


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("size", SIZES)
def test_dense_meshes_are_traced_closely_at_every_size(projection, size, dense):
    frame = dense.check_closely(outside(projection), size)
    assert frame.id.max() >= 0


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_skewed_cameras_trace_dense_meshes_closely(projection, dense):
    random = np.random.default_rng(5)
    for number in range(8):
        w = random.normal(size=3)
        w /= np.linalg.norm(w)
        straight = Camera.look_at(tuple(w * random.uniform(2, 9)), (0, 0, 0))
        u, v, w = straight.basis.T
        u, v = 1.3 * u + 0.4 * v, 0.8 * v - 0.2 * u + 0.2 * w
        half = 0.5 if projection == "perspective" else 1.5
        camera = replace(
            straight, u=tuple(u), v=tuple(v), projection=projection,
            viewport=(-half, 1.2 * half, -0.9 * half, half),
        )  # fmt: skip
        dense.check_closely(camera, SIZES[number % 3])


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_near_and_far_cut_through(projection, alone):
    camera = outside(projection)
    unit = 1.0 if camera.is_parallel else camera.distance  # of near and far, in t
    for size in SIZES[:3]:
        whole = alone.check_closely(camera, size).depth
        near, far = np.quantile(whole[np.isfinite(whole)], [0.3, 0.6])
        cut = replace(camera, near=float(near * unit), far=float(far * unit))
        depth = alone.check_closely(cut, size).depth
        hits = depth[np.isfinite(depth)]
        assert hits.min() > near
        assert hits.max() < far


def test_no_pinhole_in_a_closed_dense_mesh(alone):
    """Through every leaf's border, and at every density: a box's own rounding loses no pixel."""
    random = np.random.default_rng(13)
    for number in range(40):
        size = int(random.integers(10, 420)), int(random.integers(10, 300))
        eye = random.uniform(-0.3, 0.3, 3)
        camera = Camera(tuple(eye), *random_basis(random).tolist(), distance=0.4)
        if number % 2:
            camera = replace(camera, projection="parallel", viewport=(-0.01, 0.01, -0.01, 0.01))
        image = new_image(size, ("id",))
        alone.packets.trace(camera, image, new_control())
        assert not image.id.any(), f"{camera} {size}"


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_what_is_behind_a_wall_is_not_seen(projection):
    """A wall before one half of the image, dense meshes beside it and behind it."""
    mesh = rough(80, 120)
    corners = np.array([[-3, -3, 1.6], [0.2, -3, 1.6], [0.2, 3, 1.6], [-3, 3, 1.6]])
    wall = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    pair = Both(Scene((SceneObject(mesh), SceneObject(wall))))
    camera = Camera.look_at((0, 0, 6), (0, 0, 0), fov_y_deg=36)
    if projection == "parallel":
        camera = replace(camera, projection=projection, viewport=(-2, 2, -1.5, 1.5))
    for size in SIZES[:3]:
        seen = pair.check_closely(camera, size).id
        assert set(np.unique(seen)) == {-1, 0, 1}
    pair.close()
