"""The passage between two cameras: legal everywhere, exact at the ends, without a jump."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from app.cameras.animation import INVISIBLE_PX, Passage
from app.cameras.focus import Focus, scene_focus
from app.cameras.navigation import switched_projection
from app.cameras.presets import PRESETS, preset_view
from app.cameras.travel import DURATION_S, CameraTransition, Ends
from app.state.app_state import AppState, History, is_orthonormal
from renderer.camera import Camera, volume
from renderer.scene import load_scene
from renderer.scene.model import Scene, View

PRESET = {preset.name: preset for preset in PRESETS}

SIZE = (960, 540)
FOCUS = (0.0, 0.5, -0.5)
BOUNDS = np.array([[x, y, z] for x in (-2, 2) for y in (-1, 2) for z in (-3, 2)], float)
INSIDE = np.stack(
    np.meshgrid(np.linspace(-2, 2, 9), np.linspace(-1, 2, 7), np.linspace(-3, 2, 11)), axis=-1
).reshape(-1, 3)
parts = st.floats(0, 1)
numbers = st.floats(-3, 3)
vectors = st.tuples(numbers, numbers, numbers)


@st.composite
def cameras(draw: st.DrawFn, projection: str | None = None) -> Camera:
    """Any legal camera: skewed, scaled, left-handed, off-axis, with clip planes or without."""
    basis = np.array([draw(vectors) for _ in range(3)])
    lengths = np.linalg.norm(basis, axis=1)
    assume((lengths > 0.1).all())
    assume(abs(volume(*(basis / lengths[:, None]))) > 0.02)
    left, bottom = draw(numbers), draw(numbers)
    near = draw(st.none() | st.floats(0.05, 3))  # over 1e-6 of any depth
    far = draw(st.none() | st.floats(3.5, 50))
    return Camera(
        draw(vectors),
        *(tuple(row) for row in basis.tolist()),
        draw(st.floats(0.1, 5)),
        (left, left + draw(st.floats(0.05, 4)), bottom, bottom + draw(st.floats(0.05, 4))),
        projection or draw(st.sampled_from(("perspective", "parallel"))),
        near,
        far,
    )


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
    """Of the way, s = 3 part^2 = 3e-14 is gone; of what passes by factors up to F, 1 + ln F times
    that. F is at most 1e13: half sizes of 0.025 to 2 at 1e-6 to 1e5 distances. Between the focus
    and the eye there are less than 36, along u, v and w thus 50 * 36 lengths of each at either end,
    and these lengths differ by up to 52: the eye moves by less than 2 * 3 * 50 * 36 * 52 * 31 * s =
    5e-7."""
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
    """The eye draws back as the distance grows; what is as far off as the focus keeps its size."""
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
        assert drawn.distance >= camera.distance - 1e-9


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


@pytest.mark.parametrize(
    ("fit", "near", "right", "across", "down", "height"),
    [
        (False, None, 1.5, 2, 1 + 2 / 3, 4.5),
        (False, 3.5, 1.5, 2, 1 + 2 / 3, 2.5),
        (True, None, 1.5, 1 + 9 / 16, 1 + 2 / 3, 4.5),  # half the width is 16 / 9 * 0.75
        (True, None, 3.0, 2, 1 + 16 / 27, 4.5),  # the height is 27 / 16
    ],
)
def test_the_farthest_corner_says_when_rays_may_be_parallel(
    fit, near, right, across, down, height
) -> None:
    """From the foot of the eye to it r pixels; so many times as far as the scene, or the first eye,
    is from the focus's plane: then the corner moves by a fifth of a pixel."""
    one = Camera((0.0, 0.5, 4.0), viewport=(0.0, right, -0.25, 1.25), near=near)
    two = switched_projection(one, FOCUS)
    passage = Passage(View(one, fit), View(two, fit), FOCUS, BOUNDS, SIZE)
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if passage.at(middle).camera.is_parallel else (middle, high)
    farthest = passage.at(low).camera.eye[2] + 0.5
    assert farthest == pytest.approx(math.hypot(across * 480, down * 270) * height / 0.2, rel=1e-3)


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


def test_between_a_view_that_is_fitted_and_one_that_is_not_nothing_is_fitted() -> None:
    one, two = Camera(eye=(0, 0, 5)), Camera(eye=(0, 0, 4))
    for fits in ((True, True), (True, False), (False, True), (False, False)):
        ends = (View(camera, fit) for camera, fit in zip((one, two), fits, strict=True))
        assert Passage(*ends, (0, 0, 0), BOUNDS, SIZE).at(0.5).fit is all(fits)


def test_the_passage_sets_out_and_arrives_slowly() -> None:
    """3 s^2 - 2 s^3 of the way, on a straight one; nothing of it outside 0 to 1."""
    start = View(Camera(eye=(0, 0, -5)))
    end = View(Camera(eye=(0, 0, 5), u=(-1, 0, 0), w=(0, 0, -1)))
    passage = Passage(start, end, (0, 0, 0), BOUNDS, SIZE)
    for part, way in ((0.1, 0.028), (0.25, 0.15625), (0.5, 0.5), (0.75, 0.84375), (0.9, 0.972)):
        assert passage.at(part).camera.eye == pytest.approx((0, 0, -5 + 10 * way))
    assert passage.at(-0.5) is start
    assert passage.at(1.5) is end


class Clock:
    """A clock that goes on when it is told to."""

    def __init__(self) -> None:
        self.s = 100.0

    def __call__(self) -> float:
        return self.s


@pytest.fixture(scope="module")
def scene() -> Scene:
    return load_scene("spheres")


def target_of(state: AppState, name: str) -> AppState:
    focus = scene_focus(state.scene)
    view = preset_view(PRESET[name], state.view, focus.framed, focus.bounds, 1.0)
    return replace(state.with_view(view), keep_orthonormal=is_orthonormal(view.camera))


class TestTraveller:
    def begin(self, scene: Scene, name: str = "Front") -> tuple[Clock, CameraTransition, AppState]:
        clock, state = Clock(), AppState.for_scene(scene)
        traveller = CameraTransition(clock)
        target = target_of(state, name)
        shown = traveller.begin(state, target, scene_focus(scene), SIZE)
        assert shown is state
        return clock, traveller, target

    def test_it_arrives_after_its_time_whatever_the_frame_rate(self, scene: Scene) -> None:
        for frames in (1, 7, 300):
            clock, traveller, target = self.begin(scene, "Cabinet")
            state = AppState.for_scene(scene)
            middle = None
            for number in range(frames + 1):
                clock.s = 100.0 + DURATION_S * number / frames
                state = traveller.step(state)
                if number == frames // 2:
                    middle = state
            assert state == target
            assert not state.keep_orthonormal
            assert not traveller.under_way
            assert frames == 1 or middle not in (target, AppState.for_scene(scene))

    def test_the_same_moment_has_the_same_camera(self, scene: Scene) -> None:
        seen = []
        for steps in (1, 5):
            clock, traveller, _ = self.begin(scene)
            state = AppState.for_scene(scene)
            for number in range(steps):
                clock.s = 100.0 + 0.6 * DURATION_S * (number + 1) / steps
                state = traveller.step(state)
            seen.append(state.camera)
        assert seen[0] == seen[1]

    def test_another_change_of_the_view_ends_it_there(self, scene: Scene) -> None:
        clock, traveller, _ = self.begin(scene)
        clock.s += 0.1
        state = traveller.step(AppState.for_scene(scene))
        moved = state.with_camera(replace(state.camera, eye=(1, 2, 3)))
        clock.s += 0.1
        assert traveller.step(moved) is moved
        assert not traveller.under_way

    def test_on_the_way_a_switch_that_is_off_stays_off(self, scene: Scene) -> None:
        clock, traveller, target = self.begin(scene)
        state = AppState.for_scene(scene).with_keep_orthonormal(False)
        clock.s += 0.4 * DURATION_S
        between = traveller.step(state)
        assert is_orthonormal(between.camera) and not between.keep_orthonormal
        clock.s += DURATION_S
        assert traveller.step(between).keep_orthonormal == target.keep_orthonormal

    def test_setting_out_again_ends_the_passage_before(self, scene: Scene) -> None:
        clock, traveller, _ = self.begin(scene)
        assert traveller.under_way is True
        first = traveller.gesture
        clock.s += 0.1
        state = traveller.step(AppState.for_scene(scene))
        other = target_of(state, "Left")
        assert traveller.begin(state, other, scene_focus(scene), SIZE) is state
        assert traveller.gesture != first
        traveller.instant = True
        there = target_of(state, "Right")
        assert traveller.begin(state, there, scene_focus(scene), SIZE) is there
        assert traveller.under_way is False

    def test_another_option_does_not(self, scene: Scene) -> None:
        clock, traveller, target = self.begin(scene)
        clock.s += 0.1
        state = traveller.step(AppState.for_scene(scene)).with_options(shadows=True)
        clock.s += DURATION_S
        state = traveller.step(state)
        assert state == target.with_options(shadows=True)

    def test_all_of_it_is_one_step_of_undo(self, scene: Scene) -> None:
        clock, traveller, target = self.begin(scene)
        history = History(AppState.for_scene(scene))
        for _ in range(10):
            clock.s += DURATION_S / 9
            state = traveller.step(history.present)
            history = history.change(state, traveller.gesture)
        assert history.present == target
        assert len(history.past) == 1

    def test_the_outside_views_camera_passes_too_and_only_that(self, scene: Scene) -> None:
        clock, state = Clock(), AppState.for_scene(scene)
        start = Camera.look_at((9.0, 3.0, 9.0), (0.0, 0.0, 0.0))
        end = Camera.look_at((0.0, 12.0, 1.0), (0.0, 0.0, 0.0))
        for there in (end, None):  # None: the view finds it
            traveller = CameraTransition(clock)
            target = state.with_options(outside={"camera": there}, shadows=True)
            ends = Ends(
                start,
                end,
                SIZE,
                of=lambda state: state.options.outside.camera,
                put=lambda state, camera: state.with_options(outside={"camera": camera}),
            )
            assert traveller.begin(state, target, scene_focus(scene), SIZE, ends) is state
            history = History(state)
            for part in (0.0, 0.5, 1.0):
                clock.s += 0.5 * DURATION_S * (part > 0)
                found = traveller.step(history.present)
                history = history.change(found, traveller.gesture)
                if part == 0.5:
                    middle = found.options.outside.camera
            assert middle not in (None, start, end)
            assert history.present == state.with_options(outside={"camera": there})
            assert [step.options.outside.camera for step in history.past] == [None]
            assert not traveller.under_way
            # Another camera for it ends the passage; another view does not.
            traveller.begin(state, target, scene_focus(scene), SIZE, ends)
            clock.s += 0.1
            found = traveller.step(target_of(state, "Front"))
            assert found.view == target_of(state, "Front").view
            moved = found.with_options(outside={"camera": end})
            assert traveller.step(moved) is moved
            assert not traveller.under_way

    @pytest.mark.parametrize("how", ["instant", "reduced", "mirrored", "scene", "no window"])
    def test_where_nothing_is_to_be_seen_it_is_there_at_once(self, scene: Scene, how: str) -> None:
        state, traveller, size = AppState.for_scene(scene), CameraTransition(Clock()), SIZE
        target = target_of(state, "Left")
        if how == "instant":
            traveller.instant = True
        elif how == "reduced":
            state = state.with_options(preferences={"reduced_motion": True})
        elif how == "mirrored":
            target = target.with_camera(replace(target.camera, u=(0.0, 0.0, -1.0)))
        elif how == "scene":
            target = target.with_scene(load_scene("canonical"))
        else:
            size = (0, 0)
        assert traveller.begin(state, target, Focus(), size) is target
        assert not traveller.under_way


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
