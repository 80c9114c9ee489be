"""Packets where triangles are smaller than pixels: what is left out there, no pixel's centre sees.

A node's children are dropped between the pixels' centres, and behind what the pixels of their own
squares see; a leaf of few pixels is asked pixel by pixel, one on few squares square by square. All
must give what one ray after another gives, in float64: the same triangle wherever a pixel's centre
is not on an edge, to what float32 can tell of edges.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from trace_reference import ball, random_basis

from renderer.camera import Camera
from renderer.compare import CHANNELS, compare_frames
from renderer.frame import Frame
from renderer.scene.flat import flatten
from renderer.scene.model import Mesh, Scene, SceneObject, Sphere
from renderer.trace.arguments.image import new_image, to_frame
from renderer.trace.arguments.view import KernelView
from renderer.trace.jobs.engine import Engine
from renderer.trace.packets.engine import PacketEngine
from renderer.trace.threads.control import new_control
from renderer.trace.threads.thread_pool import Team

# From less than one triangle a pixel to about a hundred.
SIZES = [(230, 170), (90, 70), (33, 47), (16, 16), (9, 5)]


def rough(rows: int = 150, columns: int = 220) -> Mesh:
    """A closed ball of many small dents: 65,000 triangles, far denser at its poles."""
    mesh = ball(rows, columns)
    v = np.asarray(mesh.vertices, float)
    dents = 0.08 * np.sin(v @ [9, 4, -7]) * np.sin(v @ [-5, 11, 3])
    dents += 0.01 * np.sin(v @ [71, 53, -67.0]) + 0.004 * np.sin(v @ [-171, 193, 157.0])
    return Mesh(v * (1 + dents)[:, None], mesh.faces)


class Pair:
    """A scene in both engines."""

    def __init__(self, scene: Scene) -> None:
        self.flat, self.scene, self.team = flatten(scene), scene, Team(2)
        self.engines = Engine(scene, self.team), PacketEngine(scene, self.team)

    def frames(self, camera: Camera, size: tuple[int, int]) -> list[Frame]:
        """[reference, packets]."""
        frames = []
        for engine in self.engines:
            image = new_image(size, CHANNELS)
            engine.trace(KernelView.of(camera), image, new_control())
            frames.append(to_frame(image, self.scene.background, 0.0))
        return frames

    def check(self, camera: Camera, size: tuple[int, int]) -> Frame:
        """The packets' image, which is the reference's but for pixels on edges."""
        reference, packets = self.frames(camera, size)
        comparison = compare_frames(self.flat, camera, size, reference, packets)
        assert not comparison.unexplained, f"{camera} {size}\n{comparison.summary()}"
        # Not only explained: hardly any pixel's centre is so close to an edge.
        assert np.mean(reference.primitive != packets.primitive) <= 0.01 + 1 / packets.id.size
        return packets


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
    pair = Pair(Scene(objects))
    yield pair
    pair.team.close()


@pytest.fixture(scope="module")
def alone():
    pair = Pair(Scene((SceneObject(rough()),)))
    yield pair
    pair.team.close()


def outside(projection: str) -> Camera:
    camera = Camera.look_at((2.6, 1.7, 3.1), (0.1, 0.1, 0.2), fov_y_deg=40)
    if projection == "parallel":
        return replace(camera, projection=projection, viewport=(-1.7, 1.7, -1.4, 1.4))
    return camera


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("size", SIZES)
def test_every_density(projection: str, size: tuple[int, int], dense: Pair) -> None:
    frame = dense.check(outside(projection), size)
    assert frame.id.max() >= 0


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_skewed_cameras(projection: str, dense: Pair) -> None:
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
        dense.check(camera, SIZES[number % 3])


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_near_and_far_cut_through(projection: str, alone: Pair) -> None:
    camera = outside(projection)
    unit = 1.0 if camera.is_parallel else camera.distance  # of near and far, in t
    for size in SIZES[:3]:
        whole = alone.check(camera, size).depth
        near, far = np.quantile(whole[np.isfinite(whole)], [0.3, 0.6])
        cut = replace(camera, near=float(near * unit), far=float(far * unit))
        depth = alone.check(cut, size).depth
        hits = depth[np.isfinite(depth)]
        assert hits.min() > near
        assert hits.max() < far


@pytest.mark.parametrize("spot", [(0.0, 0.0, 0.0), (0.3, 0.5, 0.2), (0.0, 0.9, 0.0)])
def test_boxes_around_the_eye_and_behind_it(spot: tuple[float, float, float], alone: Pair) -> None:
    """From within, every pixel hits; many boxes are cut by the eye's plane."""
    for number, size in enumerate(SIZES[:4]):
        random = np.random.default_rng(number)
        camera = Camera(spot, *random_basis(random).tolist(), distance=0.5)
        assert (alone.check(camera, size).id == 0).all()


def test_no_pinhole_in_a_closed_dense_mesh(alone: Pair) -> None:
    """Through every leaf's border, and at every density: a box's own rounding loses no pixel."""
    random = np.random.default_rng(13)
    for number in range(40):
        size = int(random.integers(10, 420)), int(random.integers(10, 300))
        eye = random.uniform(-0.3, 0.3, 3)
        camera = Camera(tuple(eye), *random_basis(random).tolist(), distance=0.4)
        if number % 2:
            camera = replace(camera, projection="parallel", viewport=(-0.01, 0.01, -0.01, 0.01))
        image = new_image(size, ("id",))
        alone.engines[1].trace(KernelView.of(camera), image, new_control())
        assert not image.id.any(), f"{camera} {size}"


def test_few_pixels_of_a_far_mesh(alone: Pair) -> None:
    """All of it in a pixel or two: leaves fall between the centres, but not the whole mesh."""
    for distance in (60.0, 250.0, 900.0):
        camera = Camera.look_at((0.6 * distance, 0.5 * distance, 0.62 * distance), (0, 0, 0))
        alone.check(camera, (61, 45))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_what_is_behind_a_wall_is_not_seen(projection: str) -> None:
    """A wall before one half of the image, dense meshes beside it and behind it."""
    mesh = rough(80, 120)
    corners = np.array([[-3, -3, 1.6], [0.2, -3, 1.6], [0.2, 3, 1.6], [-3, 3, 1.6]])
    wall = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    pair = Pair(Scene((SceneObject(mesh), SceneObject(wall))))
    camera = Camera.look_at((0, 0, 6), (0, 0, 0), fov_y_deg=36)
    if projection == "parallel":
        camera = replace(camera, projection=projection, viewport=(-2, 2, -1.5, 1.5))
    for size in SIZES[:3]:
        seen = pair.check(camera, size).id
        assert set(np.unique(seen)) == {-1, 0, 1}
    pair.team.close()
