"""Views at the ends of float32: very far away, very narrow, very near; slivers and vast triangles.

Each was wrong once. The reference, plain rays in float64, says what is right.
"""

from dataclasses import replace

import numpy as np
import pytest

from lucida import Camera, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.scene import shapes
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, Mesh, PointLight, Scene, SceneObject, Sphere

SIZE = (48, 36)


def agrees(scene, camera, size, first, second):
    """Return in words what is unexplained in two renderers' images; "" for nothing."""
    for renderer in (first, second):
        renderer.set_scene(scene)
    frames = [renderer.render(camera, size, CHANNELS) for renderer in (first, second)]
    result = compare_frames(flatten(scene), camera, size, *frames)
    return f"{camera}\n{result.summary()}" if result.unexplained else ""


@pytest.fixture(scope="module")
def packets():
    with Tracer(Scene(()), threads=1) as tracer:
        yield tracer


@pytest.fixture(scope="module")
def reference():
    with Tracer(Scene(()), threads=1, method="reference") as tracer:
        yield tracer


def from_afar(rng, projection, far, pixels):
    """A camera `far` from the origin, which it sees off the image's centre; `pixels`: how large a
    thing one unit long is."""
    eye = rng.normal(size=3)
    eye *= far / np.linalg.norm(eye)
    camera = Camera.look_at(eye, (0, 0, 0), rng.normal(size=3), projection=projection)
    half = SIZE[0] / pixels / 2 / (1.0 if camera.is_parallel else far)
    x, y = rng.uniform(-0.9, 0.9, 2) * half
    return replace(camera, viewport=(x - half, x + half, y - half, y + half))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_mesh_much_smaller_than_a_pixel_fills_no_tile(projection, packets):
    packets.set_scene(Scene((SceneObject(shapes.torus()),)))
    rng = np.random.default_rng(1)
    for _ in range(30):
        camera = from_afar(rng, projection, 10 ** rng.uniform(4, 8), 10 ** rng.uniform(-6, -2))
        seen = packets.render(camera, SIZE, ("id",)).id >= 0
        assert np.count_nonzero(seen) <= 1, camera


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("shape", ["mesh", "sphere"])
def test_checkers_and_lights_are_exact_from_very_far_away(shape, projection, packets, reference):
    material = Material((0.9, 0.8, 0.7), checker=Checker((0.1, 0.2, 0.3), 0.21))
    body = shapes.box((1, 0.8, 0.7)) if shape == "mesh" else Sphere((0.1, 0, 0), 0.5)
    lights = (PointLight((0.7, 0.6, 0.5), (0.9, 0.5, 0.4)),)
    scene = Scene((SceneObject(body, material),), lights)
    rng = np.random.default_rng(2)
    for _ in range(8):
        camera = from_afar(rng, projection, 10 ** rng.uniform(3, 7), 30)
        assert not (wrong := agrees(scene, camera, SIZE, reference, packets)), wrong


def test_a_sliver_much_smaller_than_a_pixel_covers_no_line(packets):
    """The first triangle's corners are on one line in float32; the other gives them an origin."""
    corners = [
        (-36.458343505859375, 48.4150276184082, -17.39499855041504),
        (-276.6924743652344, 49.78589630126953, -10.32468032836914),
        (160.10025024414062, 40.300350189208984, -24.407995223999023),
        (-423.083740234375, -19.627660751342773, -35.41630554199219),
        (334.024169921875, 60.122798919677734, 18.41884422302246),
        (334.024169921875, 60.122798919677734, 18.41884422302246),
    ]
    camera = Camera(
        eye=(-11394.465768069042, 35.54910206161289, -111.88827822565413),
        u=(0, 0, 1),
        v=(0, -1, 0),
        w=(-1, 0, 0),
        distance=0.9758834893139058,
        viewport=(-1491.0331231032555, 6662.334465369282, -1207.0175101026534, 6946.350078369885),
    )
    packets.set_scene(Scene((SceneObject(Mesh(corners, np.arange(6).reshape(2, 3))),)))
    assert (packets.render(camera, (19, 17), ("id",)).id == -1).all()


def test_a_very_small_sphere_far_away_shows_its_near_side(packets, reference):
    scene = Scene((SceneObject(Sphere((0, 0, 0), 0.2)),))
    rng = np.random.default_rng(3)
    for _ in range(8):
        camera = from_afar(rng, "perspective", 10 ** rng.uniform(5, 6.5), 60)
        assert not (wrong := agrees(scene, camera, SIZE, reference, packets)), wrong


def sliver(turn, **arrays):
    """A triangle a thousand units long and 0.03 high, turned."""
    corners = np.array([(-500, 0, 0), (500, -0.015, 0), (500, 0.015, 0)]) @ turn.T
    return Mesh(corners, [[0, 1, 2]], **arrays)


def along_the_sliver(turn, far, projection="parallel"):
    """Looks straight down on it; what it is high, or a little less, fills the image."""
    eye = tuple(turn @ (0, 0, far))
    viewport = (-500.0, 500.0, -0.01, 0.01)
    if projection == "perspective":
        viewport = tuple(x / far for x in viewport)
    return Camera(eye, *(tuple(v) for v in turn.T), viewport=viewport, projection=projection)


def turned(seed):
    """A rotation matrix."""
    q = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return q * np.sign(np.linalg.det(q))


@pytest.mark.parametrize("far", [0.5, 300.0, 3000.0])
@pytest.mark.parametrize("material", [Material(), Material(checker=Checker(size=0.4))])
def test_a_slivers_normal_and_cells_keep_their_digits(far, material, rasterizer, reference):
    for seed in range(4):
        scene = Scene((SceneObject(sliver(turned(seed)), material),), (PointLight((0, 0, 900)),))
        camera = along_the_sliver(turned(seed), far)
        assert not (wrong := agrees(scene, camera, SIZE, reference, rasterizer)), wrong


def test_a_vast_triangle_fills_a_very_narrow_view(rasterizer):
    """Its corners are many millions of pixels away, where GL's clipping is pixels wrong."""
    floor = Mesh(np.array([(-4, 0, 4), (4, 0, 4), (0, 0, -5)]) * 1000.0, [[0, 1, 2]])
    rasterizer.set_scene(Scene((SceneObject(floor),)))
    rng = np.random.default_rng(5)
    for _ in range(20):
        camera = Camera.look_at(rng.uniform(1, 2, 3), rng.uniform(-2, 0, 3), rng.normal(size=3))
        half = 10 ** rng.uniform(-5, -3)
        camera = replace(camera, viewport=(-half, half, -half, half))
        assert (rasterizer.render(camera, (40, 8), ("id",)).id == 0).all(), camera


def test_smooth_normals_right_before_the_eye_keep_their_digits(rasterizer, reference):
    """The triangles are long and reach far behind the eye."""
    rng = np.random.default_rng(6)
    normals = rng.normal(size=(3, 3))
    normals[1:] = normals[1] + rng.normal(scale=0.01, size=(2, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    corners = np.array([(0, -60, 160), (1, -61, 160), (0, 100, -300)])
    scene = Scene((SceneObject(Mesh(corners, [[0, 1, 2]], normals)),))
    flat = corners[0] - corners[2]
    for away in (0.02, 0.1, 0.5):
        for side in rng.normal(scale=0.02, size=(4, 3)):
            middle = corners[2] + 0.65 * flat + (0.3, -0.3, 0)
            eye = middle + side + np.array([0, 0.9, 0.4]) * away
            camera = Camera.look_at(eye, middle - 0.3 * flat / np.linalg.norm(flat), (0, 1, 0))
            camera = replace(camera, viewport=(-15, 15, -15, 15))
            assert not (wrong := agrees(scene, camera, SIZE, reference, rasterizer)), wrong
