"""The rasterizer where numbers are large, small or far apart."""

from dataclasses import replace

import numpy as np
import pytest
from raster_scenes import CHECKERED, SIZE, WIDE, agrees, square, triangle
from trace_reference import reference

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import (
    Checker,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)


def test_telephoto_and_far_from_the_world_origin(rasterizer):
    def at(x, y, z):
        return 3e4 + x, -2e4 + y, 1e4 + z

    scene = Scene(
        (
            SceneObject(Sphere(at(0, 0, 0), 1.0), CHECKERED),
            SceneObject(triangle(at(1, 0, 0), at(3, 0, 1), at(2, 2, 0)), CHECKERED),
        ),
        (PointLight(at(3, 4, 5)),),
    )
    camera = Camera.look_at(at(100, 150, 240), at(0.8, 0, 0), fov_y_deg=1)
    frame = agrees(rasterizer, scene, camera, (96, 96))
    exact = reference(scene, camera, (96, 96))
    seen = (frame.id == exact.id) & (frame.id >= 0)
    assert seen.sum() > 1000
    np.testing.assert_allclose(frame.depth[seen], exact.depth[seen], rtol=1e-6)


def test_a_planet_under_the_camera(rasterizer):
    planet = Scene((SceneObject(Sphere((0, -1000, 0), 1000), CHECKERED),), (PointLight((9,) * 3),))
    frame = agrees(rasterizer, planet, Camera.look_at((0, 0.05, 0), (0, 0, -0.3), fov_y_deg=60))
    assert (frame.id == 0).mean() > 0.5


def test_a_planet_s_horizon_has_exact_depths(rasterizer):
    planet = Scene((SceneObject(Sphere((0, -1000, 0), 1000)),))
    camera = Camera.look_at((0, 0.005, 0), (0, 0, -2), fov_y_deg=10)
    rasterizer.set_scene(planet)
    depth = rasterizer.render(camera, SIZE).depth
    exact = reference(planet, camera, SIZE).depth
    seen = exact < 3
    assert seen.mean() > 0.1
    np.testing.assert_allclose(depth[seen], exact[seen], rtol=1e-5)


def test_fine_checkers_through_a_telephoto_lens(rasterizer):
    """Hundreds of borders in a row of pixels: a hit may not slide along the ray."""
    fine = replace(CHECKERED, checker=Checker((0, 0, 0), 0.013))
    shapes = Sphere((-0.8, 0, 0), 0.8), triangle((0, -1, 0.5), (1.6, -1, -0.3), (0.8, 2, 0))
    scene = Scene(tuple(SceneObject(shape, fine) for shape in shapes))
    camera = Camera.look_at((60, 120, 268), (0, 0, 0), fov_y_deg=0.6)
    line = replace(camera, viewport=(-0.5, 0.5, -0.001, 0.001))
    agrees(rasterizer, scene, line, (3000, 1))


def test_small_things_close_by_on_a_vast_plain(rasterizer):
    """Nearer than a millionth of the plain's extent."""
    plain = triangle((-1e5, 0, -1e5), (1e5, 0, -1e5), (0, 0, 1e5))
    scene = Scene(
        (
            SceneObject(plain, CHECKERED),
            SceneObject(Sphere((0, 0.5, -0.08), 0.015)),
            SceneObject(triangle((-0.04, 0.5, -0.07), (0.04, 0.49, -0.07), (0.02, 0.53, -0.06))),
        )
    )
    frame = agrees(rasterizer, scene, replace(WIDE, eye=(0, 0.5, 0)))
    assert set(frame.id.ravel().tolist()) == {-1, 0, 1, 2}


def test_tiny_and_huge_worlds(rasterizer):
    for scale in (1e-6, 1e6):
        scene = Scene(
            (
                SceneObject(Sphere((0, 0, -5 * scale), 2 * scale)),
                SceneObject(square(4 * scale, -6 * scale)),
            )
        )
        frame = agrees(rasterizer, scene, Camera())
        assert frame.depth[12, 16] == pytest.approx(3 * scale, rel=1e-2)
