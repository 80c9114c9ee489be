"""An answer in the outside view: the student's camera, and rays of one pixel.

Pure. outside/second_camera.py and outside/answers.py draw it.
"""

from __future__ import annotations

import numpy as np

from lucida.app.checking.your_code.model import CodeRays
from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Item
from lucida.app.instruments.outside.second_camera import (
    GivenRay,
    corner_rays,
    second_camera,
)
from lucida.app.state.options.shared import Pixel


def outside_items(rays: CodeRays, marked: Pixel | None, end: float, first: str) -> list[Item]:
    """Return a wrong answer's drawing for the outside view. Without a mark, the rays are those of
    the first wrong pixel.

    end: the ray parameter at which the scene ends. first: the name of the first pixel.
    """
    camera = rays.camera
    middle = (rays.size[1] - 1) / 2, (rays.size[0] - 1) / 2
    reach = end * float(np.linalg.norm(camera.ray(*middle, rays.size).direction))
    corners = corner_rays(rays.given[..., 0, :], rays.given[..., 1, :])
    items = second_camera(*corners, reach, "yours", first)
    pixel = marked if marked is not None else tuple(np.argwhere(rays.wrong)[0].tolist())
    if rays.came[pixel]:
        items += answers.ray(GivenRay(*rays.given[pixel]), GivenRay(*rays.right[pixel]), reach)
    return items
