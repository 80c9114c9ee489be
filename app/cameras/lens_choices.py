"""The lens models: their names, formulas and usual ranges of coefficients; and presets, which also
set the viewport.

Pure. Source: the presets' coefficients are as large as in calibrations of such cameras.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.camera.navigation import switched_projection

NO_LENS = "none: a pinhole"


@dataclass(frozen=True)
class Kind:
    """A model. name: the photographers' term. note: a description. latex: its formula."""

    name: str
    note: str
    latex: str


RADIUS = """\
r' is a point's distance from the middle of the image, in units of d.
theta is the angle between its direction and the view axis.
r = tan(theta) is that distance in a pinhole's image."""
PANORAMA = """\
a' and b' are a point's distances to the right and downwards in the image, in units of d.
Longitude and latitude are the angles of its direction, in radians, from the view axis."""
KINDS = {
    "brown": Kind(
        "Photographic lens",
        "Brown: barrel and pincushion distortion by k, off-centre parts by p (tangential).\n"
        "The usual model of calibrations (OpenCV, COLMAP). Files may also hold s (thin prism).",
        r"r' = r\,\frac{1 + k_1 r^2 + k_2 r^4 + k_3 r^6}{1 + k_4 r^2 + k_5 r^4 + k_6 r^6},"
        r"\quad r = \tan\theta",
    ),
    "fisheye": Kind(
        "Fisheye lens",
        "Kannala and Brandt: a fisheye with a distortion of its own (OpenCV's fisheye model).",
        r"r' = \theta\,(1 + k_1 \theta^2 + k_2 \theta^4 + k_3 \theta^6 + k_4 \theta^8)",
    ),
    "fov": Kind(
        "Wide-angle lens (FOV)",
        "Devernay and Faugeras: one number, omega, in radians: the angle that the lens sees.",
        r"r' = \frac{1}{\omega} \arctan(2\,\tan\theta\,\tan\frac{\omega}{2})",
    ),
    "thin_prism_fisheye": Kind(
        "Fisheye lens, thin prism",
        "COLMAP's thin prism fisheye: the angle theta is distorted as a photographic lens does it.",
        r"r' = \theta\,(1 + k_1 \theta^2 + k_2 \theta^4 + k_3 \theta^6 + k_4 \theta^8) + \ldots",
    ),
    "equidistant": Kind(
        "Fisheye, equidistant",
        "Equal angles are equally far apart in the image.",
        r"r' = \theta",
    ),
    "stereographic": Kind(
        "Fisheye, stereographic",
        "Small shapes keep their shape: circles stay circles.",
        r"r' = 2\,\tan\frac{\theta}{2}",
    ),
    "equisolid": Kind(
        "Fisheye, equal area",
        "Equisolid angle: equal solid angles have equal areas in the image.",
        r"r' = 2\,\sin\frac{\theta}{2}",
    ),
    "orthographic": Kind(
        "Fisheye, orthographic",
        "The hemisphere in front, as a globe looks from afar. It ends at 90 degrees.",
        r"r' = \sin\theta",
    ),
    "equirectangular": Kind(
        "Panorama, 360 degrees",
        "Equirectangular: across is longitude, upwards is latitude, as on a map of the world.",
        r"a' = \mathrm{longitude},\quad b' = \mathrm{latitude}",
    ),
    "cylindrical": Kind(
        "Panorama, cylindrical",
        "Across is longitude; upright lines stay straight.",
        r"a' = \mathrm{longitude},\quad b' = \tan(\mathrm{latitude})",
    ),
}


def of_model(model: str) -> Lens:
    """Return the lens of a model, without distortion."""
    return Lens(model, {"omega": 1.0} if model == "fov" else {})


def with_lens(camera: Camera, lens: Lens | None, focus: Vector) -> Camera:
    """Return the camera with another lens; parallel rays become perspective first (see
    switched_projection).
    """
    if lens is not None and camera.is_parallel:
        camera = switched_projection(camera, focus)
    return replace(camera, lens=lens)


@dataclass(frozen=True)
class LensPreset:
    """A lens with the distance of its viewport, which is 1 high and as wide as the image.

    panorama: True if the viewport is all of the lens's 2 pi by pi.
    """

    name: str
    lens: Lens
    distance: float = 1.0
    panorama: bool = False

    def of(self, camera: Camera, aspect: float) -> Camera:
        """Return the camera with this lens: eye and basis stay. aspect: the image's ratio."""
        half = (math.pi, math.pi / 2) if self.panorama else (aspect / 2, 0.5)
        return replace(
            camera,
            projection="perspective",
            distance=self.distance,
            viewport=(-half[0], half[0], -half[1], half[1]),
            lens=self.lens,
        )


LENS_PRESETS = (
    LensPreset(
        "Barrel",
        Lens("brown", {"k1": -0.25, "k2": 0.06}),
    ),
    LensPreset(
        "Pincushion",
        Lens("brown", {"k1": 0.25}),
    ),
    LensPreset(
        "Phone",
        Lens("brown", {"k1": 0.12, "k2": -0.28, "p1": 0.001, "p2": -0.001, "k3": 0.17}),
    ),
    LensPreset(
        "Action cam",
        Lens("fisheye", {"k1": 0.04, "k2": 0.03, "k3": -0.05, "k4": 0.02}),
        0.72,
    ),
    LensPreset(
        "190 degrees",
        Lens("fisheye", {"k4": -0.00195}),
        0.325,
    ),
    LensPreset(
        "360 degrees",
        Lens("equirectangular"),
        panorama=True,
    ),
)
