"""The drawing over the outside view, in world space: lines, arrows, faces, marks, labels.

Defines the parts of a camera's drawing, their names and their roles (their meanings, from which
painting and SVG take a colour). Pure: knows no outside camera, no pixels, no colours.

Widths and radii are in units of a line in class, about a pixel at 100 %.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.outside.frustum import (
    MOST_GRID_LINES,
    Size,
    grid,
    pixel_corners,
    plane_corners,
    plane_parameter,
    point_at,
    rectangle,
)
from app.outside.options import OutsideOptions
from app.state.options import Pixel
from renderer.camera import Camera

Floats = NDArray[np.float64]
Role = Literal[
    "u", "v", "w", "ray", "mark", "plane", "volume", "grid", "eye", "text", "extra", "other",
    "pose",
]  # fmt: skip

PALE = 0.42  # of what is hidden: the opacity of its dashes


@dataclass(frozen=True, eq=False)
class Segments:
    """Segments (n, 2, 3). layer: higher ones are drawn over lower ones. on_plane: part of the image
    plane, which then does not hide them. dashed: even where nothing hides them."""

    name: str
    role: Role
    segments: Floats
    width: float = 1.5
    opacity: float = 1.0
    hidden: float = PALE
    on_plane: bool = False
    dashed: bool = False
    layer: int = 1


@dataclass(frozen=True, eq=False)
class Face:
    """A filled convex polygon, corners (n, 3)."""

    name: str
    role: Role
    corners: Floats
    opacity: float
    hidden: float = 0.5
    on_plane: bool = False
    layer: int = 0


@dataclass(frozen=True, eq=False)
class Arrow:
    """From start to end, (3,) each, with a head at the end that has a size on the screen."""

    name: str
    role: Role
    start: Floats
    end: Floats
    width: float = 3.2
    head: float = 15.0
    layer: int = 3


@dataclass(frozen=True, eq=False)
class Dot:
    """A round mark."""

    name: str
    role: Role
    point: Floats
    radius: float = 4.5
    on_plane: bool = False
    layer: int = 4


@dataclass(frozen=True, eq=False)
class Eye:
    """The eye: a ball that looks along `gaze`."""

    name: str
    point: Floats
    gaze: Floats
    radius: float = 10.0
    layer: int = 4


@dataclass(frozen=True, eq=False)
class Label:
    """Text next to a point.

    away: a point that the text keeps away from; None to centre it above. strong: a letter of the
    formulas. least: hide the text if point and `away` are nearer than this on the screen, in units
    of a line.
    """

    name: str
    role: Role
    text: str
    point: Floats
    away: Floats | None = None
    strong: bool = False
    least: float = 0.0


Item = Segments | Face | Arrow | Dot | Eye | Label


@dataclass(frozen=True)
class RayEnd:
    """A viewing ray and where it ends. t: inf where nothing is hit, None where it is not known
    yet."""

    pixel: Pixel
    t: float | None


def polyline(points: Floats, closed: bool = False) -> Floats:
    """Segments (n, 2, 3) through points (m, 3)."""
    ends = np.roll(points, -1, axis=0) if closed else points[1:]
    return np.stack([points[: len(ends)], ends], axis=1)


def diagram(
    camera: Camera,
    size: Size,
    options: OutsideOptions,
    end: float,
    hits: Sequence[RayEnd] = (),
    marked: RayEnd | None = None,
    grid_parts: int = MOST_GRID_LINES,
) -> list[Item]:
    """Everything that the options ask for. camera: fitted to its image of `size` pixels. end: the
    parameter at which the scene ends. hits: of the bundle's rays. grid_parts: the most parts of a
    side that the grid divides it into."""
    items: list[Item] = []
    if options.volume:
        items += _volume(camera, end)
    if options.image or options.grid:
        items.append(
            Segments(
                "image plane", "plane", polyline(plane_corners(camera), True), 2.4, on_plane=True
            )
        )
    if options.grid:
        items.append(
            Segments(
                "grid",
                "grid",
                grid(camera, size, grid_parts),
                0.75,
                0.4,
                0.1,
                on_plane=True,
                layer=0,
            )
        )
    for hit in hits:
        items += _ray(camera, size, hit, end, 1.6, f"bundle {hit.pixel[0]} {hit.pixel[1]}")
    if marked is not None and options.ray:
        items += _marked(camera, size, marked, end)
        if options.parameters:
            items += _parameters(camera, size, marked.pixel)
    if options.basis:
        items += _basis(camera)
    if options.target is not None:
        items += _target(camera, options)
    return items + _eye(camera, options)


def _volume(camera: Camera, end: float) -> list[Item]:
    """The pyramid or box: from the eye, or from near, to far, or to where the scene ends."""
    near, far = camera.t_range
    last = far if np.isfinite(far) else max(end, 1.5 * near)
    apex = 0.0
    plane = plane_parameter(camera)
    first, back = rectangle(camera, max(near, apex)), rectangle(camera, last)
    edges = np.stack([first, back], axis=1)
    items: list[Item] = [
        Face(f"side {k}", "volume", np.array([*edges[k], *edges[(k + 1) % 4][::-1]]), 0.055)
        for k in range(4)
    ]
    if near > apex:  # what is before near is not seen: thin
        before = np.stack([rectangle(camera, apex), first], axis=1)
        items.append(Segments("before near", "volume", before, 1.0, 0.55, 0.2, dashed=True))
        items.append(Face("near", "volume", first, 0.08))
        items.append(Segments("near", "volume", polyline(first, True), 1.75))
        items.append(Label("near", "text", "near", first[1], away=first[0]))
    items.append(Segments("edges", "volume", edges, 1.8))
    if np.isfinite(far):
        items.append(Face("far", "volume", back, 0.08))
        items.append(Segments("far", "volume", polyline(back, True), 1.75))
        items.append(Label("far", "text", "far", back[1], away=back[0]))
    else:
        items.append(Segments("end", "volume", polyline(back, True), 1.0, 0.6, 0.25, dashed=True))
    if not camera.is_parallel:
        corners = plane_corners(camera)
        middle = corners.mean(axis=0)
        axis = np.stack([np.asarray(camera.eye), middle])[None]
        if near < plane:
            items.append(Segments("distance", "plane", axis, 1.0, 0.55, 0.25, dashed=True))
    return items


def _eye(camera: Camera, options: OutsideOptions) -> list[Item]:
    """The eye. Parallel rays have none: there **e** is the point that the basis starts from."""
    eye = np.asarray(camera.eye)
    if not camera.is_parallel:
        return [Eye("eye", eye, -np.asarray(camera.w)), Label("eye", "text", "eye", eye)]
    if not options.basis:
        return []
    return [Dot("e", "eye", eye), Label("e", "text", "e", eye)]


def _target(camera: Camera, options: OutsideOptions) -> list[Item]:
    """Draw what the basis is made from: the target a, the way to it, and up, at the eye."""
    eye, target, up = (np.asarray(v, float) for v in (camera.eye, options.target, options.up))
    return [
        Segments("to target", "extra", np.array([[eye, target]]), 1.6, dashed=True, layer=2),
        Dot("target", "extra", target, 6.0),
        Label("target", "extra", "a", target, away=eye, strong=True),
        Arrow("up", "extra", eye, eye + up),
        Label("up", "extra", "up", eye + up, away=eye, strong=True, least=8.0),
    ]


def _basis(camera: Camera) -> list[Item]:
    eye = np.asarray(camera.eye)
    items: list[Item] = []
    for name in ("u", "v", "w"):
        tip = eye + np.asarray(getattr(camera, name))
        items.append(Arrow(name, name, eye, tip))
        items.append(Label(name, name, name, tip, away=eye, strong=True, least=8.0))
    return items


def _ray(
    camera: Camera, size: Size, hit: RayEnd, end: float, width: float, name: str
) -> list[Item]:
    """A ray of a bundle to its hit, or as far as the scene where it hits nothing."""
    x, y = (float(part) for part in camera.image_point(*hit.pixel, size))
    known = hit.t is not None and bool(np.isfinite(hit.t))
    t = hit.t if hit.t is not None and known else end
    plane = min(plane_parameter(camera), t)
    origin, through, reached = point_at(camera, [x] * 3, [y] * 3, [0.0, plane, t])
    pale = (0.95, 0.35) if known else (0.42, 0.2)
    items: list[Item] = [
        Segments(name, "ray", np.array([[through, reached]]), width, *pale, layer=2)
    ]
    if plane > 0:  # thin before the image plane, whose picture is to be seen
        before = np.array([[origin, through]])
        items.append(Segments(f"{name} before", "ray", before, 0.6 * width, 0.44, 0.2, layer=2))
    if known:
        items.append(Dot(f"{name} hit", "mark", reached, 1.6 * width, layer=2))
    return items


def _marked(camera: Camera, size: Size, hit: RayEnd, end: float) -> list[Item]:
    """The marked pixel, its ray through its centre, its hit, and the way beyond."""
    x, y = (float(part) for part in camera.image_point(*hit.pixel, size))
    corners = pixel_corners(camera, hit.pixel, size)
    center = point_at(camera, x, y, plane_parameter(camera))
    known = hit.t is not None and bool(np.isfinite(hit.t))
    t = hit.t if hit.t is not None and known else end
    origin, reached = point_at(camera, [x, x], [y, y], [0.0, t])
    items: list[Item] = [
        Segments("ray", "ray", np.array([[origin, reached]]), 2.6, hidden=0.6, layer=3),
        Face("pixel", "mark", corners, 0.5, on_plane=True, layer=2),
        Segments("pixel", "mark", polyline(corners, True), 1.6, on_plane=True, layer=3),
        Dot("pixel", "mark", center, 3.0, on_plane=True, layer=4),
    ]
    if known:
        last = max(end, t + 0.35 * max(end, t))
        beyond = point_at(camera, [x, x], [y, y], [t, last])[None]
        items.append(Segments("beyond", "ray", beyond, 1.4, 0.5, 0.3, dashed=True, layer=2))
        items.append(Dot("hit", "mark", reached, 6.0))
        items.append(Label("hit", "mark", f"t = {t:.4g}", reached, away=origin))
    return items


def _parameters(camera: Camera, size: Size, pixel: Pixel) -> list[Item]:
    """Points of the pixel's ray at t = 0 and 1, and a piece of its line before it begins."""
    x, y = (float(part) for part in camera.image_point(*pixel, size))
    before, first, second = point_at(camera, [x] * 3, [y] * 3, [-0.6, 0.0, 1.0])
    return [
        Segments("behind", "ray", np.array([[before, first]]), 1.4, 0.6, 0.3, dashed=True, layer=2),
        Label("t < 0", "ray", "t < 0", before, away=first),
        Dot("t = 0", "ray", first, 5.0, layer=5),
        Label("t = 0", "ray", "p (t = 0)", first, away=first - camera.v),
        Dot("t = 1", "ray", second, 5.0, layer=5),
        Label("t = 1", "ray", "p + d (t = 1)", second, away=second + camera.v),
    ]
