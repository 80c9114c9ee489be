"""A lens in a camera's diagram: curves where a pinhole has straight lines, and what it does to a
pixel. Pure.
"""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.outside.diagram import Dot, Face, Item, Label, Segments, polyline
from lucida.app.instruments.outside.frustum import (
    border,
    grid,
    has_plane,
    ideal_point,
    image_point,
    pixel_corners,
    point_at,
)
from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size

EDGES = 8  # rays along the border that stand for the edges of a pyramid
SIDE_PARTS = 6  # faces for a side of the view volume
SPHERE_PARTS = 12  # of a side of the image on a sphere, between its lines
APART_PX = 22.0  # a pixel and its ideal point are named if they are farther apart on the screen
OUTSIDE = "outside of the lens"


def lens_volume(camera: Camera, end: float) -> list[Item]:
    """Return what the lens sees, from near to far, or to the end of the scene: rays along its
    border, and the border's curves.
    """
    near, far = camera.t_range
    last = far if np.isfinite(far) else max(end, 1.5 * near)
    ends = _at(camera, border(camera, SIDE_PARTS), near, last)
    corners = np.stack([ends, np.roll(ends, -1, axis=0)[:, ::-1]], axis=1).reshape(-1, 4, 3)
    items: list[Item] = [Face(f"side {k}", "volume", ring, 0.055) for k, ring in enumerate(corners)]
    edges = _at(camera, border(camera, EDGES // 4), near, last)
    first, back = _at(camera, border(camera), near, last).swapaxes(0, 1)
    if near > 0:
        before = np.stack([np.broadcast_to(camera.eye, edges[:, 0].shape), edges[:, 0]], axis=1)
        items.append(Segments("before near", "volume", before, 1.0, 0.55, 0.2, dashed=True))
        items += _named_curve("near", first)
    items.append(Segments("edges", "volume", edges, 1.4, 0.8))
    if np.isfinite(far):
        return items + _named_curve("far", back)
    items.append(Segments("end", "volume", polyline(back, True), 1.0, 0.6, 0.25, dashed=True))
    return items


def _at(camera: Camera, places: Floats, near: float, last: float) -> Floats:
    """Return the part (n, 2, 3) of the rays through (x, y) that is drawn, of those that exist."""
    x, y = places.T[..., None]
    found = point_at(camera, x, y, [max(near, 0.0), last])
    return found[np.isfinite(found).all(axis=(1, 2))]


def _named_curve(name: str, points: Floats) -> list[Item]:
    return [
        Segments(name, "volume", polyline(points, True), 1.75),
        Label(name, "text", name, points[len(points) // 4], away=points[0]),
    ]


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
        corners = pixel_corners(camera, pixel, size)
        return [
            Segments("pixel", "mark", polyline(corners, True), 1.6, on_plane=True, layer=3),
            Label("outside", "mark", OUTSIDE, distorted, away=middle),
        ]
    if not has_plane(camera):
        return []
    way = np.array([[distorted, ideal]])
    return [
        Segments("lens", "mark", way, 2.2, on_plane=True, layer=4),
        Dot("ideal", "ray", ideal, 4.0, on_plane=True, layer=5),
        Label("distorted", "mark", "(a', b')", distorted, away=ideal, least=APART_PX),
        Label("ideal", "ray", "(a, b)", ideal, away=distorted, least=APART_PX),
    ]
