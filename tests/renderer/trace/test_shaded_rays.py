"""Light along any rays: a camera's own rays give the picture that the tracer gives of it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scenes import crowd, moved

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.trace import Tracer

SIZE = (160, 120)
# float32 in the packets, float64 here: colours, in linear light, and what part of the pixels may
# see another object, or another cell, because an edge passes through their centre.
CLOSE, EDGES = 2e-3, 4e-3


def far_crowd():
    scene = moved(crowd(), np.array([1e5, -2e5, 5e4]))
    camera = Camera.look_at((1e5 + 1.0, -2e5 + 1.5, 5e4 + 4.0), (1e5, -2e5 + 0.2, 5e4))
    return scene, View(camera)


def near_crowd(**changes):
    camera = Camera.look_at((1.0, 1.5, 4.0), (0.0, 0.2, 0.0))
    return crowd(), View(replace(camera, **changes))


def builtin(name):
    scene = load_scene(name)
    return scene, scene.view


SCENES = {
    "crowd": near_crowd,
    "crowd, near and far": lambda: near_crowd(near=2.5, far=5.0),
    "crowd, parallel": lambda: near_crowd(projection="parallel", viewport=(-2.0, 2.0, -1.5, 1.5)),
    "crowd, far away": far_crowd,
    "no objects": lambda: (Scene((), background=(0.2, 0.4, 0.1)), View(Camera.canonical())),
    **{name: lambda name=name: builtin(name) for name in ("canonical", "still-life")},
}


def picture(tracer, camera, lengths=1.0):
    origins, directions = np.broadcast_arrays(*camera.rays(SIZE))
    light = tracer.shaded(
        origins.reshape(-1, 3), lengths * directions.reshape(-1, 3), *camera.t_range
    )
    return light.reshape(directions.shape)


def differing(a, b):
    """The part of the pixels that differ by more than rounding."""
    return float((np.abs(a - b).max(axis=2) > CLOSE * (1 + np.abs(b).max(axis=2))).mean())


@pytest.mark.parametrize("name", SCENES)
def test_a_camera_s_rays_give_its_image(name):
    scene, view = SCENES[name]()
    camera = view.for_size(SIZE)
    with Tracer(scene) as tracer:
        image = tracer.render(camera, SIZE, ("color",)).channel("color")
        made = picture(tracer, camera)
    assert made.dtype == np.float32 and np.isfinite(made).all()
    assert differing(made, image) <= EDGES


def test_rays_of_any_length_see_the_same():
    scene, view = near_crowd()
    camera, lengths = view.for_size(SIZE), np.random.default_rng(1).uniform(0.01, 100, (19200, 1))
    with Tracer(scene) as tracer:
        assert differing(picture(tracer, camera, lengths), picture(tracer, camera)) <= EDGES


def test_rays_that_are_none_see_the_background():
    scene, _ = near_crowd()
    bad = ((math.nan, 0, -1), (0, 0, 0), (0, math.inf, -1), (1e300, 0, 0))
    ways = np.array((*bad, (0.0, 0.0, -1.0)))
    origins = np.broadcast_to((0.3, 0.2, 4.0), ways.shape).copy()
    with Tracer(scene) as tracer:
        made = tracer.shaded(origins, ways)
        assert np.allclose(made[:4], scene.background)
        assert not np.allclose(made[4], scene.background)
        origins[4] = math.nan
        assert np.allclose(tracer.shaded(origins, ways), scene.background)
