"""The questions to a file about a camera, and the rays that its answers are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from right_code import right_ray

from lucida.app.checking.kinds import KINDS
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import Call, Run
from lucida.app.checking.your_code.model import (
    RAY,
    CodeRays,
    canvas_pixel,
    cases_for,
    ray_task_for,
    rays_of,
)
from lucida.renderer.camera.camera import Camera

SIZE = (6, 4)
CAMERA = Camera.look_at((1.0, 2.0, 5.0), (0.0, 0.5, 0.0), (0.1, 1.0, 0.0), aspect=1.5)
PARALLEL = replace(CAMERA, projection="parallel")
SKEWED = replace(CAMERA, u=(0.8, 0.1, 0.2), viewport=(-0.2, 0.7, -0.4, 0.3))


def task(kind: str, projection: str = "perspective"):
    return next(one for one in BUILTIN if one.kind == kind and projection == one.projection)


def answered(camera: Camera, answer) -> CodeRays:
    """The rays of a function of the arguments by their names."""
    asked = task(RAY, camera.projection)
    cases = cases_for(asked, camera, SIZE)
    calls: list[Call] = KINDS[RAY].calls(asked, cases)
    values = [answer(dict(call.arguments)) for call in calls]
    return rays_of(asked, SIZE, cases, Run(tuple(values)))


@pytest.mark.parametrize(
    "camera", [CAMERA, PARALLEL, SKEWED], ids=["look-at", "parallel", "skewed"]
)
def test_a_right_ray_is_right_on_the_window_s_camera(camera):
    rays = answered(camera, right_ray)
    assert rays.result.status == "right"
    assert not rays.wrong.any()
    assert rays.came.all()
    ray = camera.ray(3, 5, SIZE)
    assert np.allclose(rays.right[3, 5, 0], ray.origin)
    assert np.allclose(rays.right[3, 5, 1], ray.direction)
    factor = 1 if camera.is_parallel else 3
    assert np.allclose(rays.given[3, 5, 1], factor * np.asarray(ray.direction))


def test_wrong_rays_are_marked_where_they_are():
    def half_wrong(known):
        origin, direction = right_ray(known)
        return [origin, [-part for part in direction]] if known["i"] < 2 else [origin, direction]

    rays = answered(CAMERA, half_wrong)
    assert rays.result.status == "wrong"
    assert rays.wrong.tolist() == [[True] * 6] * 2 + [[False] * 6] * 2


def test_the_task_follows_the_projection():
    perspective, parallel = task(RAY), task(RAY, "parallel")
    assert perspective != parallel
    assert ray_task_for(PARALLEL) == parallel
    assert ray_task_for(CAMERA) == perspective


def test_pixels_pass_from_the_canvas_to_the_image_and_back():
    wide = replace(CAMERA, viewport=(-1.0, 1.0, -0.5, 0.5))
    canvas = replace(CAMERA, viewport=(-0.75, 0.75, -0.5, 0.5))
    big, small = (400, 200), (12, 8)
    for row in range(8):
        for column in range(12):
            there = canvas_pixel((row, column), canvas, small, wide, big)
            assert canvas_pixel(there, wide, big, canvas, small) == (row, column)
    assert canvas_pixel((0, 0), wide, big, canvas, small) == (0, 0)  # outside of the canvas
    assert canvas_pixel((199, 399), wide, big, canvas, small) == (7, 11)
    assert canvas_pixel((0, 0), canvas, (2, 2), canvas, (4, 4)) == (0, 0)  # a corner between four
