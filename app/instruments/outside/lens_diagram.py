"""A lens in a camera's diagram: curves where a pinhole has straight lines, and what it does to a
pixel. Pure.
"""

from __future__ import annotations

import numpy as np

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .diagram import Dot, Item, Label, Segments, line, polyline
from .frustum import border, ideal_point, image_point, meets_plane
from .pixel_drawing import pixel_square

APART_PX = 22.0  # a pixel and its ideal point are named if they are farther apart on the screen
OUTSIDE = "outside of the lens"


def ideal_border(camera: Camera) -> Segments:
    """Return where the rays along the border meet the image plane."""
    places = ideal_point(camera, *border(camera).T)
    edges = polyline(places[np.isfinite(places).all(axis=1)], True)
    return Segments("ideal border", "volume", edges, 1.8, on_plane=True)


def lens_pixel(camera: Camera, size: Size, pixel: Pixel) -> list[Item]:
    """Return the way from where a pixel is in the image to where its ray meets the image plane, if
    it does. A pixel outside of the lens is only named so.
    """
    x, y = camera.image_point(*pixel, size)
    distorted = image_point(camera, x, y)
    if not np.isfinite(camera.direction(x, y)).all():
        middle = image_point(camera, *camera.image_point(size[1] / 2, size[0] / 2, size))
        return [
            *pixel_square(camera, size, pixel),
            Label("outside", "mark", OUTSIDE, distorted, away=middle),
        ]
    if not meets_plane(camera):
        return []
    ideal = ideal_point(camera, x, y)
    return [
        line("lens", "mark", distorted, ideal, 2.2, on_plane=True, layer=4),
        Dot("ideal", "ray", ideal, 4.0, on_plane=True, layer=5),
        Label("distorted", "mark", "(a', b')", distorted, away=ideal, least=APART_PX),
        Label("ideal", "ray", "(a, b)", ideal, away=distorted, least=APART_PX),
    ]
