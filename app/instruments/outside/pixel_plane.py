"""K in the outside view: the image plane as pixels, with the focal length and the principal point.
Pure.
"""

from __future__ import annotations

import math

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin

from .diagram import Arrow, Dot, Item, Label, line
from .frustum import image_point, plane_corners

MOST_TICKS = 32  # per side


def pixel_items(camera: Camera, size: Size, origin: PixelOrigin) -> tuple[Item, ...]:
    """Return the focal length, the principal point, the pixels' coordinates and the corners, or
    nothing for a parallel camera.

    camera: the camera, fitted to its image of `size`. origin: the point of a pixel that has whole
    coordinates.
    """
    if camera.is_parallel:
        return ()
    K = camera.intrinsics(size, origin).K
    fx, fy, cx, cy = (float(K[at]) for at in ((0, 0), (1, 1), (0, 2), (1, 2)))
    back = 0.5 if origin == "corner" else 0.0
    eye, point = np.asarray(camera.eye), image_point(camera, 0.0, 0.0)
    last = [side - 1 + round(2 * back) for side in size]

    def at(x: float, y: float) -> Floats:
        return image_point(camera, *camera.image_point(y - back, x - back, size))

    same = math.isclose(fx, fy, rel_tol=1e-4)
    focal = f"f = {fx:.4g}" if same else f"f = ({fx:.4g}, {fy:.4g})"
    first, corners = at(0, 0), plane_corners(camera)
    items: list[Item] = [
        line("axis", "w", eye, point, 2.0, dashed=True, layer=2),
        Label("focal length", "w", focal, (eye + point) / 2),
        Dot("principal point", "extra", point, 7.0, layer=5),
        Label("principal point", "extra", f"c = ({cx:.4g}, {cy:.4g})", point),
        Label("pixel 0", "other", "(0, 0)", first, away=at(1, 1)),
    ]
    for name, end, step in (("j", at(last[0], 0), (1, 0)), ("i", at(0, last[1]), (0, 1))):
        count = last[step[1]]
        items += [
            Arrow(name, "other", first, end + 0.5 * (at(*step) - first), 2.0, 11.0),
            Label(name, "other", name, end + 0.5 * (at(*step) - first), away=first),
        ]
        if count <= MOST_TICKS:
            items += [
                Dot(name, "other", at(k * step[0], k * step[1]), 3.2) for k in range(count + 1)
            ]
    return (*items, *(Dot("corner", "plane", corner, 5.0) for corner in corners))
