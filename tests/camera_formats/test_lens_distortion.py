"""How far a lens moves the corner of an image: the formulas, against numbers worked out apart."""

from __future__ import annotations

import math

import numpy as np
import pytest

from renderer.camera_formats import distortion

K = np.array([[500.0, 0.0, 320.0], [0.0, 500.0, 240.0], [0.0, 0.0, 1.0]])
SIZE = (640, 480)

VECTOR = (
    *(0.1, -0.05, 0.002, -0.003, 0.02, 0.01, 0.03),
    *(-0.01, 0.004, -0.002, 0.003, 0.001, 0.02, -0.03),
)


def moved(names: tuple[str, ...], numbers: tuple[float, ...], bend: distortion.Bend) -> float:
    coefficients = dict(zip(names, numbers, strict=False))
    lens = distortion.lens("lens", coefficients, bend, K, SIZE, "center")
    assert lens is not None and lens.coefficients == coefficients
    return lens.corner_px


@pytest.mark.parametrize(
    ("count", "corner_px"),
    [
        (4, 20.875176251529727),
        (5, 22.976015105322265),
        (8, 16.336102233552122),
        (12, 16.39549019682774),
        (14, 26.018818048895085),
    ],
)
def test_the_corner_moves_as_cv2_moves_it(count: int, corner_px: float) -> None:
    """By cv2.projectPoints of OpenCV 5.0.0, the farthest of the four corners."""
    px = moved(distortion.NAMES, VECTOR[:count], distortion.radial_tangential)
    assert px == pytest.approx(corner_px, rel=1e-9)


def test_a_fisheye_s_corner_moves_as_cv2_moves_it() -> None:
    px = moved(distortion.FISHEYE_NAMES, (0.1, -0.02, 0.01, 0.003), distortion.fisheye)
    assert px == pytest.approx(48.527277938223506, rel=1e-9)  # cv2.fisheye.distortPoints


def test_what_is_all_zero_is_none_but_for_a_fisheye() -> None:
    zeros = dict.fromkeys(distortion.NAMES, 0.0)
    bend = distortion.radial_tangential
    assert distortion.lens("lens", zeros, bend, K, SIZE, "center") is None
    assert distortion.lens("lens", {}, bend, K, SIZE, "corner") is None
    r = math.hypot(320.5, 240.5) / 500
    assert moved((), (), distortion.fisheye) == pytest.approx(500 * (r - math.atan(r)))


def test_the_corner_in_the_middle_stays() -> None:
    """A principal point at a corner of the image, where a fisheye has no direction."""
    at_corner = np.array([[500.0, 0, 0], [0, 500, 0], [0, 0, 1]])
    lens = distortion.lens("lens", {"k1": 0.1}, distortion.fisheye, at_corner, (1, 1), "corner")
    assert lens is not None and 0 < lens.corner_px < 1e-5


def test_what_has_no_end_is_told_as_that() -> None:
    at_pole = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]])
    bend = distortion.radial_tangential
    lens = distortion.lens("lens", {"k4": -0.5}, bend, at_pole, (1, 1), "corner")
    assert lens is not None and lens.corner_px == math.inf
