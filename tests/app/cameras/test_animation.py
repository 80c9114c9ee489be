"""The passage between two cameras: legal everywhere, exact at the ends, without a jump."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from any_camera import cameras, vectors
from hypothesis import given, settings
from hypothesis import strategies as st

from lucida.app.cameras.animation import Passage
from lucida.app.cameras.presets import PRESETS, preset_view
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.navigation import switched_projection
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

PRESET = {preset.name: preset for preset in PRESETS}

SIZE = (960, 540)
FOCUS = (0.0, 0.5, -0.5)
INSIDE = np.stack(
    np.meshgrid(np.linspace(-2, 2, 9), np.linspace(-1, 2, 7), np.linspace(-3, 2, 11)), axis=-1
).reshape(-1, 3)
parts = st.floats(0, 1)


@st.composite
def lookers(draw: st.DrawFn) -> Camera:
    """Orthonormal cameras that see the focus in front of them."""
    eye = np.add(draw(vectors), (0, 0, 6))
    camera = Camera.look_at(eye, FOCUS, fov_y_deg=draw(st.floats(5, 100)))
    return replace(camera, near=draw(st.none() | st.floats(0.01, 1)))


@given(cameras(), cameras(), parts, st.booleans(), st.booleans())
@settings(max_examples=80)
def test_every_camera_on_the_way_is_legal_and_the_ends_are_exact(
    one: Camera, two: Camera, part: float, fit_one: bool, fit_two: bool
) -> None:
    start, end = View(one, fit_one), View(two, fit_two)
    passage = Passage(start, end, FOCUS, SIZE)
    assert passage.at(0.0) == start and passage.at(1.0) == end
    between = passage.at(part).camera
    assert replace(between) == between  # checks itself again
    if passage.possible:
        assert math.copysign(1, between.determinant) == math.copysign(1, one.determinant)
    else:
        assert one.determinant * two.determinant < 0
        assert passage.at(0.01) == end


def seen(camera: Camera, point: np.ndarray) -> np.ndarray:
    projected = camera.project(point, SIZE)
    return np.stack([projected.row, projected.column], axis=-1)


@given(lookers(), parts, st.booleans(), st.booleans())
def test_between_the_projections_the_plane_of_the_focus_stands_still(
    camera: Camera, part: float, back: bool, fit: bool
) -> None:
    """The eye draws back; what is as far off as the focus keeps its size."""
    other = switched_projection(camera, FOCUS)
    ends = (other, camera) if back else (camera, other)
    between = Passage(View(ends[0], fit), View(ends[1], fit), FOCUS, SIZE).at(part)
    across = np.array([np.zeros(3), camera.u, -0.5 * np.asarray(camera.v)])
    plane = across + FOCUS
    was = seen(View(camera, fit).for_size(SIZE), plane)
    np.testing.assert_allclose(seen(between.for_size(SIZE), plane), was, atol=1e-3)
    if not between.camera.is_parallel:
        height, first, last = (np.ptp(one.viewport[2:]) for one in (between.camera, *ends))
        assert min(first, last) - 1e-9 <= height <= max(first, last) + 1e-9
        away = [np.linalg.norm(np.subtract(c.eye, FOCUS)) for c in (between.camera, camera)]
        assert away[0] >= away[1] - 1e-9


@given(lookers(), st.booleans())
@settings(max_examples=30)
def test_the_step_to_parallel_rays_is_invisible(camera: Camera, fit: bool) -> None:
    ends = View(camera, fit), View(switched_projection(camera, FOCUS), fit)
    passage = Passage(*ends, FOCUS, SIZE)
    low, high = 0.0, 1.0
    for _ in range(60):  # the moment at which the rays become parallel
        middle = (low + high) / 2
        low, high = (low, middle) if passage.at(middle).camera.is_parallel else (middle, high)
    before, after = (passage.at(part).for_size(SIZE) for part in (low, high))
    assert not before.is_parallel and after.is_parallel
    a, b = seen(before, INSIDE), seen(after, INSIDE)
    inside = ((b > -1) & (b < np.array([SIZE[1], SIZE[0]]))).all(axis=1)
    assert inside.any()
    assert np.abs(a - b)[inside].max(initial=0.0) < 0.5


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_no_point_of_the_scene_jumps(preset) -> None:
    """In 500 steps, nothing moves far in any of them, and all stays in front of the eye."""
    scene = load_scene("still-life")
    focus = scene_focus(scene)
    start = View(scene.view.camera, True)
    end = preset_view(preset, start, focus.framed, focus.bounds, 16 / 9)
    passage = Passage(start, end, focus.center, SIZE)
    places = np.array(
        [
            seen(passage.at(float(part)).for_size(SIZE), focus.framed)
            for part in np.linspace(0, 1, 501)
        ]
    )
    assert np.isfinite(places).all()
    assert np.abs(np.diff(places, axis=0)).max() < 24


def test_what_lies_behind_the_first_eye_is_not_seen_while_the_eye_draws_back() -> None:
    camera = Camera(eye=(0.0, 0.0, 1.0))
    end = switched_projection(camera, (0, 0, -1))
    passage = Passage(View(camera), View(end), (0, 0, -1), SIZE)
    for part in (0.1, 0.4, 0.7):
        between = passage.at(part).camera
        assert between.near is not None
        assert between.eye[2] - between.near == pytest.approx(1.0)


@pytest.mark.parametrize("behind", [0.5, 5.0])
def test_between_the_projections_a_focus_behind_the_eye_is_one_on_the_image_plane(behind) -> None:
    camera = Camera.look_at((0.0, 3.0, 4.0), (0, 0, 0))
    ends = View(camera), View(Camera(projection="parallel"))
    eye, w = np.asarray(camera.eye), np.asarray(camera.w)
    wanted = Passage(*ends, eye - camera.distance * w, SIZE).at(0.5)
    assert Passage(*ends, eye + behind * w, SIZE).at(0.5) == wanted
    assert wanted.camera not in (ends[0].camera, ends[1].camera)


def test_where_no_legal_camera_lies_between_the_nearer_end_is_shown(monkeypatch) -> None:
    def illegal(*_):
        raise LucidaError("camera", "is not legal")

    monkeypatch.setattr(Passage, "_between", illegal)
    start, end = View(Camera()), View(Camera(eye=(0, 0, 1)))
    passage = Passage(start, end, FOCUS, SIZE)
    assert [passage.at(part) for part in (0.4, 0.6)] == [start, end]


@pytest.mark.parametrize("eye", [(3.0, 0.5, -0.49999), (0.0, 0.5, -4.0), (-40.0, 3.0, 60.0)])
def test_with_the_same_basis_the_eye_and_all_planes_go_evenly(eye: tuple) -> None:
    """Wherever the focus is, also behind an eye: slowly at first and in the end."""
    two = Camera((0.0, 0.5, 3.0), viewport=(-0.01, 0.02, -0.01, 0.01), near=0.5, far=90.0)
    one = replace(two, eye=eye, near=0.25, far=30.0)
    passage = Passage(View(one), View(two), FOCUS, SIZE)
    for part, s in ((0.1, 0.028), (0.5, 0.5), (0.9, 0.972)):
        camera = passage.at(part).camera
        assert camera.viewport == pytest.approx(two.viewport)
        assert camera.eye == pytest.approx(np.array(one.eye) * (1 - s) + np.array(two.eye) * s)
        assert (camera.near, camera.far) == pytest.approx((0.25 + 0.25 * s, 30 + 60 * s))
    assert passage.at(0.5, eased=False) == passage.at(0.5)
    assert passage.at(0.25, eased=False).camera.near == pytest.approx(0.25 + 0.25 * 0.25)


def test_to_parallel_rays_the_angle_of_view_narrows_evenly() -> None:
    one = Camera((0, 0, 2))
    for factor in (0.01, 1.0, 100.0):
        viewport = (-factor, factor, -factor, factor)
        two = replace(one, viewport=viewport, projection="parallel")
        passage = Passage(View(one), View(two), (0, 0, 0), SIZE)
        for part, s in ((0.1, 0.028), (0.5, 0.5), (0.9, 0.972)):
            _, right, _, top = passage.at(part).camera.viewport
            assert right / passage.at(part).camera.distance == pytest.approx(0.5 * (1 - s))
            assert right == top


def test_half_a_turn_goes_about_the_upright_axis() -> None:
    end = Camera((0, 0, -5), (-1, 0, 0), (0, 1, 0), (0, 0, -1))
    passage = Passage(View(Camera(eye=(0, 0, 5))), View(end), (0, 0, 0), SIZE)
    for part in (0.2, 0.5, 0.9):
        assert passage.at(part).camera.v == pytest.approx((0, 1, 0))
    assert passage.at(0.5).camera.w == pytest.approx((1, 0, 0))


@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_half_way_is_half_of_the_turn_and_the_mean_of_the_stretch(scale: float) -> None:
    """About one axis, evenly; lengths pass evenly, too."""
    axis = np.array([1.0, 2.0, -2.0]) / 3
    cross = np.cross(np.eye(3), -axis)

    def turn(angle: float) -> np.ndarray:
        return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross

    for angle in (0.0, 1e-9, 5e-8, 0.4, 1.8, 3.1):
        u, v, w = (scale * turn(angle)).T
        end = Camera(tuple(5 * w / scale), tuple(u), tuple(v), tuple(w))
        passage = Passage(View(Camera(eye=(0, 0, 5))), View(end), (0, 0, 0), SIZE)
        for part, way in ((0.25, 0.15625), (0.5, 0.5)):
            basis = passage.at(part).camera.basis
            length = 1 + way * (scale - 1)
            np.testing.assert_allclose(basis, length * turn(way * angle), atol=1e-9)


def test_between_a_view_that_is_fitted_and_one_that_is_not_nothing_is_fitted() -> None:
    one, two = Camera(eye=(0, 0, 5)), Camera(eye=(0, 0, 4))
    for fits in ((True, True), (True, False), (False, True), (False, False)):
        ends = (View(camera, fit) for camera, fit in zip((one, two), fits, strict=True))
        assert Passage(*ends, (0, 0, 0), SIZE).at(0.5).fit is all(fits)
