"""Drawings of viewing rays that a lecture builds up: half a line, its meetings with objects, rays
to points of the scene. Pure.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from lucida.app.instruments.outside.diagram import Arrow, Dot, Item, Label, Segments, in_notation
from lucida.app.instruments.outside.frustum import plane_parameter, point_at
from lucida.app.state.options.outside import Point
from lucida.app.state.options.shared import Notation, Pixel
from lucida.app.ui.explaining.notation import number
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size

BEFORE, LAST = -1.2, 4.0  # the least and the largest t that is drawn of a line
NAMED = 2.5  # the t at which the line's formula is written
TICKS = (1.0, 2.0, 3.0)
PALE = 0.35
WIDTH = 3.0


def half_line(
    camera: Camera,
    size: Size,
    pixel: Pixel,
    grown: float,
    pointed: float | None,
    notation: Notation,
) -> list[Item]:
    """Return a pixel's ray as half a line.

    grown: the number of complete parts: p, d, the whole line, and the fading of t < 0. pointed: the
    t under the mouse.
    """
    share = _shares(grown, 4)
    before, origin, far, named, *ticks = _on_ray(
        camera, pixel, size, [BEFORE, 0.0, LAST, NAMED, *TICKS]
    )
    if not np.isfinite(before).all() or not share[0]:
        return []
    aside = origin + np.asarray(camera.v)
    above = named + np.asarray(camera.v)
    items: list[Item] = [
        Dot("t = 0", "ray", origin, 6.0 * share[0], layer=5),
        Label("p", "ray", "vec(p)", origin, away=aside + ticks[0] - origin, strong=True),
    ]
    if share[1]:
        tip = origin + share[1] * (ticks[0] - origin)
        items += [
            Arrow("d", "ray", origin, tip, 4.2, layer=4),
            Label(
                "d",
                "ray",
                "vec(d)",
                (origin + tip) / 2,
                away=aside,
                strong=True,
                least=20.0,
                line=np.array([origin, tip]),
            ),
        ]
    if share[2]:
        ahead = origin + share[2] * (far - origin)
        behind = origin + share[2] * (before - origin)
        fades = 1 - (1 - PALE) * share[3]
        items += [
            Segments("line", "ray", np.array([[origin, ahead]]), WIDTH, hidden=0.6, layer=3),
            Segments("t < 0", "ray", np.array([[behind, origin]]), WIDTH * fades, fades,
                     fades * 0.6, dashed=share[3] > 0, layer=3),
        ]  # fmt: skip
        if share[2] == 1:
            items += _ticks(ticks, aside - origin)
            formula = "vec(r)(t) = vec(p) + t vec(d)"
            items.append(Label("line", "ray", formula, named, away=2 * named - above, strong=True))
    if share[3] == 1:
        items.append(Label("t < 0", "ray", "t < 0", before, away=before + camera.v, strong=True))
    if pointed is not None and share[2] == 1 and (pointed > 0 or not share[3]):
        at = _on_ray(camera, pixel, size, [pointed])[0]
        items += [
            Dot("pointed", "mark", at, 7.0, layer=6),
            Label("pointed", "mark", f"t = {pointed:.2f}", at, away=aside, strong=True),
        ]
    return in_notation(items, notation)


def _ticks(points: Sequence[Floats], up: Floats) -> Iterator[Item]:
    for t, point in zip(TICKS, points, strict=True):
        yield Dot(f"t = {t:g}", "ray", point, 5.0, layer=5)
        yield Label(f"t = {t:g}", "ray", f"t = {t:g}", point, away=point + up, strong=True)


def meetings(
    camera: Camera, size: Size, pixel: Pixel, found: Sequence[float], end: float, grown: float
) -> list[Item]:
    """Return a pixel's ray through all objects that its line meets, each with its t.

    found: the t of all meetings, of which some may be negative. grown: 1: all of them have
    appeared; 2: the least t > 0 is lit, and the ray ends there.
    """
    share = _shares(grown, 2)
    ahead = [t for t in found if t > 0]
    least = min(ahead, default=end)
    first = min([*found, 0.0])
    origin, reached, far, back = _on_ray(camera, pixel, size, [0.0, least, end, first])
    if not np.isfinite(far).all():
        return []
    fades = 1 - (1 - PALE) * share[1]
    items: list[Item] = [
        Segments("ray", "ray", np.array([[origin, reached]]), WIDTH, hidden=0.6, layer=3),
        Segments("beyond", "ray", np.array([[reached, far]]), WIDTH * fades, fades, fades * 0.6,
                 dashed=share[1] > 0, layer=2),
    ]  # fmt: skip
    if first < 0:
        line = np.array([[back, origin]])
        items.append(Segments("t < 0", "ray", line, 1.6, PALE, PALE, dashed=True, layer=2))
    for order, t in enumerate(sorted(found)):
        shown = min(max(share[0] * len(found) - order, 0.0), 1.0)
        if not shown:
            continue
        point, wins = _on_ray(camera, pixel, size, [t])[0], bool(share[1]) and t == least
        radius = (6.0 + 3.0 * share[1] * wins) * shown
        role = "mark" if wins or not share[1] else "text"
        items += [
            Dot(f"t = {t:.3g}", role, point, radius, layer=5 + wins, hidden=1.0),  # type: ignore[arg-type]
            Label(f"t = {t:.3g}", role, f"t = {number(round(t, 2))}", point,  # type: ignore[arg-type]
                  away=point - np.asarray(camera.v), strong=True),
        ]  # fmt: skip
    return items


def rays_to(camera: Camera, points: Sequence[Point], grown: float, reach: float) -> list[Item]:
    """Return the viewing rays of points of the world, and where they pass the image plane.

    grown: 1: the rays have reached their points; 2: the dots on the image plane, too. reach: how
    far behind the image plane a parallel ray is drawn, world units.
    """
    share = _shares(grown, 2)
    if not (points and share[0]):
        return []
    matrix = camera.camera_from_world
    x, y, z = (np.asarray(points, float) @ matrix[:3, :3].T + matrix[:3, 3]).T
    if camera.is_parallel:
        ends, starts = -z, np.full(len(z), -reach / float(np.linalg.norm(camera.w)))
    else:
        x, y = x * camera.distance / -z, y * camera.distance / -z
        ends, starts = -z / camera.distance, np.zeros(len(z))
    t = plane_parameter(camera)
    reached = starts + share[0] * (ends - starts)
    through = point_at(camera, x, y, np.minimum(t, reached))
    before = np.stack([point_at(camera, x, y, starts), through], axis=1)
    after = np.stack([through, point_at(camera, x, y, reached)], axis=1)
    items: list[Item] = [
        Segments("rays before", "ray", before, 2.2, 0.8, 0.4, layer=2),
        Segments("rays", "ray", after, 2.6, 1.0, 0.5, layer=2),
    ]
    if share[0] == 1:
        items += [Dot(f"point {k}", "mark", np.asarray(one, float), 4.0, layer=3)
                  for k, one in enumerate(points)]  # fmt: skip
    if share[1]:
        dots = point_at(camera, x, y, t)
        items += [Dot(f"on plane {k}", "mark", one, 5.5 * share[1], on_plane=True, layer=5)
                  for k, one in enumerate(dots)]  # fmt: skip
    return items


def _shares(grown: float, parts: int) -> list[float]:
    """Return how much of each part is drawn, 0 to 1."""
    return [min(max(grown - part, 0.0), 1.0) for part in range(parts)]


def _on_ray(camera: Camera, pixel: Pixel, size: Size, t: Sequence[float]) -> Floats:
    """Return the points (n, 3) of a pixel's ray at parameters t."""
    x, y = camera.image_point(*pixel, size)
    return point_at(camera, [x] * len(t), [y] * len(t), t)
