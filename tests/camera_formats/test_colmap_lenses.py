"""COLMAP's camera models against numbers that pycolmap gave."""

from __future__ import annotations

import pytest

from renderer.camera_formats.colmap_lenses import MODELS, lens

# Of an image of 640 x 480 around (320, 240): how far img_from_cam (pycolmap 4.2.1) takes the
# corner that it moves farthest.
MOVED = [
    ("SIMPLE_RADIAL", "900 320 240 -0.1", 7.90123456790127),
    ("RADIAL", "900 320 240 -0.1 0.02", 7.589087029416231),
    ("OPENCV", "900 910 320 240 -0.1 0.02 0.003 -0.004", 10.187976307496255),
    ("OPENCV_FISHEYE", "500 510 320 240 -0.01 0.002 0.0003 -0.0004", 63.35634779993585),
    (
        "FULL_OPENCV",
        "900 910 320 240 -0.1 0.02 0.003 -0.004 0.05 0.06 -0.07 0.08",
        13.798572606078197,
    ),
    ("FOV", "500 510 320 240 0.9", 33.7720163863075),
    ("SIMPLE_RADIAL_FISHEYE", "500 320 240 -0.02", 65.70145800106432),
    ("RADIAL_FISHEYE", "500 320 240 -0.02 0.03", 63.603597648196136),
    (
        "THIN_PRISM_FISHEYE",
        "500 510 320 240 -0.01 0.002 0.003 -0.004 0.0005 0.0006 0.007 -0.008",
        64.3770742878243,
    ),
]


@pytest.mark.parametrize(("model", "parameters", "moved"), MOVED)
def test_a_lens_moves_the_corner_as_colmap_has_it(model, parameters, moved):
    values = [float(word) for word in parameters.split()]
    found = lens(model, 640, 480, values)
    assert found.distortion is not None and found.distortion.model == model
    assert found.distortion.corner_px == pytest.approx(moved, rel=1e-11)
    names = [name for name in MODELS[model].parameters if name not in ("f", "fx", "fy", "cx", "cy")]
    assert list(found.distortion.coefficients) == names
    assert list(found.distortion.coefficients.values()) == values[-len(names) :]


def test_a_lens_that_does_nothing_is_a_pinhole_but_for_fisheyes():
    for model, entry in MODELS.items():
        focal = [900.0] * sum(name.startswith("f") for name in entry.parameters)
        values = [*focal, 320.0, 240.0]
        values += [0.0] * (len(entry.parameters) - len(values))
        found = lens(model, 640, 480, values)
        assert found.matrix.tolist() == [[900, 0, 320], [0, 900, 240], [0, 0, 1]]
        assert (found.distortion is None) == (not entry.fisheye), model
