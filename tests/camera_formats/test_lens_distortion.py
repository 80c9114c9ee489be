"""The lens of a file: which of Lens's models it is, and how far it moves an image's points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from renderer import LucidaError
from renderer.camera_formats.colmap_lenses import MODELS, ColmapLens, add_lens
from renderer.camera_formats.distortion import COUNTS, FISHEYE_NAMES, NAMES, distortion

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


def colmap_lens(model: str, values: list[float]) -> ColmapLens:
    found: dict[int, ColmapLens] = {}
    add_lens(found, 1, model, *SIZE, values)
    return found[1]


@pytest.mark.parametrize(("model", "parameters", "moved"), COLMAP)
def test_a_corner_moves_as_in_colmap(model: str, parameters: str, moved: float) -> None:
    values = [float(word) for word in parameters.split()]
    lens = colmap_lens(model, values).distortion
    assert lens is not None and lens.model == model
    assert lens.largest_px == pytest.approx(moved, rel=1e-11)
    assert 0 < lens.median_px < lens.largest_px
    names = [name for name in MODELS[model] if name not in ("f", "fx", "fy", "cx", "cy")]
    assert lens.coefficients == dict(zip(names, values[-len(names) :], strict=True))


def test_a_colmap_lens_without_distortion_is_a_pinhole_unless_it_is_a_fisheye() -> None:
    for model, names in MODELS.items():
        focal = [900.0] * sum(name.startswith("f") for name in names)
        values = [*focal, 320.0, 240.0]
        found = colmap_lens(model, values + [0.0] * (len(names) - len(values)))
        assert found.matrix.tolist() == [[900, 0, 320], [0, 900, 240], [0, 0, 1]]
        assert (found.distortion is None) == ("FISHEYE" not in model), model


@pytest.mark.parametrize(
    ("count", "moved"),
    [
        (4, 20.875176251529727),
        (5, 22.976015105322265),
        (8, 16.336102233552122),
        (12, 16.39549019682774),
    ],
)
def test_opencvs_vectors_move_a_corner_as_in_opencv(count: int, moved: float) -> None:
    """Compare with cv2.projectPoints of OpenCV 5.0.0, the farthest of the four corners."""
    coefficients = dict(zip(NAMES, VECTOR[:count], strict=False))
    lens = distortion("lens", "brown", coefficients, K, SIZE, "center")
    assert lens is not None and lens.coefficients == coefficients
    assert lens.largest_px == pytest.approx(moved, rel=1e-9)


def test_a_tilted_sensor_is_refused() -> None:
    tilted = dict(zip(NAMES, VECTOR, strict=True))
    with pytest.raises(LucidaError, match=r"tauX: 0\.02 is a tilted sensor's"):
        distortion("lens", "brown", tilted, K, SIZE)
    level = tilted | {"tauX": 0.0, "tauY": 0.0}
    assert distortion("lens", "brown", level, K, SIZE) is not None
    assert len(NAMES) == COUNTS[-1]


def test_a_fisheye_distorts_without_coefficients() -> None:
    r = math.hypot(320.5, 240.5) / 500
    lens = distortion("lens", "fisheye", dict.fromkeys(FISHEYE_NAMES, 0.0), K, SIZE, "center")
    assert lens is not None and lens.largest_px == pytest.approx(500 * (r - math.atan(r)))
    assert distortion("lens", "brown", dict.fromkeys(NAMES, 0.0), K, SIZE) is None


def test_where_a_lens_folds_it_moves_nothing() -> None:
    """At 1.9e10 pixels, which a polynomial reaches, a lens shows nothing."""
    lens = distortion("lens", "brown", {"k1": -1.0, "k3": -1e6}, K, SIZE)
    assert lens is not None and 0 < lens.largest_px < 10
    lens = distortion("lens", "brown", {"k4": -0.5}, np.eye(3), (1, 1))  # divides by 0
    assert lens is not None and math.isfinite(lens.largest_px)
