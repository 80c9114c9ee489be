"""Orbit, pan, zoom and the switch of projection, for any basis."""

import math
from dataclasses import replace

import numpy as np
import pytest
from any_camera import cameras, vectors
from hypothesis import assume, given
from hypothesis import strategies as st

from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.system.errors import LucidaError

SIZE = (320, 200)
points = st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))


def seen_at(camera, point, parameter):
    """The world point on the ray through (x, y) of the image plane."""
    across = point[0] * np.asarray(camera.u) + point[1] * np.asarray(camera.v)
    if camera.is_parallel:
        return np.asarray(camera.eye) + across - parameter * np.asarray(camera.w)
    direction = across - camera.distance * np.asarray(camera.w)
    return np.asarray(camera.eye) + parameter * direction


def image_point(camera, world):
    row, column, _ = camera.project(world, SIZE)
    return np.array(camera.image_point(row, column, SIZE))


@given(cameras(), points, points, st.floats(0.2, 20))
def test_the_panned_point_follows_the_pointer(camera, start, end, parameter):
    world = seen_at(camera, start, parameter)
    after = navigation.panned(camera, start, end, parameter)
    assert image_point(after, world) == pytest.approx(np.array(end), abs=1e-6)
    assert (after.u, after.v, after.w) == (camera.u, camera.v, camera.w)


@given(cameras(), points, st.floats(0.5, 3), st.floats(0.2, 20))
def test_the_zoomed_point_stays_under_the_pointer(camera, at, factor, parameter):
    world = seen_at(camera, at, parameter)
    after = navigation.zoomed(camera, at, factor, parameter)
    assert image_point(after, world) == pytest.approx(np.array(at), abs=1e-6)
    # What is as far off as that point is seen `factor` times as large.
    other = world + 0.01 * np.asarray(camera.u)
    grown = image_point(after, other) - image_point(after, world)
    before = image_point(camera, other) - image_point(camera, world)
    columns = (camera.viewport[1] - camera.viewport[0]) / (after.viewport[1] - after.viewport[0])
    assert grown[0] * columns == pytest.approx(before[0] * factor, rel=1e-4)


@given(cameras(), vectors, st.floats(-3, 3), st.floats(-3, 3))
def test_orbit_turns_rigidly_about_the_pivot(camera, pivot, right, up):
    after = navigation.orbited(camera, pivot, right, up)
    assert np.allclose(after.basis.T @ after.basis, camera.basis.T @ camera.basis, atol=1e-9)
    assert after.determinant == pytest.approx(camera.determinant)
    # The pivot stays where it was in the camera's own coordinates.
    local = np.linalg.solve(camera.basis, np.subtract(pivot, camera.eye))
    assert np.allclose(
        np.linalg.solve(after.basis, np.subtract(pivot, after.eye)), local, atol=1e-7
    )


@given(st.floats(-3, 3), st.lists(st.floats(-1, 1), min_size=1, max_size=8))
def test_orbit_neither_rolls_nor_flips(right, ups):
    camera = Camera.look_at((1, 2, 5), (0, 0, 0))
    for up in ups:
        camera = navigation.orbited(camera, (0, 0, 0), right, up)
        assert camera.u[1] == pytest.approx(0, abs=1e-9)  # no roll: right is level
        assert camera.v[1] > 0  # up stays up
        assert abs(camera.w[1]) <= math.sin(math.radians(navigation.STEEPEST_DEG)) + 1e-9


@given(cameras(), vectors)
def test_the_switch_of_projection_keeps_the_size_at_the_focus(camera, focus):
    switched = navigation.switched_projection(camera, focus)
    assert switched.is_parallel != camera.is_parallel
    back = navigation.switched_projection(switched, focus)
    assert back.viewport == pytest.approx(camera.viewport)
    assume(-float((camera.camera_from_world @ [*focus, 1.0])[2]) / camera.distance > 0.05)
    first, second = camera.project(focus, SIZE), switched.project(focus, SIZE)
    assert second.row == pytest.approx(first.row, abs=1e-5)
    assert second.column == pytest.approx(first.column, abs=1e-5)


def test_the_viewport_is_kept_where_the_focus_is_behind_the_eye():
    camera = Camera(eye=(0, 0, -5))
    assert navigation.switched_projection(camera, (0, 0, 0)).viewport == camera.viewport
    assert navigation.parameter_of(camera, (0, 0, 0)) == 1.0


def test_a_motion_out_of_range_is_refused():
    with pytest.raises(LucidaError, match=r"eye: .* is too large"):
        navigation.panned(Camera(), (0, 0), (1, 0), 1e13)
    camera = Camera(projection="parallel")
    with pytest.raises(LucidaError, match=r"viewport: .* is empty"):
        navigation.zoomed(camera, (0.25, 0.25), 1e300, 1.0)


@given(cameras(), st.floats(0.05, 20), st.floats(0.2, 20), points)
def test_the_dolly_zoom_keeps_what_is_as_far_off_as_the_focus(camera, distance, parameter, at):
    camera = replace(camera, projection="perspective")
    focus = seen_at(camera, at, parameter)
    after = navigation.dollied(camera, focus, distance)
    assert after.distance == distance
    for offset in (np.zeros(3), camera.u, camera.v):
        point = focus + np.asarray(offset)
        assert image_point(after, point) == pytest.approx(image_point(camera, point), abs=1e-5)
    deeper = focus - np.asarray(camera.w)
    assume(abs(distance - camera.distance) > 0.1)
    assert navigation.dollied(after, focus, camera.distance).eye == pytest.approx(
        camera.eye, abs=1e-6
    )
    assert after.project(deeper, SIZE).parameter > 0


def test_the_dolly_zoom_without_a_focus_in_front_changes_the_distance_alone():
    for camera in (Camera(), Camera(projection="parallel")):
        after = navigation.dollied(camera, (0, 0, 5), 2.0)
        assert after == replace(camera, distance=2.0)


@given(cameras(), st.floats(1, 179))
def test_the_distance_for_a_field_of_view_has_it(camera, fov_y_deg):
    try:
        distance = navigation.distance_for(camera, fov_y_deg)
    except LucidaError:
        # Both edges on one side of the eye's axis: there is a largest angle.
        bottom, top = camera.viewport[2:]
        assume(bottom * top < -1e-6)
        raise
    assume(1e-9 < distance < 1e9)
    assert replace(camera, distance=distance).fov_y_deg == pytest.approx(fov_y_deg, abs=1e-4)


@pytest.mark.parametrize("fov_y_deg", [0.0, -3.0, 180.0, 180.5, math.nan, math.inf])
def test_no_distance_has_an_impossible_field_of_view(fov_y_deg):
    with pytest.raises(LucidaError, match="is not between 0 and 180"):
        navigation.distance_for(Camera(), fov_y_deg)


@pytest.mark.parametrize("mirrored", [1, -1])
@pytest.mark.parametrize("upside_down", [1, -1])
def test_orbit_turns_by_the_angles_of_the_drag(mirrored, upside_down):
    camera = Camera(eye=(0, 1, 5), u=(mirrored, 0, 0), v=(0, upside_down, 0), w=(0, 0, 3))
    after = navigation.orbited(camera, (0, 1, 0), 0.3, 0.2)
    assert math.atan2(after.w[0], after.w[2]) == pytest.approx(-0.3 * mirrored)
    assert math.asin(after.w[1] / 3) == pytest.approx(-0.2 * upside_down)
    for up, elevation_deg in ((-3.0, 89.5), (3.0, -89.5)):
        steepest = navigation.orbited(camera, (0, 1, 0), 0.0, upside_down * up)
        assert math.degrees(math.asin(steepest.w[1] / 3)) == pytest.approx(elevation_deg)


def test_where_the_wheel_stops_in_perspective():
    """From a ten thousandth of the scene's reach to a hundred times it; back from anywhere."""
    for before, after, may in (
        (2.0, 1.0005, False),
        (2.0, 1.002, True),
        (1.0001, 1.0005, True),
        (1.0005, 1.0005, True),
        (5.0, 1001.0, False),
        (5.0, 999.0, True),
        (3000.0, 2000.0, True),
        (2.0, 2.0, True),
    ):
        cameras = (Camera(eye=(0, 0, z)) for z in (before, after))
        assert navigation.may_zoom(*cameras, (0, 0, 1), (0, 0, 0), 10.0) == may


def test_where_the_wheel_stops_with_parallel_rays():
    """The viewport's width in the world counts: with u of length 2, four times its half."""
    for before, after, may in (
        (1.0, 0.2e-3, False),
        (1.0, 0.3e-3, True),
        (0.1e-3, 0.15e-3, True),
        (0.1e-3, 0.1e-3, True),
        (1.0, 510.0, False),
        (1.0, 490.0, True),
        (1000.0, 900.0, True),
        (1000.0, 1000.0, True),
    ):
        cameras = (
            Camera(
                u=(0, 2, 0), v=(1, 0, 0), viewport=(-h / 2, 3 * h / 2, -1, 1), projection="parallel"
            )
            for h in (before, after)
        )
        assert navigation.may_zoom(*cameras, (0, 0, 1), (0, 0, 0), 10.0) == may


def test_how_far_off_a_point_is():
    camera = Camera(eye=(1, 0, 5), distance=2.0)
    assert navigation.parameter_of(camera, (0, 3, 0)) == pytest.approx(2.5)
    parallel = replace(camera, projection="parallel")
    assert navigation.parameter_of(parallel, (0, 3, 0)) == pytest.approx(5)
    for point in ((0, 0, 5), (0, 0, 6)):
        assert navigation.parameter_of(camera, point, behind=7.0) == 7
        assert navigation.parameter_of(parallel, point) == 1


def test_of_two_distances_with_one_field_of_view_the_larger():
    """For a viewport above the eye's axis, tan = d / (d^2 + 2)."""
    camera = Camera(viewport=(-1, 1, 1, 2))
    tan = math.tan(math.radians(15))
    wanted = (1 / tan + math.sqrt(1 / tan**2 - 8)) / 2
    assert navigation.distance_for(camera, 15) == pytest.approx(wanted)
    with pytest.raises(LucidaError, match="field of view: 1e-300 needs a viewport farther away"):
        navigation.distance_for(Camera(), 1e-300)
    with pytest.raises(LucidaError, match="is more than this off-axis viewport has"):
        navigation.distance_for(camera, 20)


def test_orbit_from_straight_above_leaves_the_horizon_level():
    u, v = (0.6, 0, -0.8), (-0.8, 0, -0.6)
    above = Camera(eye=(0, 5, 0), u=u, v=v, w=(0, 1, 0))
    after = navigation.orbited(above, (0, 0, 0), 0.0, 0.3)  # dragging upwards lowers the eye
    sine, cosine = math.sin(0.3), math.cos(0.3)
    assert after.eye == pytest.approx((4 * sine, 5 * cosine, 3 * sine))
    assert after.u == pytest.approx(u)


def test_a_turn_is_right_handed_about_an_axis_of_any_length():
    for axis in ((0, 1, 0), (0, 20, 0)):
        after = navigation.turned(Camera(eye=(1, 2, 3)), (0, 0, 3), axis, math.pi / 2)
        assert after.eye == pytest.approx((0, 2, 2))
        assert after.u == pytest.approx((0, 0, -1))


@given(cameras(), st.sampled_from((0, 1)), st.floats(-3, 3))
def test_a_shift_keeps_the_viewport_s_size(camera, axis, value):
    after = navigation.with_shift(camera, axis, value)
    low, high = after.viewport[2 * axis : 2 * axis + 2]
    was_low, was_high = camera.viewport[2 * axis : 2 * axis + 2]
    assert (low + high) / 2 == pytest.approx(value)
    assert high - low == pytest.approx(was_high - was_low)
    other = 2 - 2 * axis
    assert after.viewport[other : other + 2] == camera.viewport[other : other + 2]


def test_a_pan_behind_a_lens_takes_the_point_along_and_stops_where_the_lens_ends():
    camera = Camera(eye=(1, 2, 3), viewport=(-4, 4, -4, 4), lens=Lens("equidistant"))
    start, end = (0.3, -0.2), (-0.5, 0.6)
    after = navigation.panned(camera, start, end, 2.0)
    point = np.add(camera.eye, 2 * camera.direction(*start))
    assert np.allclose(np.add(after.eye, 2 * after.direction(*end)), point)
    assert after.eye != camera.eye
    assert navigation.panned(camera, start, (3.9, 3.9), 2.0) is camera  # no ray comes from there
