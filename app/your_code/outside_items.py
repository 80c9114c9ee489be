"""An answer in the outside view: the student's camera, and the marked pixel's rays.

Pure. second_camera.py draws it.
"""

from __future__ import annotations

import numpy as np

from app.outside.diagram import Item, Segments
from app.outside.second_camera import GivenRay, SecondCamera, corner_rays, second_camera
from app.state.options import Pixel
from app.your_code.model import CodeRays


def outside_items(rays: CodeRays, marked: Pixel | None, end: float, first: str) -> list[Item]:
    """Return an answer's drawing for the outside view.

    end: the ray parameter at which the scene ends. first: the name of the first pixel.
    """
    camera = rays.camera
    middle = (rays.size[1] - 1) / 2, (rays.size[0] - 1) / 2
    reach = end * float(np.linalg.norm(camera.ray(*middle, rays.size).direction))
    items: list[Item] = []
    if marked is not None:
        way = np.stack([rays.right_origins[marked], end * rays.right_directions[marked]])
        way[1] += way[0]
        items.append(Segments("right ray", "ray", way[None], 2.5, layer=3))
    if rays.wrong.any():
        given = None
        if marked is not None and rays.came[marked]:
            given = GivenRay(rays.origins[marked], rays.directions[marked])
        corners = corner_rays(rays.origins, rays.directions)
        items += second_camera(SecondCamera(*corners, given, "yours", first), reach)
    return items
