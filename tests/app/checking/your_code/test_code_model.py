"""The questions to a file about a camera, and the rays that its answers are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from right_code import right_ray

from lucida.app.checking.builtin import BUILTIN
from lucida.app.checking.calls import Call, Run
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.your_code.model import (
    BASIS,
    RAY,
    CodeRays,
    canvas_pixel,
    cases_for,
    for_camera,
    is_of_camera,
    rays_of,
)
from lucida.renderer.camera.camera import Camera

SIZE = (6, 4)
CAMERA = Camera.look_at((1.0, 2.0, 5.0), (0.0, 0.5, 0.0), (0.1, 1.0, 0.0), aspect=1.5)
PARALLEL = replace(CAMERA, projection="parallel")
SKEWED = replace(CAMERA, u=(0.8, 0.1, 0.2), viewport=(-0.2, 0.7, -0.4, 0.3))


def task(kind: str, projection: str = "perspective"):
    return next(
        one
        for one in BUILTIN
        if one.kind == kind and (kind == BASIS or projection in one.projections)
    )


def answered(camera: Camera, answer, kind: str = RAY, last: int | None = None) -> CodeRays:
    """The rays of a function of the arguments by their names."""
    asked = task(kind, camera.projection)
    cases = cases_for(asked, camera, SIZE)
    calls: list[Call] = KINDS[kind].calls(asked, cases)
    values = [answer(dict(call.arguments)) for call in calls[:last]]
    return rays_of(asked, camera, SIZE, cases, Run(tuple(values)))


@pytest.mark.parametrize(
    "camera", [CAMERA, PARALLEL, SKEWED], ids=["look-at", "parallel", "skewed"]
)
def test_a_right_ray_is_right_on_the_window_s_camera(camera):
    rays = answered(camera, right_ray)
    assert rays.result.status == "right"
    assert not rays.wrong.any()
    assert rays.came.all()
    ray = camera.ray(3, 5, SIZE)
    assert np.allclose(rays.right_origins[3, 5], ray.origin)
    assert np.allclose(rays.right_directions[3, 5], ray.direction)
    factor = 1 if camera.is_parallel else 3
    assert np.allclose(rays.directions[3, 5], factor * np.asarray(ray.direction))


def test_wrong_rays_are_marked_where_they_are():
    def half_wrong(known):
        origin, direction = right_ray(known)
        return [origin, [-part for part in direction]] if known["i"] < 2 else [origin, direction]

    rays = answered(CAMERA, half_wrong)
    assert rays.result.status == "wrong"
    assert rays.wrong.tolist() == [[True] * 6] * 2 + [[False] * 6] * 2


def right_basis(known):
    w = np.subtract(known["eye"], known["target"])
    w = w / np.linalg.norm(w)
    u = np.cross(known["up"], w)
    u = u / np.linalg.norm(u)
    return [u.tolist(), np.cross(w, u).tolist(), w.tolist()]


@pytest.mark.parametrize("camera", [CAMERA, PARALLEL], ids=["perspective", "parallel"])
def test_a_basis_makes_the_rays_of_the_camera(camera):
    rays = answered(camera, right_basis, BASIS)
    assert rays.result.status == "right"
    ray = camera.ray(1, 4, SIZE)
    assert np.allclose(rays.origins[1, 4], ray.origin)
    assert np.allclose(rays.directions[1, 4], ray.direction)

    def mirrored(known):
        u, v, w = right_basis(known)
        return [[-part for part in u], v, w]

    wrong = answered(camera, mirrored, BASIS)
    assert wrong.result.status == "wrong"
    assert wrong.wrong.all()
    other = camera.ray(1, SIZE[0] - 1 - 4, SIZE)  # the viewport is symmetric
    assert np.allclose(wrong.origins[1, 4], other.origin)
    assert np.allclose(wrong.directions[1, 4], other.direction)


def test_the_task_follows_the_projection():
    perspective, parallel = task(RAY), task(RAY, "parallel")
    assert perspective != parallel
    assert for_camera(perspective, PARALLEL) == parallel
    assert for_camera(parallel, CAMERA) == perspective
    assert for_camera(task(BASIS), PARALLEL) == task(BASIS)
    assert [is_of_camera(one) for one in (perspective, task(BASIS), task("hit-sphere"))] == [
        True,
        True,
        False,
    ]


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
