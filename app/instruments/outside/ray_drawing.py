"""Drawings of viewing rays that a lecture builds up: a half-line, its hits with objects, rays
to points of the scene. Pure.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lucida.app.state.options.outside import Point
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.explaining.notation import number
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .diagram import Dot, Item, Label, Role, Segments, line, named_dot, shares, term
from .frustum import on_ray, plane_parameter, point_at

BEFORE, LAST = -1.2, 4.0  # the least and the largest t of a line's drawing
NAMED = 2.5  # the t at which the line's formula is written
TICKS = (1.0, 2.0, 3.0)
PALE = 0.35
WIDTH = 3.0


def half_line(camera: Camera, size: Size, pixel: Pixel, grown: float) -> list[Item]:
    """Return a pixel's ray as a half-line.

    grown: the number of complete parts: p, d, the whole line, and the fading of t < 0.
    """
    begun, ahead, whole, faded = shares(grown, 4)
    t = [BEFORE, 0.0, LAST, NAMED, *TICKS]
    before, origin, far, named, *ticks = on_ray(camera, pixel, size, t)
    if not np.isfinite(before).all() or not begun:
        return []
    up = camera.basis[:, 1]

    items = named_dot("p", "ray", "vec(p)", origin, origin + up, 6.0 * begun, layer=5)
    if ahead:
        items += term("d", "ray", "vec(d)", origin, origin + ahead * (ticks[0] - origin), -up)
    if whole:
        fades = 1 - (1 - PALE) * faded
        for name, end, pale in (("line", far, 1.0), ("t < 0", before, fades)):
            look = {"opacity": pale, "hidden": 0.6 * pale, "dashed": pale < 1, "layer": 3}
            reached = origin + whole * (end - origin)
            items.append(line(name, "ray", origin, reached, WIDTH * pale, **look))
    if whole == 1:
        for one, at in zip(TICKS, ticks, strict=True):
            items += named_dot(f"t = {one:g}", "ray", f"t = {one:g}", at, at + up, 5.0, layer=5)
        formula = "vec(r)(t) = vec(p) + t vec(d)"
        items.append(Label("line", "ray", formula, named, away=named - up, strong=True))
    if faded == 1:
        items.append(Label("t < 0", "ray", "t < 0", before, away=before + up, strong=True))
    return items


def meetings(
    camera: Camera, size: Size, pixel: Pixel, found: Sequence[float], end: float, grown: float
) -> list[Item]:
    """Return a pixel's ray through all objects that its line meets, each with its t.

    found: the t of all intersections, some of which may be negative. grown: 1 once all of them have
    appeared; 2 once the least t > 0 is highlighted and the ray ends there.
    """
    appeared, lit = shares(grown, 2)
    least, first = min((t for t in found if t > 0), default=end), min([*found, 0.0])
    origin, reached, far, back = on_ray(camera, pixel, size, [0.0, least, end, first])
    if not np.isfinite(far).all():
        return []
    fades = 1 - (1 - PALE) * lit
    items: list[Item] = [
        line("ray", "ray", origin, reached, WIDTH, hidden=0.6, layer=3),
        line("beyond", "ray", reached, far, WIDTH * fades, opacity=fades, hidden=fades * 0.6,
             dashed=lit > 0, layer=2),
    ]  # fmt: skip
    if first < 0:
        pale = {"opacity": PALE, "hidden": PALE}
        items.append(line("t < 0", "ray", back, origin, 1.6, dashed=True, layer=2, **pale))
    for order, t in enumerate(sorted(found)):
        shown = min(max(appeared * len(found) - order, 0.0), 1.0)
        if not shown:
            continue
        point, wins = on_ray(camera, pixel, size, [t])[0], lit > 0 and t == least
        role: Role = "mark" if wins or not lit else "text"
        radius, name = (6.0 + 3.0 * lit * wins) * shown, f"t = {number(round(t, 2))}"
        away = point - camera.basis[:, 1]
        items += named_dot(name, role, name, point, away, radius, layer=5 + wins, hidden=1.0)
    return items


def rays_to(camera: Camera, points: Sequence[Point], grown: float, reach: float) -> list[Item]:
    """Return the viewing rays of points of the world, and where they pass the image plane.

    grown: 1 once the rays have reached their points; 2 once the dots are on the image plane, too.
    reach: the length of a parallel ray behind the image plane, world units.
    """
    rays, dots = shares(grown, 2)
    if not (points and rays):
        return []
    matrix = camera.camera_from_world
    x, y, z = (np.asarray(points, float) @ matrix[:3, :3].T + matrix[:3, 3]).T
    if camera.is_parallel:
        ends, starts = -z, np.full(len(z), -reach / float(np.linalg.norm(camera.w)))
    else:
        x, y = x * camera.distance / -z, y * camera.distance / -z
        ends, starts = -z / camera.distance, np.zeros(len(z))
    plane, reached = plane_parameter(camera), starts + rays * (ends - starts)
    start, through, end = (
        point_at(camera, x, y, t) for t in (starts, np.minimum(plane, reached), reached)
    )
    before, after = np.stack([start, through], axis=1), np.stack([through, end], axis=1)
    items: list[Item] = [
        Segments("rays before", "ray", before, 2.2, 0.8, 0.4, layer=2),
        Segments("rays", "ray", after, 2.6, 1.0, 0.5, layer=2),
    ]
    if rays == 1:
        items += [Dot("point", "mark", np.array(one), 4.0, layer=3) for one in points]
    if dots:
        on_plane = point_at(camera, x, y, np.full(len(x), plane))
        items += [Dot("on plane", "mark", one, 5.5 * dots, on_plane=True, layer=5)
                  for one in on_plane]  # fmt: skip
    return items
