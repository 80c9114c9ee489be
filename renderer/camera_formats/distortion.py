"""The distortion that a file gives a lens, and how far it moves what an image shows."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from renderer.camera import Size
from renderer.camera_checks import Floats
from renderer.camera_formats.posed import Distortion
from renderer.errors import LucidaError
from renderer.intrinsics import pixel_offset
from renderer.lenses import Lens

# OpenCV's coefficients, in the order of its vectors; a fisheye has k1 to k4.
NAMES = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY")
COUNTS = (4, 5, 8, 12, 14)  # allowed lengths of a vector
FISHEYE_NAMES = ("k1", "k2", "k3", "k4")
_GRID = 33  # points a side, over the image from edge to edge


def distortion(
    name: str,
    model: str,
    coefficients: Mapping[str, float],
    K: Floats,
    size: Size,
    pixel_origin: str = "corner",
) -> Distortion | None:
    """Return an image's distortion; None if there is none. A fisheye distorts even if its
    coefficients are all 0.

    name: the file's for the lens. model: of Lens. coefficients: by the file's names. K: (3, 3).
    Raises LucidaError for a tilted sensor, which Lens does not have.
    """
    if model == "brown" and not any(coefficients.values()):
        return None  # return early: there may be 100,000 frames
    for tilt in NAMES[-2:]:
        if coefficients.get(tilt):
            problem = f"{coefficients[tilt]:g} is a tilted sensor's, which is not supported"
            raise LucidaError(tilt, problem, "calibrate without CALIB_TILTED_MODEL")
    known = {
        "k1" if name == "k" else name: value
        for name, value in coefficients.items()
        if name not in NAMES[-2:]
    }
    if model == "fov" and not known["omega"]:
        return None
    lens = Lens(model, known)
    columns, rows = np.meshgrid(*(np.linspace(0, side, _GRID) for side in size))
    offset = pixel_offset(pixel_origin)
    pixels = np.stack([columns - offset, rows - offset, np.ones_like(rows)])
    x, y, scale = np.tensordot(np.linalg.inv(K), pixels, 1)
    a, b = lens.image_point(x, y, scale)
    with np.errstate(invalid="ignore", over="ignore"):
        moved = np.stack([a - x / scale, b - y / scale])
        shift = np.hypot(*np.tensordot(K[:2, :2] / K[2, 2], moved, 1))
    seen = shift[np.isfinite(shift)]
    median, largest = (float(np.median(seen)), float(seen.max())) if seen.size else (0.0, 0.0)
    return Distortion(name, dict(coefficients), lens, median, largest)
