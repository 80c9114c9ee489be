"""A file's lens."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.system.errors import LucidaError

# OpenCV's coefficients, in the order of its vectors; a fisheye has k1 to k4.
NAMES = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY")
COUNTS = (4, 5, 8, 12, 14)  # allowed lengths of a vector
FISHEYE_NAMES = ("k1", "k2", "k3", "k4")


def lens_of(model: str, coefficients: Mapping[str, float]) -> Lens | None:
    """Return a lens without the coefficients that are 0, None for a pinhole. A fisheye is a lens
    even if all are 0.

    model: of Lens. Raises LucidaError for a tilted sensor, which Lens does not have.
    """
    for tilt in NAMES[-2:]:
        if coefficients.get(tilt):
            problem = f"{coefficients[tilt]:g} is a tilted sensor's, which is not supported"
            raise LucidaError(tilt, problem, "calibrate without CALIB_TILTED_MODEL")
    known = {name: value for name, value in coefficients.items() if value}
    return Lens(model, known) if known or model not in ("brown", "fov") else None


def check_held(camera: Camera, models: Collection[str], target: str) -> None:
    """Raise LucidaError if a camera has a lens of another model."""
    lens = camera.lens
    if lens is not None and lens.model not in models:
        problem = f"{lens.model} is a lens that {target} cannot hold"
        remedy = "remove it: Camera > Lens > No lens, --lens none, or lucida camera --no-lens"
        raise LucidaError("lens", problem, remedy)
