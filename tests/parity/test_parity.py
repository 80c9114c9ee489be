"""The product's promise: both renderers agree at every pixel, for any camera and any scene.

`make attack ARGS=random_views` tries thousands of cameras more.
"""

from dataclasses import replace

import numpy as np
import pytest
from scenes import crowd

from lucida import Camera, Rasterizer, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.compare.why_black import darkness
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, Mesh, PointLight, Scene, SceneObject, Sphere
from tools.attack.random_scenes import random_camera

CAMERAS = 12

SCENES = {"crowd": crowd, **{name: lambda name=name: load_scene(name) for name in BUILTIN_SCENES}}


def compared(flat, renderers, camera, size):
    raster, ray = (renderer.render(camera, size, channels=CHANNELS) for renderer in renderers)
    assert ray.complete
    return compare_frames(flat, camera, size, raster, ray)


@pytest.mark.parametrize("name", SCENES)
def test_random_cameras_agree(name, gl_backend):
    scene = SCENES[name]()
    flat = flatten(scene)
    rng = np.random.default_rng(20261120)
    tried = seeing = 0
    with Rasterizer(scene, backend=gl_backend) as rasterizer, Tracer(scene) as tracer:
        while seeing < CAMERAS:
            camera = random_camera(rng, flat.bounds)
            size = tuple(int(side) for side in rng.integers(30, 120, 2))
            result = compared(flat, (rasterizer, tracer), camera, size)
            message = f"camera {tried}, {size}: {camera}\n{result.summary()}"
            assert result.unexplained == 0, message
            assert sum(result.explained.values()) < 0.02 * result.pixels + 5, message
            tried += 1
            seeing += bool((result.ray.id >= 0).any())
    assert tried < 3 * CAMERAS


@pytest.mark.parametrize("name", BUILTIN_SCENES)
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_the_scenes_own_view_agrees(name, projection, gl_backend):
    scene = load_scene(name)
    size = (320, 180)
    camera = replace(scene.view.for_size(size), projection=projection)
    with Rasterizer(scene, backend=gl_backend) as rasterizer, Tracer(scene) as tracer:
        result = compared(flatten(scene), (rasterizer, tracer), camera, size)
    assert result.unexplained == 0, result.summary()
    assert darkness(flatten(scene), camera, result.ray).shown(0.0) is None


def test_near_and_far_cut_both_alike(gl_backend):
    scene = crowd()
    flat = flatten(scene)
    rng = np.random.default_rng(5)
    with Rasterizer(scene, backend=gl_backend) as rasterizer, Tracer(scene) as tracer:
        for number in range(12):
            camera = random_camera(rng, flat.bounds)
            depth = tracer.render(camera, (40, 40), channels=("depth",)).depth
            hits = depth[np.isfinite(depth)]
            if not len(hits):
                continue
            unit = 1 if camera.is_parallel else camera.distance
            near, far = np.quantile(hits, (0.2, 0.7)) * unit
            cut = replace(camera, near=max(near, 1e-6), far=max(far, near * 1.01, 2e-6))
            result = compared(flat, (rasterizer, tracer), cut, (60, 50))
            assert result.unexplained == 0, f"camera {number}: {cut}\n{result.summary()}"


@pytest.mark.parametrize("side", [1e3, 1e5, 1e6])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_vast_plain_seen_from_just_above_it_agrees(side, projection):
    """Its corners are so far away that float32 alone cannot tell how far below the eye it is."""
    half = side / 2
    corners = [(-half, 0, -half), (half, 0, -half), (half, 0, half), (-half, 0, half)]
    plain = Mesh(corners, [[0, 2, 1], [0, 3, 2]])
    scene = Scene(
        (
            SceneObject(plain, Material(checker=Checker(size=1.0))),
            SceneObject(Sphere((0, 0.5, -3), 0.5)),
        ),
        (PointLight((2, 3, 4)),),
    )
    camera = Camera.look_at(
        (0.3, 0.5, 2), (0, 0.4, -3), fov_y_deg=50, aspect=1.6, projection=projection
    )
    with Rasterizer(scene) as rasterizer, Tracer(scene) as tracer:
        result = compared(flatten(scene), (rasterizer, tracer), camera, (160, 100))
    assert result.unexplained == 0, result.summary()
    assert result.agree > 0.95 * result.pixels
