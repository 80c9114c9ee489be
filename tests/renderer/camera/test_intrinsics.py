"""K, R and t against the camera: the same pixels, both ways, and what is no camera."""

import numpy as np
import pytest
from format_cameras import any_size, skewed_camera

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import LARGEST
from lucida.renderer.system.errors import LucidaError

K = [[800.0, 0.0, 320.0], [0.0, 810.0, 240.0], [0.0, 0.0, 1.0]]
SIZE = (640, 480)


@pytest.mark.parametrize("origin", ["center", "corner"])
def test_k_r_and_t_lead_to_the_same_pixels_and_back(origin):
    random = np.random.default_rng(1)
    offset = 0.0 if origin == "center" else 0.5
    for _ in range(200):
        camera, size = skewed_camera(random), any_size(random)
        row, column = random.uniform(0, size[1] - 1), random.uniform(0, size[0] - 1)
        ray = camera.ray(row, column, size)
        point = ray.origin + random.uniform(0.5, 5) * ray.direction
        k, r, t = camera.intrinsics(size, origin)
        assert np.allclose(r @ r.T, np.eye(3)) and np.linalg.det(r) > 0
        assert k[2].tolist() == [0, 0, 1] and k[1, 0] == 0 and k[1, 1] > 0
        assert (k[0, 0] > 0) == (camera.determinant > 0)
        x, y, depth = k @ (r @ point + t)
        assert depth > 0
        assert (x / depth, y / depth) == pytest.approx((column + offset, row + offset), abs=1e-6)
        pose = np.column_stack([r, t])
        again = Camera.from_intrinsics(k, size=size, camera_from_world=pose, pixel_origin=origin)
        assert again.project(point, size)[:2] == pytest.approx((row, column), abs=1e-6)


def test_a_pose_is_given_either_way_and_with_either_axes():
    r = np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = r, (1.0, 2.0, 3.0)
    flip = np.diag([1.0, -1.0, -1.0, 1.0])
    cameras = [
        Camera.from_intrinsics(K, size=SIZE, camera_from_world=pose),
        Camera.from_intrinsics(K, size=SIZE, camera_from_world=pose[:3]),
        Camera.from_intrinsics(K, size=SIZE, world_from_camera=np.linalg.inv(pose)),
        Camera.from_intrinsics(K, size=SIZE, camera_from_world=flip @ pose, axes="opengl"),
        Camera.from_intrinsics(
            K, size=SIZE, world_from_camera=np.linalg.inv(pose) @ flip, axes="opengl"
        ),
    ]
    for camera in cameras:
        for name in ("eye", "u", "v", "w", "viewport"):
            assert getattr(camera, name) == pytest.approx(getattr(cameras[0], name))
    assert cameras[0].w == pytest.approx((0.8, 0.0, -0.6))


def test_half_a_pixel_lies_between_the_two_origins():
    center, corner = (
        Camera.from_intrinsics(K, size=SIZE, pixel_origin=origin) for origin in ("center", "corner")
    )
    assert center.viewport[0] == pytest.approx(corner.viewport[0] - 0.5 / 800)
    assert center.viewport[3] == pytest.approx(corner.viewport[3] + 0.5 / 810)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"K": np.transpose(K)}, "K: its rows"),
        ({"K": [[0, 0, 320], [0, 810, 240], [0, 0, 1]]}, "K: its focal lengths"),
        ({"K": [1, 2, 3]}, "K: has the shape"),
        ({"K": "K"}, "K: is not a matrix"),
        ({"K": np.full((3, 3), np.nan)}, "K: has a number that is not finite"),
        ({"camera_from_world": np.zeros((3, 4))}, "camera_from_world: its rows"),
        ({"world_from_camera": np.zeros((4, 4))}, "world_from_camera: its rows"),
        (
            {"camera_from_world": np.eye(4), "world_from_camera": np.eye(4)},
            "world_from_camera: cannot be used together with",
        ),
        ({"axes": "blender"}, "axes: 'blender'"),
        ({"pixel_origin": "middle"}, "pixel_origin: 'middle'"),
        ({"size": (0, 4)}, "size: 0x4"),
    ],
)
def test_what_is_no_camera_is_told(given, told):
    with pytest.raises(LucidaError, match=told):
        Camera.from_intrinsics(**{"K": K, "size": SIZE} | given)


@pytest.mark.parametrize("place", [(1, 0), (2, 0), (2, 1)])
def test_below_the_diagonal_k_holds_nothing(place):
    wrong = np.array(K)
    wrong[place] = 1e-3
    with pytest.raises(LucidaError, match="K: its rows"):
        Camera.from_intrinsics(wrong, size=SIZE)


def test_k_may_have_any_scale():
    camera = Camera.from_intrinsics(2 * np.array(K), size=SIZE)
    assert camera.viewport == Camera.from_intrinsics(K, size=SIZE).viewport


def test_a_number_of_k_that_is_too_large_is_refused():
    wrong = np.array(K)
    wrong[0, 0] = 2 * LARGEST
    with pytest.raises(LucidaError, match="K: has the number 2e\\+12, which is too large"):
        Camera.from_intrinsics(wrong, size=SIZE)


def test_a_parallel_camera_has_no_intrinsics():
    with pytest.raises(LucidaError, match="projection: 'parallel'"):
        Camera(projection="parallel").intrinsics(SIZE)
