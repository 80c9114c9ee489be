"""The path and the speed of the eye and the basis between two cameras."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from test_animation import BOUNDS, FOCUS, PRESET, SIZE

from lucida.app.cameras.animation import Passage
from lucida.app.cameras.presets import preset_view
from lucida.app.state.app_state import is_orthonormal
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import View


def test_half_a_turn_goes_about_the_upright_axis() -> None:
    scene = load_scene("spheres")
    focus = scene_focus(scene)
    front, back = (
        preset_view(PRESET[name], scene.view, focus.framed, focus.bounds, 1.0)
        for name in ("Front", "Back")
    )
    for part in (0.2, 0.5, 0.9):
        camera = Passage(front, back, focus.center, focus.bounds, SIZE).at(part).camera
        assert camera.v == pytest.approx((0, 1, 0))


@pytest.mark.parametrize("eye", [(3.0, 0.5, -0.49999), (0.0, 0.5, -0.25), (-40.0, 3.0, 60.0)])
@pytest.mark.parametrize("half", [0.5, 0.1])
def test_with_the_same_angle_of_view_the_eye_goes_straight(eye: tuple, half: float) -> None:
    """Wherever the focus is: far beside the picture, close to the eye. What is seen of its plane
    becomes smaller by even factors."""
    distance = 0.01 / half
    viewport = (-0.01, 0.02, -0.01, 0.01)
    two = Camera((0.0, 0.5, 3.0), distance=distance, viewport=viewport, near=0.5, far=90.0)
    one = replace(two, eye=eye, near=0.25, far=30.0)
    passage = Passage(View(one), View(two), FOCUS, BOUNDS, SIZE)
    for part, s in ((0.1, 0.028), (0.5, 0.5), (0.9, 0.972)):
        camera = passage.at(part).camera
        assert camera.viewport == pytest.approx(viewport)
        assert camera.distance == pytest.approx(distance)
        depth = (one.eye[2] + 0.5) ** (1 - s) * 3.5**s
        way = (depth - one.eye[2] - 0.5) / (3.0 - one.eye[2])
        assert camera.eye == pytest.approx(np.array(one.eye) * (1 - way) + np.array(two.eye) * way)
        assert (camera.near, camera.far) == pytest.approx((0.25 + 0.25 * way, 30 + 60 * way))


@pytest.mark.parametrize("factor", [0.01, 1.0, 100.0])
def test_to_parallel_rays_the_angle_of_view_narrows_evenly(factor: float) -> None:
    """However much more, or less, is seen in the end."""
    one = Camera((0, 0, 2))
    two = replace(one, viewport=(-factor, factor, -factor, factor), projection="parallel")
    passage = Passage(View(one), View(two), (0, 0, 0), BOUNDS, SIZE)
    for part, s in ((0.1, 0.028), (0.5, 0.5), (0.9, 0.972)):
        _, right, _, top = passage.at(part).camera.viewport
        assert right / passage.at(part).camera.distance == pytest.approx(0.5 * (1 - s))
        assert right == top


def test_where_the_focus_is_behind_an_eye_another_point_in_front_of_both_takes_its_place() -> None:
    """The middle of one's image plane."""
    one = Camera(eye=(0, 0, 0))
    two = replace(one, eye=(0, 0, 4))
    for ends in ((one, two), (two, one)):
        camera = Passage(*map(View, ends), (0, 0, 2), BOUNDS, SIZE).at(0.5).camera
        assert camera.eye == pytest.approx((0, 0, math.sqrt(5) - 1))  # 1 and 5 from z = -1


def test_parallel_rays_pass_to_a_part_of_the_picture_without_leaving_it() -> None:
    """From the whole to a small part at its border: what is seen lies within what was."""
    whole = Camera((0, 0, 9), viewport=(-10, 10, -8, 8), projection="parallel")
    part_of_it = replace(whole, eye=(8, -5, 9), viewport=(-0.1, 0.1, -0.08, 0.08))
    passage = Passage(View(whole), View(part_of_it), (0, 0, 0), BOUNDS, SIZE)
    last = whole
    for part in np.linspace(0, 1, 21)[1:]:
        camera = passage.at(float(part)).camera
        for k in (0, 1):
            (low, high), (least, most) = (
                np.array(c.viewport[2 * k : 2 * k + 2]) + c.eye[k] for c in (camera, last)
            )
            assert least - 1e-12 <= low < high <= most + 1e-12
        last = camera


def test_without_a_common_focus_the_eye_goes_straight() -> None:
    """Each looks away from the other: no point is in front of both."""
    one = Camera(eye=(0, 0, -5), near=1.0)
    two = Camera(eye=(0, 0, 5), u=(-1, 0, 0), w=(0, 0, -1), near=3.0)
    passage = Passage(View(one), View(two), (0, 0, 0), BOUNDS, SIZE)
    middle = passage.at(0.5).camera
    assert middle.eye == pytest.approx((0, 0, 0))
    assert middle.near == 2.0
    assert is_orthonormal(middle)


def test_the_passage_sets_out_and_arrives_slowly() -> None:
    """3 s^2 - 2 s^3 of the way, on a straight one; nothing of it outside 0 to 1."""
    start = View(Camera(eye=(0, 0, -5)))
    end = View(Camera(eye=(0, 0, 5), u=(-1, 0, 0), w=(0, 0, -1)))
    passage = Passage(start, end, (0, 0, 0), BOUNDS, SIZE)
    for part, way in ((0.1, 0.028), (0.25, 0.15625), (0.5, 0.5), (0.75, 0.84375), (0.9, 0.972)):
        assert passage.at(part).camera.eye == pytest.approx((0, 0, -5 + 10 * way))
    assert passage.at(-0.5) is start
    assert passage.at(1.5) is end


@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_half_way_is_half_of_the_turn_and_the_mean_of_the_stretch(scale: float) -> None:
    """About one axis, evenly; lengths pass in their logarithm."""
    axis = np.array([1.0, 2.0, -2.0]) / 3
    cross = np.cross(np.eye(3), -axis)

    def turn(angle: float) -> np.ndarray:
        return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross

    for angle in (0.0, 1e-9, 5e-8, 0.4, 1.8, 3.1):
        u, v, w = (scale * turn(angle)).T
        end = Camera(tuple(5 * w / scale), tuple(u), tuple(v), tuple(w))
        passage = Passage(View(Camera(eye=(0, 0, 5))), View(end), (0, 0, 0), BOUNDS, SIZE)
        for part, way in ((0.25, 0.15625), (0.5, 0.5)):
            basis = passage.at(part).camera.basis
            np.testing.assert_allclose(basis, scale**way * turn(way * angle), atol=1e-9)


@pytest.mark.parametrize(
    "direction", [(0, 1, 0), (0, 0, 1), (1, 0, 0), (2, -1, 1), (-1, 2, 0.5), (1, 0.5, -3)]
)
def test_half_a_turn_about_any_axis_ends_where_it_should(direction: tuple) -> None:
    """About its own axis, by a quarter at half the time: counterclockwise about its upper half."""
    axis = np.array(direction) / np.linalg.norm(direction)
    turned = 2 * np.outer(axis, axis) - np.eye(3)
    u, v, w = (turned @ np.array(vector) for vector in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    end = Camera(tuple(5 * w), tuple(u), tuple(v), tuple(w))
    passage = Passage(View(Camera(eye=(0, 0, 5))), View(end), (0, 0, 0), BOUNDS, SIZE)
    basis = passage.at(0.5).camera.basis
    up = -axis if axis[1] < 0 else axis
    quarter = np.outer(up, up) + np.cross(np.eye(3), up)
    np.testing.assert_allclose(basis, quarter, atol=1e-9)
    np.testing.assert_allclose(passage.at(1 - 1e-5).camera.basis, turned, atol=1e-6)
