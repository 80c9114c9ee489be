"""A lens's effect on a pixel, in a camera's diagram. Pure."""

from __future__ import annotations

import math

import numpy as np

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .diagram import Dot, Item, Label, line
from .frustum import directions, image_point, point_at
from .pixel_drawing import pixel_square

APART_PX = 22.0  # a pixel and its ideal point are named if they are farther apart on the screen
STEEPEST_DEG = 80.0  # steeper rays meet the image plane too far from the axis
OUTSIDE = "outside of the lens"


def lens_pixel(camera: Camera, size: Size, pixel: Pixel) -> list[Item]:
    """Return the line from a pixel's place in the image to the point where its ray meets the image
    plane, if it does. A pixel outside the lens gets only a label.
    """
    x, y = camera.image_point(*pixel, size)
    distorted, along, w = image_point(camera, x, y), directions(camera, x, y), np.asarray(camera.w)
    if not np.isfinite(along).all():
        middle = image_point(camera, *camera.image_point(size[1] / 2, size[0] / 2, size))
        return [
            *pixel_square(camera, size, pixel),
            Label("outside", "mark", OUTSIDE, distorted, away=middle),
        ]
    cosine = -(along @ w) / (np.linalg.norm(along) * np.linalg.norm(w))
    if cosine < math.cos(math.radians(STEEPEST_DEG)):
        return []
    ahead = -along @ camera.camera_from_world[2, :3]  # in lengths of w
    ideal = point_at(camera, x, y, camera.distance / ahead)
    return [
        line("lens", "mark", distorted, ideal, 2.2, on_plane=True, layer=4),
        Dot("ideal", "ray", ideal, 4.0, on_plane=True, layer=5),
        Label("distorted", "mark", "(a', b')", distorted, away=ideal, least=APART_PX),
        Label("ideal", "ray", "(a, b)", ideal, away=distorted, least=APART_PX),
    ]
