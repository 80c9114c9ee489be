"""A second camera in the outside view, dashed: that of a student's program.

The module draws its frustum, first pixel and ray. The camera is defined by rays, not by a Camera,
because a wrong program's rays may belong to no camera at all, such as one with a singular basis.
Pure.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lucida.renderer.camera.checks import Floats

from .diagram import Dot, Face, Item, Label, RayEnd, Role, Segments, line, polyline

SAME = 1e-6  # times the reach: origins that are nearer to one another are one eye
ROLE: Role = "other"


@dataclass(frozen=True, eq=False)
class GivenRay:
    """A ray of a program.

    origin, direction: (3,). t: the t of its hit; inf if it hits nothing, None if that is not known.
    """

    origin: Floats
    direction: Floats
    t: float | None = None


def corner_rays(origins: Floats, directions: Floats) -> tuple[Floats, Floats]:
    """Return the origins and directions (4, 3) of the corner pixels' rays: upper left, upper right,
    lower right, lower left in that camera's image.

    origins, directions: (H, W, 3).
    """
    rows, columns = [0, 0, -1, -1], [0, -1, -1, 0]
    return origins[rows, columns], directions[rows, columns]


def second_camera(
    origins: Floats, directions: Floats, reach: float, name: str, first: str
) -> list[Item]:
    """Return a camera's drawing if its rays are finite.

    origins, directions: from corner_rays(). reach: the length of the drawn rays, world units.
    name: the camera's label. first: the label of its first pixel.
    """
    length = np.linalg.norm(directions, axis=1).mean()
    if not np.isfinite(origins).all() or not np.isfinite(length) or length == 0:
        return []
    ends = origins + reach / length * directions
    middle = origins.mean(axis=0)
    has_eye = bool(np.abs(origins - middle).max() <= SAME * reach)
    plane = origins + directions if has_eye else origins
    items: list[Item] = [
        Face(f"second side {k}", ROLE, np.array([origins[k], ends[k], ends[n], origins[n]]), 0.06)
        for k, n in enumerate((1, 2, 3, 0))
    ]
    items += [
        Segments(
            "second edges", ROLE, np.stack([origins, ends], axis=1), 1.8, dashed=True, layer=2
        ),
        Segments("second end", ROLE, polyline(ends, True), 1.0, 0.7, 0.3, dashed=True, layer=2),
        Segments("second image plane", ROLE, polyline(plane, True), 2.4, dashed=True, layer=2),
        Dot("second first pixel", ROLE, plane[0], 5.0),
        Label("second first pixel", ROLE, first, plane[0], away=plane.mean(axis=0)),
        Label("second name", ROLE, name, plane[2], away=plane.mean(axis=0)),
    ]
    if has_eye:
        items.append(Dot("second eye", ROLE, middle, 7.0))
    return items


def second_ray(ray: GivenRay, reach: float) -> list[Item]:
    """Return the ray to its hit, or with the length `reach`; nothing if it has no direction."""
    length = float(np.linalg.norm(ray.direction))
    if not np.isfinite(ray.origin).all() or not np.isfinite(length) or length == 0:
        return []
    end = RayEnd((0, 0), ray.t)
    reached = ray.origin + end.t_or(reach / length) * ray.direction
    look = {"hidden": 0.6, "dashed": True, "layer": 3}
    items: list[Item] = [line("second ray", ROLE, ray.origin, reached, 3.2, **look)]
    if end.is_hit:
        items.append(Dot("second hit", ROLE, reached, 6.0))
    return items
