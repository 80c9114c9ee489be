"""The camera contract, against independent arithmetic and for all legal cameras."""

import math
from dataclasses import replace

import numpy as np
import pytest
from any_camera import cameras
from hypothesis import given
from hypothesis import strategies as st

from lucida import Camera, LucidaError
from lucida.renderer.camera.camera import check_camera
from lucida.renderer.camera.checks import LARGEST, SMALLEST, volume
from lucida.renderer.scene.model import View

sizes = st.tuples(st.integers(1, 40), st.integers(1, 40))


@given(cameras(), sizes, st.floats(0.01, 100))
def test_points_on_every_viewing_ray_project_back_to_its_pixel(camera, size, t):
    origin, direction = camera.rays(size)
    assert origin.shape == direction.shape == (size[1], size[0], 3)
    row, column, parameter = camera.project(origin + t * direction, size)
    np.testing.assert_allclose(
        row, np.broadcast_to(np.arange(size[1])[:, None], row.shape), atol=1e-6
    )
    np.testing.assert_allclose(column, np.broadcast_to(np.arange(size[0]), row.shape), atol=1e-6)
    np.testing.assert_allclose(parameter, t, rtol=1e-7)


@given(cameras(), st.floats(0.01, 10), st.floats(1.1, 1000))
def test_near_maps_to_minus_one_and_far_to_plus_one(camera, near, ratio):
    far = near * ratio
    matrix = camera.clip_from_camera(near, far) @ camera.camera_from_world
    world_from_camera = np.eye(4)
    world_from_camera[:3] = np.column_stack([camera.u, camera.v, camera.w, camera.eye])
    left, right, bottom, top = camera.viewport
    for depth, expected in ((near, -1.0), (far, 1.0)):
        spread = 1.0 if camera.is_parallel else depth / camera.distance
        for x, x_clip in ((left, -1.0), (right, 1.0)):
            for y, y_clip in ((bottom, -1.0), (top, 1.0)):
                local = np.array([x * spread, y * spread, -depth, 1.0])
                clip = matrix @ world_from_camera @ local
                np.testing.assert_allclose(
                    clip[:3] / clip[3], [x_clip, y_clip, expected], atol=1e-6
                )


@given(cameras())
def test_orthonormalized_keeps_the_direction_of_w_and_the_handedness(camera):
    straight = camera.orthonormalized()
    np.testing.assert_allclose(straight.basis.T @ straight.basis, np.eye(3), atol=1e-9)
    assert math.copysign(1, straight.determinant) == math.copysign(1, camera.determinant)
    np.testing.assert_allclose(straight.w, camera.w / np.linalg.norm(camera.w), atol=1e-12)
    np.testing.assert_allclose(straight.orthonormalized().basis, straight.basis, atol=1e-12)


def test_the_canonical_camera_is_the_lectures():
    """1-based: u = (j - 0.5) / W - 0.5, v = -((i - 0.5) / H - 0.5), direction (u, v, -1)."""
    width, height = 7, 4
    origin, direction = Camera.canonical().rays((width, height))
    for i in range(1, height + 1):
        for j in range(1, width + 1):
            expected = ((j - 0.5) / width - 0.5, -((i - 0.5) / height - 0.5), -1.0)
            np.testing.assert_allclose(direction[i - 1, j - 1], expected)
            np.testing.assert_array_equal(origin[i - 1, j - 1], 0)


def test_parallel_rays_start_on_the_plane_of_the_eye_and_share_a_direction():
    camera = Camera(eye=(1, 2, 3), w=(0, 0, 2), viewport=(0, 4, 0, 2), projection="parallel")
    origin, direction = camera.rays((4, 2))
    np.testing.assert_array_equal(direction, np.broadcast_to([0, 0, -2], (2, 4, 3)))
    np.testing.assert_allclose(origin[0, 0], [1.5, 3.5, 3])
    np.testing.assert_allclose(origin[1, 3], [4.5, 2.5, 3])


def test_look_at_aims_at_the_target_with_up_upwards():
    camera = Camera.look_at((3, 4, 5), (0, 1, 0), (0, 2, 0), fov_y_deg=50, aspect=2)
    row, column, parameter = camera.project((0, 1, 0), (200, 100))
    assert (row, column) == (pytest.approx(49.5), pytest.approx(99.5))
    assert parameter > 0
    assert camera.project((0, 1.1, 0), (200, 100)).row < row
    assert camera.determinant == pytest.approx(1)
    assert camera.fov_y_deg == pytest.approx(50)
    assert Camera.look_at((0, 0, 5), (0, 0, 0), distance=2).distance == 2
    assert Camera.look_at((0, 0, 5), (0, 0, 0)) == Camera(eye=(0, 0, 5))


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"target": (0, 0, 5)}, "target"),
        ({"target": (0, 5, 5)}, "up"),
        ({"target": (0, 0, 0), "up": (0, 0, 0)}, "up"),
        ({"target": (0, 0, 0), "fov_y_deg": 180}, "fov_y_deg"),
        ({"target": (0, 0, 0), "fov_y_deg": 40, "distance": 1}, "fov_y_deg"),
        ({"target": (0, 0, 0), "aspect": 0}, "aspect"),
        ({"target": (0, 0, math.nan)}, "target"),
    ],
)
def test_look_at_names_what_is_wrong(arguments, field):
    with pytest.raises(LucidaError) as error:
        Camera.look_at((0, 0, 5), **arguments)
    assert error.value.field == field


def test_denormal_numbers_are_legal():
    assert Camera(u=(1, 0, 5e-324), v=(0, 1, 0), w=(0, 0, 1)).determinant == 1
    assert abs(volume((0, 0, 1), (0, 1, 0), (5e-324, 0, 1))) < 1e-300


def test_dependent_vectors_are_named():
    with pytest.raises(LucidaError, match=r"w: \(1, 1, 0\) lies in the plane of u .* and v"):
        Camera(w=(1, 1, 0))
    with pytest.raises(LucidaError, match=r"v: \(2, 0, 0\) is parallel to u = \(1, 0, 0\)"):
        Camera(v=(2, 0, 0))


def test_a_basis_is_usable_down_to_a_volume_of_1e_9():
    """The volume is that of the unit vectors; look_at works 1e-8 off the direction of up, too."""
    flat = {"u": (1, 0, 0), "v": (0, 2, 0)}
    assert Camera(w=(3, 3, 1.1e-9 * math.sqrt(18)), **flat).determinant > 0
    with pytest.raises(LucidaError, match=r"w: .* lies in the plane of u"):
        Camera(w=(3, 3, 0.9e-9 * math.sqrt(18)), **flat)
    Camera.look_at((0, 0, 5), (0, 0, 0), up=(1.1e-8, 0, 1))
    with pytest.raises(LucidaError, match=r"up: .* along the view direction"):
        Camera.look_at((0, 0, 5), (0, 0, 0), up=(0.9e-8, 0, 1))


def test_points_behind_the_eye_have_no_pixel_in_perspective():
    row, column, parameter = Camera.canonical().project([(0, 0, 1), (0, 0, 0)], (4, 4))
    assert np.isnan(row).all()
    assert np.isnan(column).all()
    np.testing.assert_array_equal(parameter, [-1, 0])


@given(cameras(), sizes)
def test_fitted_has_the_images_aspect_and_loses_nothing(camera, size):
    left, right, bottom, top = camera.fitted(size).viewport
    assert (right - left) / (top - bottom) == pytest.approx(size[0] / size[1])
    old = camera.viewport
    tolerance = 1e-9
    assert left <= old[0] + tolerance and right >= old[1] - tolerance
    assert bottom <= old[2] + tolerance and top >= old[3] - tolerance
    assert left + right == pytest.approx(old[0] + old[1], abs=1e-9)
    assert bottom + top == pytest.approx(old[2] + old[3], abs=1e-9)
    # Nor is more seen than is needed: one of the two stays.
    grown = (right - left) / (old[1] - old[0]), (top - bottom) / (old[3] - old[2])
    assert min(grown) == pytest.approx(1)


@given(cameras(), sizes, st.floats(-2, 2), st.floats(-2, 2))
def test_shifted_moves_the_pixels(camera, size, rows, columns):
    moved = camera.shifted(rows, columns, size).ray(1, 2, size)
    expected = camera.ray(1 + rows, 2 + columns, size)
    np.testing.assert_allclose(moved.origin, expected.origin, atol=1e-9)
    np.testing.assert_allclose(moved.direction, expected.direction, atol=1e-9)


def test_near_and_far_become_ray_parameters():
    camera = Camera(distance=2, near=1, far=8)
    assert camera.t_range == (0.5, 4)
    assert replace(camera, projection="parallel").t_range == (1, 8)
    assert Camera().t_range == (0, math.inf)


def test_cameras_are_values():
    camera = Camera(eye=np.array([1, 2, 3]), viewport=[-1, 1, -1, 1])
    assert camera == Camera(eye=(1.0, 2.0, 3.0), viewport=(-1, 1, -1, 1))
    assert hash(camera) == hash(replace(camera))
    with pytest.raises(AttributeError, match="cannot assign"):
        camera.distance = 2


def test_the_smallest_and_the_largest_numbers_are_legal():
    tiny, large = SMALLEST, LARGEST
    for axis in ("u", "v", "w"):
        vector = np.array(getattr(Camera(), axis)) * tiny
        assert getattr(Camera(**{axis: vector}), axis) == tuple(vector)
    camera = Camera(distance=tiny, near=tiny, eye=(large, -large, 0))
    assert (camera.distance, camera.near, camera.eye) == (tiny, tiny, (large, -large, 0))
    assert Camera(far=0.5).far == 0.5
    assert Camera.look_at((0, 0, 0), (0, 0, -tiny), (0, tiny, 0)).basis == pytest.approx(np.eye(3))
    for fov_y_deg in (0.5, 179.5):
        camera = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=fov_y_deg, aspect=0.5)
        assert camera.fov_y_deg == pytest.approx(fov_y_deg)
        assert camera.viewport == (-0.25, 0.25, -0.5, 0.5)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"eye": (0, 0, math.nan)}, "eye: nan is not finite; give"),
        ({"eye": (0, 0)}, "eye: (0, 0) is not 3 numbers; give"),
        ({"projection": "fisheye"}, "projection: 'fisheye' is unknown; give"),
        ({"distance": "far"}, "distance: 'far' is not a number; give"),
        ({"distance": 0}, "distance: 0 is not above 0; give"),
        ({"distance": SMALLEST / 2}, "distance: 5e-13 is not above 1e-12; give"),
        ({"u": (0, 0, 0)}, "u: (0, 0, 0) is not independent of v and w; give u a part"),
        ({"w": (0, SMALLEST / 2, 0)}, "w: (0, 5e-13, 0) is not independent of u and v"),
        ({"near": 0}, "near: 0 is not above 0; give"),
        ({"near": 2, "far": 1}, "far: 1 is not above near = 2; give"),
        ({"far": -1}, "far: -1 is not above 0; give"),
        ({"eye": (2 * LARGEST, 0, 0)}, "eye: 2e+12 is too large; stay within 1e+12"),
        ({"viewport": (100, 100 + 8e-8, 0, 1)}, "is empty; give left, right, bottom, top, left <"),
        ({"viewport": (0, 1, 2, 1)}, "is empty; give left, right, bottom, top, bottom < top"),
    ],
)
def test_what_is_told_of_illegal_numbers(changes, told):
    with pytest.raises(LucidaError) as error:
        Camera(**changes)
    assert told in str(error.value)


def test_a_narrow_viewport_is_legal_where_its_numbers_tell_the_edges_apart():
    for viewport in ((100, 100 + 1.2e-7, 0, 1), (0, 1, 1, 1 + 1.2e-9), 2 * (-1e-20, 1e-20)):
        assert Camera(viewport=viewport).viewport == viewport


def test_what_is_no_camera_is_refused():
    camera = Camera()
    assert check_camera(camera) is camera
    with pytest.raises(LucidaError, match=r"is of type View, not a Camera; give .for_size\(size\)"):
        check_camera(View(camera))
    with pytest.raises(LucidaError, match="is of type str, not a Camera; give a Camera"):
        check_camera("front")
