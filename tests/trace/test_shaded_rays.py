"""Light along any rays: a camera's own rays give the picture that the tracer gives of it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scenes import crowd, moved

from renderer.camera import Camera
from renderer.scene import load_scene
from renderer.scene.flat import flatten
from renderer.scene.model import Scene, View
from renderer.shaded_rays import AT_ONCE, Shading, shaded
from renderer.trace import Tracer

SIZE = (160, 120)
# float32 in the packets, float64 here: colours, in linear light, and what part of the pixels may
# see another object, or another cell, because an edge passes through their centre.
CLOSE, EDGES = 2e-3, 4e-3


def far_crowd() -> tuple[Scene, View]:
    scene = moved(crowd(), np.array([1e5, -2e5, 5e4]))
    eye = np.array([1e5, -2e5, 5e4]) + (1.0, 1.5, 4.0)
    return scene, View(Camera.look_at(eye, eye - (1.0, 1.3, 4.0)))


def near_crowd(**changes) -> tuple[Scene, View]:
    camera = Camera.look_at((1.0, 1.5, 4.0), (0.0, 0.2, 0.0))
    return crowd(), View(replace(camera, **changes))


def builtin(name: str) -> tuple[Scene, View]:
    scene = load_scene(name)
    return scene, scene.view


SCENES = {
    "crowd": near_crowd,
    "crowd, near and far": lambda: near_crowd(near=2.5, far=5.0),
    "crowd, parallel": lambda: near_crowd(projection="parallel", viewport=(-2.0, 2.0, -1.5, 1.5)),
    "crowd, far away": far_crowd,
    "no objects": lambda: (Scene((), background=(0.2, 0.4, 0.1)), View(Camera.canonical())),
    **{
        name: lambda name=name: builtin(name)
        for name in ("canonical", "primitives", "spheres", "still-life", "columns")
    },
}


def wanted() -> bool:
    return True


def picture(tracer: Tracer, camera: Camera, shading: Shading) -> np.ndarray:
    rays = camera.rays(SIZE)
    made = shaded(tracer, flatten(tracer.scene), rays.origin, rays.direction, shading, wanted)
    assert made is not None
    return made


def differing(a: np.ndarray, b: np.ndarray) -> float:
    """The part of the pixels that differ by more than rounding."""
    return float((np.abs(a - b).max(axis=2) > CLOSE * (1 + np.abs(b).max(axis=2))).mean())


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("effects", [(False, 0), (True, 0), (True, 3)], ids=str)
def test_a_camera_s_rays_give_its_image(name, effects) -> None:
    scene, view = SCENES[name]()
    camera = view.for_size(SIZE)
    shadows, mirror_depth = effects
    with Tracer(scene, shadows=shadows, mirror_depth=mirror_depth) as tracer:
        image = tracer.render(camera, SIZE, ("color",)).channel("color")
        made = picture(tracer, camera, Shading(camera.t_range, shadows, mirror_depth))
    assert made.dtype == np.float32 and made.shape == image.shape
    assert np.isfinite(made).all()
    assert differing(made, image) <= EDGES


def test_the_effects_are_seen() -> None:
    """Otherwise the test above would hold without them."""
    scene, view = builtin("still-life")
    camera = view.for_size(SIZE)
    with Tracer(scene) as tracer:
        plain = picture(tracer, camera, Shading())
        assert differing(picture(tracer, camera, Shading(shadows=True)), plain) > 5 * EDGES
        assert differing(picture(tracer, camera, Shading(mirror_depth=1)), plain) > 5 * EDGES


def test_rays_of_any_length_see_the_same() -> None:
    scene, view = near_crowd()
    rays = view.for_size(SIZE).rays(SIZE)
    lengths = np.random.default_rng(1).uniform(0.01, 100, (*SIZE[::-1], 1))
    with Tracer(scene) as tracer:
        one, other = (
            shaded(tracer, flatten(scene), rays.origin, ways, Shading(), wanted)
            for ways in (rays.direction, lengths * rays.direction)
        )
    assert differing(other, one) <= EDGES


def test_rays_that_are_none_see_the_background() -> None:
    scene, view = near_crowd()
    bad = ((math.nan, 0, -1), (0, 0, 0), (0, math.inf, -1), (1e300, 0, 0))
    ways = np.array([(*bad, (0.0, 0.0, -1.0))])
    origins = np.broadcast_to((0.3, 0.2, 4.0), ways.shape).copy()
    with Tracer(scene) as tracer:
        made = shaded(tracer, flatten(scene), origins, ways, Shading(shadows=True), wanted)
        assert np.allclose(made[0, :4], scene.background)
        assert not np.allclose(made[0, 4], scene.background)
        origins[0, 4] = math.nan
        made = shaded(tracer, flatten(scene), origins, ways, Shading(), wanted)
        assert np.allclose(made, scene.background)


def test_it_ends_when_it_is_no_longer_wanted() -> None:
    scene, _ = near_crowd()
    rays = np.broadcast_to((0.0, 0.0, -1.0), (3 * AT_ONCE, 3))
    asked = iter((True, False))
    with Tracer(scene) as tracer:
        assert shaded(tracer, flatten(scene), rays, rays, Shading(), lambda: next(asked)) is None
    assert next(asked, None) is None
