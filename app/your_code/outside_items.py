"""What the outside view shows of an answer: the camera that was written, the marked pixel's rays.

Pure. Its looks are second_camera.py's.
"""

from __future__ import annotations

import numpy as np

from app.outside.diagram import Item, Segments
from app.outside.second_camera import GivenRay, SecondCamera, corner_rays, second_camera
from app.state.options import Pixel
from app.your_code.model import CodeRays


def outside_items(rays: CodeRays, marked: Pixel | None, end: float, first: str) -> list[Item]:
    """What the outside view shows of an answer. end: the ray parameter at which the scene ends.
    first: what the first pixel is called."""
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
