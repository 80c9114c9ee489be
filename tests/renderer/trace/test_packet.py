"""Packets against the scalar reference: the same picture, but for pixels on its lines.

The reference is float64. Packets are float32: a pixel's centre nearer to an outline than that can
tell may see either side, a depth is rounded at most a few times (DEPTH), and what the product
promises of its two renderers (renderer/compare/raster_and_ray.py) holds between these two as well.
"""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from both_engines import Both
from scenes import crowd
from trace_reference import ball

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.compare.raster_and_ray import CHANNELS
from lucida.renderer.compare.seen_surfaces import TOLERANCE_PX, Surfaces, View, slope_of
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, PointLight, Scene, SceneObject, Sphere
from lucida.renderer.trace.arguments.image import new_image
from lucida.renderer.trace.threads.thread_pool import DONE, Team, cancel, new_control
from lucida.renderer.trace.tiles.engine import PacketEngine
from tools.attack.random_scenes import random_camera

# The corners' coordinates, the plane through them, the key and its inverse are rounded about a
# dozen times; each rounding is half of this. The comparison of random cameras also allows what
# TOLERANCE_PX changes on an oblique surface.
DEPTH = 16 * 2.0**-23


@pytest.fixture
def both():
    """Makes a Both of a scene."""
    made = []

    def make(scene):
        made.append(Both(scene))
        return made[-1]

    yield make
    for one in made:
        one.close()


SCENES = {"crowd": crowd, **{name: lambda name=name: load_scene(name) for name in BUILTIN_SCENES}}


@pytest.mark.parametrize("name", SCENES)
def test_random_cameras_see_the_same(name, both):
    pair = both(SCENES[name]())
    random = np.random.default_rng(11)
    for _ in range(10):
        camera = random_camera(random, pair.flat.bounds)
        size = tuple(int(side) for side in random.integers(20, 150, 2))
        pair.check(camera, size)


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_depth_is_exact_to_a_few_roundings(projection, both):
    pair = both(Scene((SceneObject(ball(60, 90)), SceneObject(Sphere((1.2, 0.4, 0.5), 0.7)))))
    camera = replace(Camera.look_at((3, 2, 4), (0, 0, 0)), projection=projection)
    camera = camera if projection == "perspective" else replace(camera, viewport=(-2, 2, -2, 2))
    size = (300, 300)
    reference, packets = pair.frames(camera, size)
    same = (reference.primitive == packets.primitive) & (reference.primitive >= 0)
    i, j = np.nonzero(same)
    exact = reference.depth[i, j].astype(float)
    # A ray that is off by a 1,000th of a pixel sees another depth on an oblique surface.
    seen = Surfaces(View(pair.flat, camera, size), reference.primitive[i, j], exact)
    slope = slope_of(seen.parameter, i, j)
    error = np.abs(packets.depth[i, j] - exact)
    inside = np.isfinite(slope)  # it has none within a 256th of a pixel of a silhouette
    assert np.all(error[inside] <= (DEPTH * exact + 1e-3 * slope)[inside])
    assert np.count_nonzero(inside) > 10_000


def test_pixels_that_differ_touch_an_outline(both):
    """Not only explained: what float32 decides is a 1,000th of a pixel, not 1/128."""
    pair = both(Scene((SceneObject(ball(60, 90)),)))
    random = np.random.default_rng(12)
    differ = 0
    for _ in range(20):
        camera = random_camera(random, pair.flat.bounds)
        reference, packets = pair.frames(camera, (160, 120), ("id", "primitive"))
        i, j = np.nonzero(reference.id != packets.id)
        seen = np.maximum(reference.primitive[i, j], packets.primitive[i, j])
        surfaces = Surfaces(View(pair.flat, camera, (160, 120)), seen, np.ones(len(i)))
        assert surfaces.at_outline(i, j, TOLERANCE_PX / 4).all()
        differ += len(i)
    assert differ < 20


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_telephoto_view_equals_the_reference(projection, both):
    """Views that see a thousandth of the scene, from near and from far."""
    pair = both(Scene((SceneObject(ball(200, 300)), SceneObject(Sphere((0.9, 0.1, 0.4), 0.05)))))
    for distance, part in itertools.product((3.0, 360.0, 1e4), (0.3, 0.001)):
        eye = np.array([0.6, 0.5, 0.7]) * distance
        half = part * (1 if projection == "parallel" else 1 / np.linalg.norm(eye))
        camera = Camera.look_at(eye, (0.85, 0.1, 0.4))
        camera = replace(camera, viewport=(-half, half, -half, half), projection=projection)
        pair.check(camera, (64, 64))


def test_pixel_centres_on_vertices_and_edges_are_covered(both):
    n = 9
    j, i = np.meshgrid(np.arange(n), np.arange(n))
    vertices = np.stack([j.ravel() - 4, 4 - i.ravel(), np.zeros(n * n)], axis=1)
    corner = (i[:-1, :-1] * n + j[:-1, :-1]).ravel()
    upper = np.stack([corner, corner + n, corner + 1], axis=1)
    lower = np.stack([corner + 1, corner + n, corner + n + 1], axis=1)
    pair = both(Scene((SceneObject(Mesh(vertices, np.concatenate([upper, lower]))),)))
    for projection in ("perspective", "parallel"):
        camera = Camera((0, 0, 8), distance=1.0, projection=projection)
        half = 0.5 if projection == "perspective" else 4.0
        camera = replace(camera, viewport=(-half, half, -half, half))
        _, packets = pair.frames(camera, (16, 16))
        assert (packets.id == 0).all()


@pytest.mark.parametrize("size", [(1, 1), (3, 2), (16, 16), (17, 33), (70, 5)])
def test_images_of_every_size_equal_the_reference(size, both):
    pair = both(crowd())
    camera = Camera.look_at((3, 2, 4), (0, 0, 0)).fitted(size)
    pair.check(camera, size)


@pytest.mark.parametrize("channel", CHANNELS)
def test_a_channel_alone_is_the_same(channel, both):
    pair = both(crowd())
    camera = Camera.look_at((3, 2, 4), (0, 0, 0))
    _, whole = pair.frames(camera, (50, 40))
    _, alone = pair.frames(camera, (50, 40), (channel,))
    assert np.array_equal(alone.channel(channel), whole.channel(channel))
    assert sum(getattr(alone, name) is not None for name in CHANNELS) == 1


def test_transformed_objects_share_a_mesh(both):
    """Mirrored, stretched, sheared, far from the origin: instances of one ball."""
    random = np.random.default_rng(14)
    base = ball(12, 18)
    normals = base.vertices / np.linalg.norm(base.vertices, axis=1, keepdims=True)
    objects = []
    for number in range(12):
        transform = np.eye(4)
        transform[:3, :3] = random.normal(size=(3, 3)) * 0.4
        transform[:3, 3] = random.uniform((98, -2, -2), (102, 2, 2))
        mesh = Mesh(base.vertices, base.faces, normals if number % 2 else None, None, transform)
        objects.append(SceneObject(mesh, Material(specular=(0.4, 0.4, 0.4))))
    pair = both(Scene(tuple(objects), (PointLight((105, 4, 3)),)))
    for projection in ("perspective", "parallel"):
        camera = replace(Camera.look_at((104, 3, 5), (100, 0, 0)), projection=projection)
        half = 0.5 if projection == "perspective" else 3.0
        camera = replace(camera, viewport=(-half, half, -half, half))
        pair.check(camera, (200, 160))


def test_thousands_of_spheres_and_objects(both):
    random = np.random.default_rng(15)
    mesh = ball(4, 6)
    objects = []
    for number, center in enumerate(random.uniform(-5, 5, (3000, 3))):
        if number % 3:
            objects.append(SceneObject(Sphere(tuple(center), 0.1)))
        else:
            transform = np.diag([0.1, 0.1, 0.1, 1.0])
            transform[:3, 3] = center
            objects.append(SceneObject(Mesh(mesh.vertices, mesh.faces, transform=transform)))
    pair = both(Scene(tuple(objects)))
    camera = Camera.look_at((9, 7, 8), (0, 0, 0), fov_y_deg=50)
    assert len(np.unique(pair.check(camera, (300, 200))[1].id)) > 700


def test_inside_and_behind_a_sphere(both):
    pair = both(Scene((SceneObject(Sphere((0, 0, 0), 2)), SceneObject(Sphere((0, 0, 5), 1)))))
    for eye in ((0, 0, 0), (0.5, 1.2, -1), (0, 0, 1.999), (0, 0, 2.001)):
        for projection in ("perspective", "parallel"):
            camera = Camera(eye, distance=0.7, projection=projection)
            pair.check(camera, (60, 60))


@pytest.mark.parametrize("lens", [None, Lens("equidistant")])
def test_a_cancelled_image_stops(lens):
    team = Team(2)
    engine = PacketEngine(crowd(), team)
    control = new_control()
    cancel(control)
    image = new_image((640, 480), ("id",))
    engine.trace(replace(Camera.look_at((3, 2, 4), (0, 0, 0)), lens=lens), image, control)
    assert not image.finished.any()
    assert control[DONE] == 0
    team.close()
