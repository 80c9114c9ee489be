"""A matrix without a name: one of its meanings is the camera that printed it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida.app.cameras.meanings import matrix_in, meanings
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import View

CAMERA = Camera.look_at((3, 2, 5), (0, 0.5, 0), fov_y_deg=40)
NOW = View(replace(CAMERA, eye=(0, 0, 9), u=(1, 0, 0), v=(0, 1, 0), w=(0, 0, 1)))
POSE = np.linalg.inv(CAMERA.camera_from_world)
POINTS = np.random.default_rng(1).uniform(-1, 1, (20, 3))
Y_DOWN = np.diag([1.0, -1, -1, 1])
SIZE = (64, 64)


def pixels(camera: Camera) -> np.ndarray:
    return np.stack(camera.project(POINTS, SIZE)[:2])


def product(camera: Camera) -> np.ndarray:
    return camera.clip_from_camera(0.1, 100) @ camera.camera_from_world


def p_matrix() -> np.ndarray:
    K, R, t = CAMERA.intrinsics(SIZE, "center")
    return -2.5 * K @ np.column_stack([R, t])


OFF_AXIS = replace(CAMERA, viewport=(-0.5, 0.3, -0.4, 0.4))
PARALLEL = replace(CAMERA, projection="parallel")


@pytest.mark.parametrize(
    ("matrix", "words", "camera"),
    [
        (POSE, "camera to world, y up, z back (OpenGL)", CAMERA),
        (POSE @ Y_DOWN, "camera to world, y down, z forward (OpenCV)", CAMERA),
        (CAMERA.camera_from_world, "world to camera, y up, z back (OpenGL)", CAMERA),
        (Y_DOWN @ CAMERA.camera_from_world, "world to camera, y down", CAMERA),
        ((Y_DOWN @ CAMERA.camera_from_world)[:3], "world to camera, y down", CAMERA),
        (p_matrix(), "P = K [R | t], in pixels", CAMERA),
        (product(CAMERA), "projection times view (MVP)", CAMERA),
        (product(OFF_AXIS), "projection times view (MVP)", OFF_AXIS),
        (Y_DOWN * [1, 1, -1, 1] @ product(CAMERA), "projection times view (MVP)", CAMERA),
        (product(PARALLEL), "parallel projection times view (MVP)", PARALLEL),
    ],
)
@pytest.mark.parametrize("is_transposed", [False, True])
def test_one_meaning_is_the_camera_itself(matrix, words, camera, is_transposed) -> None:
    rows = matrix.T if is_transposed else matrix
    found = meanings(matrix_in(str(rows.tolist())), NOW, (0, 0, 0))
    named = [meaning for meaning in found if words in meaning.words]
    (meaning,) = (each for each in named if ("transposed" in each.words) == is_transposed)
    np.testing.assert_allclose(pixels(meaning.view.camera), pixels(camera), atol=1e-6)
    best = found[0].view.camera
    assert np.asarray(best.w) @ best.eye > 0  # it looks at the scene


def test_no_place_is_minus_zero() -> None:
    found = meanings(np.eye(4), NOW, (0, 0, -5))
    assert "eye (0, 0, 0), looks along (0, 0, -1)" in found[0].words


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("<Matrix 4x4 (1, 0, 0, 3)\n (0, 1, 0, 0)\n (0, 0, 1, 0)\n (0, 0, 0, 1)>", 16),
        ("np.array([[1, 0, 0, 3.5e-01], [0, 1, 0, 0], [0, 0, 1, 0]], dtype=float32)", 12),
        ("float m[16] = {1, 0, 0, 0, 0, 1.f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; // view", 16),
        ("1 2 3", 0),
        ("", 0),
    ],
)
def test_numbers_are_found_in_any_notation(text: str, count: int) -> None:
    matrix = matrix_in(text)
    assert (0 if matrix is None else matrix.size) == count


@pytest.mark.parametrize("numbers", [np.zeros(16), np.arange(16), np.zeros(12), np.ones(12)])
def test_a_matrix_that_is_no_camera_has_no_meaning(numbers: np.ndarray) -> None:
    assert meanings(numbers.reshape(-1, 4), NOW, (0, 0, 0)) == []
