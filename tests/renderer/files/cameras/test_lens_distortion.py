"""The lens of a file: which of Lens's models it is, and where it moves an image's corners."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from lucida import Camera, LucidaError
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import colmap_lenses
from lucida.renderer.files.cameras.colmap_lenses import ColmapLens
from lucida.renderer.files.cameras.distortion import COUNTS, FISHEYE_NAMES, NAMES, lens_of

K = np.array([[500.0, 0.0, 320.0], [0.0, 500.0, 240.0], [0.0, 0.0, 1.0]])
SIZE = (640, 480)
VECTOR = (
    *(0.1, -0.05, 0.002, -0.003, 0.02, 0.01, 0.03),
    *(-0.01, 0.004, -0.002, 0.003, 0.001, 0.02, -0.03),
)
# Of an image of 640 x 480 around (320, 240): the distance to which img_from_cam (pycolmap 4.2.1)
# moves the corner that it moves farthest.
COLMAP = [
    ("SIMPLE_RADIAL", "900 320 240 -0.1", 7.90123456790127),
    ("RADIAL", "900 320 240 -0.1 0.02", 7.589087029416231),
    ("OPENCV", "900 910 320 240 -0.1 0.02 0.003 -0.004", 10.187976307496255),
    ("OPENCV_FISHEYE", "500 510 320 240 -0.01 0.002 0.0003 -0.0004", 63.35634779993585),
    ("FULL_OPENCV", "900 910 320 240 -0.1 0.02 0.003 -0.004 0.05 0.06 -0.07 0.08", 13.79857260607),
    ("FOV", "500 510 320 240 0.9", 33.7720163863075),
    ("SIMPLE_RADIAL_FISHEYE", "500 320 240 -0.02", 65.70145800106432),
    ("RADIAL_FISHEYE", "500 320 240 -0.02 0.03", 63.603597648196136),
    ("THIN_PRISM_FISHEYE", "500 510 320 240 -0.01 0.002 0.003 -0.004 0.0005 0.0006 0.007 -0.008",
     64.3770742878243),
]  # fmt: skip


def moved(lens: Lens, origin: str = "corner", matrix: np.ndarray = K) -> float:
    """Return how far a lens moves a corner of a pinhole's image, at most."""
    pinhole = Camera.from_intrinsics(matrix, size=SIZE, pixel_origin=origin)
    rows, columns = np.array([(-0.5, -0.5), (-0.5, 639.5), (479.5, -0.5), (479.5, 639.5)]).T
    seen = replace(pinhole, lens=lens).project(pinhole.ray(rows, columns, SIZE).direction, SIZE)
    return float(np.hypot(seen.row - rows, seen.column - columns).max())


def colmap_lens(model: str, values: list[float]) -> ColmapLens:
    return colmap_lenses.colmap_lens(model, *SIZE, values)


def used(model: str, coefficients: Mapping[str, float]) -> Lens:
    lens = lens_of(model, coefficients)
    assert lens is not None
    return lens


@pytest.mark.parametrize(("model", "parameters", "largest"), COLMAP)
def test_a_corner_moves_as_in_colmap(model: str, parameters: str, largest: float) -> None:
    found = colmap_lens(model, [float(word) for word in parameters.split()])
    assert moved(used(*found[2:]), matrix=found.matrix) == pytest.approx(largest, rel=1e-11)


def test_a_colmap_lens_without_distortion_is_a_pinhole_unless_it_is_a_fisheye() -> None:
    for model, parameters, _ in COLMAP:
        values = [0.0 if -0.2 < float(word) < 1 else float(word) for word in parameters.split()]
        lens = lens_of(*colmap_lens(model, values)[2:])
        assert (lens is None) == ("FISHEYE" not in model), model


@pytest.mark.parametrize(
    ("count", "largest"),
    [
        (4, 20.875176251529727),
        (5, 22.976015105322265),
        (8, 16.336102233552122),
        (12, 16.39549019682774),
    ],
)
def test_opencvs_vectors_move_a_corner_as_in_opencv(count: int, largest: float) -> None:
    """Compare with cv2.projectPoints of OpenCV 5.0.0, the farthest of the four corners."""
    lens = used("brown", dict(zip(NAMES, VECTOR[:count], strict=False)))
    assert moved(lens, "center") == pytest.approx(largest, rel=1e-9)


def test_a_tilted_sensor_is_refused() -> None:
    tilted = dict(zip(NAMES, VECTOR, strict=True))
    with pytest.raises(LucidaError, match=r"tauX: 0\.02 is a tilted sensor's"):
        lens_of("brown", tilted)
    assert used("brown", tilted | {"tauX": 0.0, "tauY": 0.0}).coefficient("s4") == 0.001
    assert len(NAMES) == COUNTS[-1]


def test_a_fisheye_distorts_without_coefficients() -> None:
    r = math.hypot(320.5, 240.5) / 500
    lens = used("fisheye", dict.fromkeys(FISHEYE_NAMES, 0.0))
    assert moved(lens, "center") == pytest.approx(500 * (r - math.atan(r)))
    assert lens_of("brown", dict.fromkeys(NAMES, 0.0)) is None
