"""An answer in the outside view: the student's camera, basis, and rays of one pixel.

Pure. outside/second_camera.py and outside/answers.py draw it.
"""

from __future__ import annotations

import numpy as np

from lucida.app.checking.your_code.model import BASIS, CodeRays
from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Item, Role, Segments, in_notation
from lucida.app.instruments.outside.second_camera import (
    GivenRay,
    SecondCamera,
    corner_rays,
    second_camera,
)
from lucida.app.state.options.shared import Notation, Pixel

SAME = 1e-5  # vectors that differ less look the same


def outside_items(
    rays: CodeRays, marked: Pixel | None, end: float, first: str, notation: Notation
) -> list[Item]:
    """Return an answer's drawing for the outside view. Without a mark, the rays are those of the
    first wrong pixel.

    end: the ray parameter at which the scene ends. first: the name of the first pixel.
    """
    camera = rays.camera
    middle = (rays.size[1] - 1) / 2, (rays.size[0] - 1) / 2
    reach = end * float(np.linalg.norm(camera.ray(*middle, rays.size).direction))
    items: list[Item] = []
    if not rays.wrong.any():
        if marked is not None:
            start, way = rays.right_origins[marked], end * rays.right_directions[marked]
            items.append(
                Segments("right ray", "ray", np.array([[start, start + way]]), 2.5, layer=3)
            )
        return in_notation(items, notation)
    corners = corner_rays(rays.origins, rays.directions)
    name = "" if rays.task.kind == BASIS else "yours"  # a basis has its vectors' names
    items += second_camera(SecondCamera(*corners, None, name, first), reach)
    if rays.task.kind == BASIS:
        given, correct = rays.given[0], rays.cases[0].right
        for number, name in enumerate(("u", "v", "w")):
            if not np.allclose(given[number], correct[number], atol=SAME):
                role: Role = name  # type: ignore[assignment]
                items += answers.vector(name, role, camera.eye, given[number], correct[number])
    pixel = marked if marked is not None else tuple(np.argwhere(rays.wrong)[0].tolist())
    if rays.came[pixel]:
        given_ray = GivenRay(rays.origins[pixel], rays.directions[pixel])
        right = GivenRay(rays.right_origins[pixel], rays.right_directions[pixel])
        items += answers.ray(given_ray, right, reach)
    return in_notation(items, notation)
