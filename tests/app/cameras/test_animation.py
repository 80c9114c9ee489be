"""The passage between two cameras: legal everywhere, exact at the ends, without a jump."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from copied_views import cameras, vectors
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from lucida.app.cameras.animation import INVISIBLE_PX, Passage
from lucida.app.cameras.presets import PRESETS, preset_view
from lucida.app.state.app_state import is_orthonormal
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.navigation import depth_of, switched_projection
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import View

PRESET = {preset.name: preset for preset in PRESETS}

SIZE = (960, 540)
FOCUS = (0.0, 0.5, -0.5)
BOUNDS = np.array([[x, y, z] for x in (-2, 2) for y in (-1, 2) for z in (-3, 2)], float)
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
@settings(max_examples=300)
def test_every_camera_on_the_way_is_legal_and_the_ends_are_exact(
    one: Camera, two: Camera, part: float, fit_one: bool, fit_two: bool
) -> None:
    start, end = View(one, fit_one), View(two, fit_two)
    passage = Passage(start, end, FOCUS, BOUNDS, SIZE)
    assert passage.at(0.0) == start
    assert passage.at(1.0) == end
    between = passage.at(part).camera
    assert replace(between) == between  # checks itself again
    if passage.possible:
        assert math.copysign(1, between.determinant) == math.copysign(1, one.determinant)
    else:
        assert one.determinant * two.determinant < 0
        assert passage.at(0.01) == end


@given(cameras(), cameras(), st.booleans())
def test_it_leaves_and_arrives_without_a_jump(one: Camera, two: Camera, fit: bool) -> None:
    """The bound: s = 3 part^2 = 3e-14 of the way is gone, and 1 + ln F times that of what passes by
    factors up to F. F is at most 1e13: half sizes of 0.025 to 2 at 1e-6 to 1e5 distances.

    Between the focus and the eye there are less than 36, along u, v and w thus 50 * 36 lengths of
    each at either end, and these lengths differ by up to 52: the eye moves by less than
    2 * 3 * 50 * 36 * 52 * 31 * s = 5e-7.
    """
    passage = Passage(View(one, fit), View(two, fit), FOCUS, BOUNDS, SIZE)
    assume(passage.possible)
    for part, end, other in ((1e-7, one, two), (1 - 1e-7, two, one)):
        camera = passage.at(part).camera
        np.testing.assert_allclose(camera.basis, end.basis, atol=1e-9)
        if camera.projection != end.projection:
            continue  # parallel rays, as they look from far off
        assert camera.eye == pytest.approx(end.eye, rel=0, abs=1e-6)
        assert camera.viewport == pytest.approx(end.viewport, rel=1e-5, abs=1e-5)
        assert camera.distance == pytest.approx(end.distance, rel=1e-5)
        if end.near is not None and other.near is not None:
            assert camera.near == pytest.approx(end.near, abs=1e-5)
        if end.far is not None and other.far is not None:
            assert camera.far == pytest.approx(end.far, abs=1e-5)
        else:
            assert camera.far is None


@given(lookers(), lookers(), parts)
def test_between_orthonormal_cameras_the_basis_stays_orthonormal(
    one: Camera, two: Camera, part: float
) -> None:
    camera = Passage(View(one), View(two), FOCUS, BOUNDS, SIZE).at(part).camera
    assert is_orthonormal(camera)
    assert camera.determinant > 0


def seen(camera: Camera, point: np.ndarray) -> np.ndarray:
    projected = camera.project(point, SIZE)
    return np.stack([projected.row, projected.column], axis=-1)


@given(lookers(), parts, st.booleans(), st.booleans())
def test_between_the_projections_the_plane_of_the_focus_stands_still(
    camera: Camera, part: float, back: bool, fit: bool
) -> None:
    """The eye draws back, and so does an image plane before the focus; one behind it comes no
    nearer than the focus. What is as far off as the focus keeps its size.
    """
    other = switched_projection(camera, FOCUS)
    ends = (other, camera) if back else (camera, other)
    passage = Passage(View(ends[0], fit), View(ends[1], fit), FOCUS, BOUNDS, SIZE)
    plane = np.asarray(FOCUS) + np.array(
        [np.zeros(3), np.asarray(camera.u), -0.5 * np.asarray(camera.v)]
    )
    between = passage.at(part)
    assert np.allclose(
        seen(between.for_size(SIZE), plane),
        seen(View(camera, fit).for_size(SIZE), plane),
        atol=1e-4,
    )
    drawn = between.camera
    if not drawn.is_parallel:
        drawn_back = np.linalg.norm(np.subtract(drawn.eye, FOCUS))
        assert drawn_back >= np.linalg.norm(np.subtract(camera.eye, FOCUS)) - 1e-9
        assert drawn.distance >= min(camera.distance, depth_of(camera, FOCUS)) - 1e-9


@given(lookers(), st.booleans())
@settings(max_examples=30)
def test_the_step_to_parallel_rays_is_invisible(camera: Camera, fit: bool) -> None:
    start = View(camera, fit)
    end = View(switched_projection(camera, FOCUS), fit)
    passage = Passage(start, end, FOCUS, BOUNDS, SIZE)
    low, high = 0.0, 1.0
    for _ in range(60):  # the moment at which the rays become parallel
        middle = (low + high) / 2
        if passage.at(middle).camera.is_parallel:
            high = middle
        else:
            low = middle
    before, after = (passage.at(part).for_size(SIZE) for part in (low, high))
    assert not before.is_parallel
    assert after.is_parallel
    a, b = seen(before, INSIDE), seen(after, INSIDE)
    inside = ((b > -1) & (b < np.array([SIZE[1], SIZE[0]]))).all(axis=1)
    assert inside.any()
    assert np.abs(a - b)[inside].max(initial=0.0) < 0.25
    assert INVISIBLE_PX < 0.25


@pytest.mark.parametrize("fit", [True, False])
@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_no_point_of_the_scene_jumps(preset, fit: bool) -> None:
    """In 1000 steps, nothing that is in front of the eye moves far in any of them."""
    scene = load_scene("still-life")
    focus = scene_focus(scene)
    start = View(scene.view.camera, fit)
    end = preset_view(preset, start, focus.framed, focus.bounds, 16 / 9)
    passage = Passage(start, end, focus.center, focus.bounds, SIZE)
    points = focus.framed
    last = None
    for part in np.linspace(0, 1, 1001):
        now = seen(passage.at(float(part)).for_size(SIZE), points)
        assert np.isfinite(now).all()  # all in front of the eye, all the way
        if last is not None:
            assert np.abs(now - last).max() < 12
        last = now


def test_what_lies_behind_the_first_eye_is_not_seen_while_the_eye_draws_back() -> None:
    camera = Camera(eye=(0.0, 0.0, 1.0))  # the scene reaches to z = 2
    end = switched_projection(camera, (0, 0, -1))
    passage = Passage(View(camera), View(end), (0, 0, -1), BOUNDS, SIZE)
    for part in (0.1, 0.4, 0.7):
        between = passage.at(part).camera
        assert between.near is not None
        assert between.eye[2] - between.near == pytest.approx(1.0)
    nothing_behind = replace(camera, eye=(0.0, 0.0, 5.0))
    end = switched_projection(nothing_behind, (0, 0, -1))
    passage = Passage(View(nothing_behind), View(end), (0, 0, -1), BOUNDS, SIZE)
    assert passage.at(0.5).camera.near is None


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_plane_before_which_nothing_is_seen_comes_and_goes(projection: str) -> None:
    """Evenly where it cuts something off; where it does not, no perspective needs it on its way."""
    one = Camera(eye=(0, 0, 5), projection=projection)
    two = replace(one, near=2.0)
    middle = [
        Passage(View(one), View(two), (0, 0, 0), b, SIZE).at(0.5) for b in (BOUNDS, 2 * BOUNDS)
    ]
    parallel = projection == "parallel"
    expected = pytest.approx([1.0 if parallel else None, 1.0])
    assert [view.camera.near for view in middle] == expected
    for ends in ((one, two), (two, two), (one, one)):
        empty = Passage(*map(View, ends), (0, 0, 0), np.zeros((0, 3)), SIZE).at(0.5).camera.near
        needed = 2.0 if ends[0] is two else 1.0 if parallel and two in ends else None
        assert empty == pytest.approx(needed)


def test_of_a_near_plane_a_millionth_of_the_depth_is_none() -> None:
    for near, between in ((9.0, None), (11.0, 11.0)):
        one = Camera(eye=(0, 0, 1e7), near=near)
        two = replace(one, viewport=(-1, 1, -1, 1))
        found = Passage(View(one), View(two), (0, 0, 0), BOUNDS, SIZE).at(0.5).camera.near
        assert found == pytest.approx(between)


def test_beyond_what_a_camera_can_be_the_nearer_end_is_seen() -> None:
    start = View(Camera(eye=(0, 0, 8e11)))
    end = View(switched_projection(start.camera, (0, 0, 0)))
    passage = Passage(start, end, (0, 0, 0), BOUNDS, SIZE)
    assert passage.at(0.1).camera.eye[2] == pytest.approx(8e11 / 0.972)
    assert passage.at(0.45) is start
    assert passage.at(0.55) is end


def test_between_a_view_that_is_fitted_and_one_that_is_not_nothing_is_fitted() -> None:
    one, two = Camera(eye=(0, 0, 5)), Camera(eye=(0, 0, 4))
    for fits in ((True, True), (True, False), (False, True), (False, False)):
        ends = (View(camera, fit) for camera, fit in zip((one, two), fits, strict=True))
        assert Passage(*ends, (0, 0, 0), BOUNDS, SIZE).at(0.5).fit is all(fits)
