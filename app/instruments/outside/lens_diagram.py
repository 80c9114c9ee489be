"""A lens in a camera's diagram: curves where a pinhole has straight lines, and what it does to a
pixel. Pure.
"""

from __future__ import annotations

import numpy as np

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .diagram import Dot, Item, Label, Segments, line, polyline
from .frustum import (
    border,
    grid,
    has_plane,
    ideal_point,
    image_point,
)
from .pixel_drawing import pixel_square

SPHERE_PARTS = 12  # of a side of the image on a sphere, between its lines
APART_PX = 22.0  # a pixel and its ideal point are named if they are farther apart on the screen
OUTSIDE = "outside of the lens"


def ideal_border(camera: Camera) -> Segments:
    """Return where the rays along the border meet the image plane."""
    places = ideal_point(camera, *border(camera).T)
    edges = polyline(places[np.isfinite(places).all(axis=1)], True)
    return Segments("ideal border", "volume", edges, 1.8, on_plane=True)


def image_sphere(camera: Camera, size: Size) -> list[Item]:
    """Return the part of the sphere that the image is on: its border and some of its grid."""
    places = image_point(camera, *border(camera).T)
    edges = polyline(places[np.isfinite(places).all(axis=1)], True)
    lines = grid(camera, size, SPHERE_PARTS)
    return [
        Segments("image sphere", "plane", edges, 2.4),
        Segments("sphere", "plane", lines, 1.0, 0.55, 0.2),
    ]


def lens_pixel(camera: Camera, size: Size, pixel: Pixel) -> list[Item]:
    """Return the way from where a pixel is in the image to where its ray meets the image plane.

    A pixel outside of the lens is only named so.
    """
    x, y = camera.image_point(*pixel, size)
    distorted, ideal = image_point(camera, x, y), ideal_point(camera, x, y)
    middle = image_point(camera, *camera.image_point(size[1] / 2, size[0] / 2, size))
    if not np.isfinite(ideal).all():
        if not np.isfinite(distorted).all():
            return []
        return [
            *pixel_square(camera, size, pixel),
            Label("outside", "mark", OUTSIDE, distorted, away=middle),
        ]
    if not has_plane(camera):
        return []
    return [
        line("lens", "mark", distorted, ideal, 2.2, on_plane=True, layer=4),
        Dot("ideal", "ray", ideal, 4.0, on_plane=True, layer=5),
        Label("distorted", "mark", "(a', b')", distorted, away=ideal, least=APART_PX),
        Label("ideal", "ray", "(a, b)", ideal, away=distorted, least=APART_PX),
    ]
