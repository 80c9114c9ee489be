"""A camera as a diagram in the outside view: basis, image, view volume, viewing rays. Pure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.instruments.outside.diagram import (
    Arrow,
    Dot,
    Eye,
    Face,
    Item,
    Label,
    RayEnd,
    Role,
    Segments,
    polyline,
)
from lucida.app.instruments.outside.frustum import (
    MOST_GRID_LINES,
    grid,
    has_plane,
    image_point,
    pixel_corners,
    plane_corners,
    plane_parameter,
    point_at,
    rectangle,
)
from lucida.app.instruments.outside.lens_diagram import (
    ideal_border,
    image_sphere,
    lens_pixel,
    lens_volume,
)
from lucida.app.instruments.outside.ray_drawing import half_line, meetings, rays_to
from lucida.app.instruments.outside.simple_camera import pixel_numbers, simple_camera
from lucida.app.state.options.outside import OutsideOptions
from lucida.app.state.options.shared import Notation, Pixel
from lucida.app.ui.explaining.symbols import vector
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size

RIGHT_ANGLE = 0.2  # a side of its mark, in lengths of the axes
ABOVE_HANDLES = 0.8  # where a failure is written, in lengths of w
WORLD_UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class Content:
    """The content of a diagram: a camera and its rays.

    camera: fitted to its image of `size` pixels. end: the parameter at which the scene ends. hits:
    of the bundle's rays. marked: the marked pixel's ray. grid_parts: the most parts of a side of
    the grid. notation: of the labels. base: the number of the first row and column. number_step:
    see pixel_numbers(); None: rows and columns are not numbered. meetings: the t
    of all meetings of the marked pixel's line with objects. pointed: the t under the mouse.
    names_t: write the t of the marked pixel's hit.
    """

    camera: Camera
    size: Size
    options: OutsideOptions
    end: float
    hits: Sequence[RayEnd] = ()
    marked: RayEnd | None = None
    grid_parts: int = MOST_GRID_LINES
    notation: Notation = "book"
    base: int = 1
    number_step: int | None = None
    meetings: tuple[float, ...] = ()
    pointed: float | None = None
    names_t: bool = True


def diagram(content: Content) -> list[Item]:
    """Return everything that the options of the content ask for."""
    camera, size, options, end = content.camera, content.size, content.options, content.end
    marked, notation = content.marked, content.notation
    items: list[Item] = []
    if options.volume:
        items += _volume(camera, end) if camera.lens is None else lens_volume(camera, end)
    items += plane_items(content)
    for hit in content.hits:
        items += _ray(camera, size, hit, end, 1.6, f"bundle {hit.pixel[0]} {hit.pixel[1]}")
    items += rays_to(camera, options.points, options.points_grown, end)
    if marked is not None and options.ray:
        if options.half_line:
            pointed = content.pointed
            return items + half_line(
                camera, size, marked.pixel, options.half_line, pointed, notation
            )
        if options.meetings:
            found = content.meetings
            items += meetings(camera, size, marked.pixel, found, end, options.meetings)
        else:
            items += _marked(camera, size, marked, end, not options.image, content.names_t)
    if options.simple:
        return items + simple_camera(camera, options.simple, measured=options.formula is None)
    fails = options.target is not None and is_parallel(options.up, camera.w)
    shares = _basis_shares(options)
    if options.basis:
        items += _basis(camera, ("w",) if fails else ("u", "v", "w"), shares)
    if options.target is not None:
        items += _target(camera, options, fails, shares)
    return items + _eye(camera, options, notation)


def plane_items(content: Content) -> list[Item]:
    """Return the image plane with its pixels, as far as the options ask for them."""
    camera, size, options = content.camera, content.size, content.options
    items: list[Item] = []
    if (options.image or options.grid) and not options.simple:
        items += _image(camera, size)
    if options.grid:
        lines = grid(camera, size, content.grid_parts)
        items.append(Segments("grid", "grid", lines, 0.75, 0.4, 0.1, on_plane=True, layer=0))
    if content.number_step is not None and has_plane(camera):
        pixel = None if content.marked is None else content.marked.pixel
        items += pixel_numbers(camera, size, pixel, content.base, content.number_step)
    return items


def _basis_shares(options: OutsideOptions) -> dict[str, float]:
    """Return how much is drawn of each vector of a basis that is made from a target."""
    order = ("w", "up", "u", "v")
    grown = options.basis_grown
    return {name: min(max(grown - place, 0.0), 1.0) for place, name in enumerate(order)}


def _image(camera: Camera, size: Size) -> list[Item]:
    if not has_plane(camera):
        return image_sphere(camera, size)
    edges = polyline(plane_corners(camera), True)
    plane = Segments("image plane", "plane", edges, 2.4, on_plane=True)
    return [plane] if camera.lens is None else [plane, ideal_border(camera)]


def _volume(camera: Camera, end: float) -> list[Item]:
    """Return the pyramid or box from near to far, or to the end of the scene."""
    near, far = camera.t_range
    last = far if np.isfinite(far) else max(end, 1.5 * near)
    first, back = rectangle(camera, max(near, 0.0)), rectangle(camera, last)
    edges = np.stack([first, back], axis=1)
    items: list[Item] = [
        Face(f"side {k}", "volume", np.array([*edges[k], *edges[(k + 1) % 4][::-1]]), 0.055)
        for k in range(4)
    ]
    if near > 0:  # nothing is drawn before near: thin
        before = np.stack([rectangle(camera, 0.0), first], axis=1)
        items.append(Segments("before near", "volume", before, 1.0, 0.55, 0.2, dashed=True))
        items += _clip_plane("near", first)
    items.append(Segments("edges", "volume", edges, 1.8))
    if np.isfinite(far):
        items += _clip_plane("far", back)
    else:
        items.append(Segments("end", "volume", polyline(back, True), 1.0, 0.6, 0.25, dashed=True))
    if not camera.is_parallel and near < plane_parameter(camera):
        axis = np.array([[camera.eye, plane_corners(camera).mean(axis=0)]])
        items.append(Segments("distance", "plane", axis, 1.0, 0.55, 0.25, dashed=True))
    return items


def _clip_plane(name: str, corners: Floats) -> list[Item]:
    return [
        Face(name, "volume", corners, 0.08),
        Segments(name, "volume", polyline(corners, True), 1.75),
        Label(name, "text", name, corners[1], away=corners[0]),
    ]


def _eye(camera: Camera, options: OutsideOptions, notation: Notation) -> list[Item]:
    """Return the eye. Parallel rays have none: **e** is the point that the basis starts at."""
    eye = np.asarray(camera.eye)
    label = Label("eye", "text", vector("e", notation), eye, strong=True)
    if not camera.is_parallel:
        return [Eye("eye", eye, -np.asarray(camera.w)), label]
    return [Dot("eye", "eye", eye), label] if options.basis else []


def _target(
    camera: Camera, options: OutsideOptions, fails: bool, shares: dict[str, float]
) -> list[Item]:
    """Draw what the basis is made from: the target, the way to it, and up, at the eye.

    shares: how much of the basis and of up is drawn.
    """
    eye, target, up = (np.asarray(v, float) for v in (camera.eye, options.target, options.up))
    w, items = np.asarray(camera.w, float), _up(eye, target, shares["up"] * up)
    if not options.basis:  # it is asked for
        return items
    if fails:
        return [
            *items,
            Label(
                "fails",
                "text",
                "up x w = 0: no u, no v",
                eye + ABOVE_HANDLES * np.linalg.norm(w) * WORLD_UP,
                away=eye,
                strong=True,
            ),
        ]
    if shares["u"]:
        spanned = np.array([eye, eye + up, eye + up + w, eye + w])
        items.append(Face("up and w", "extra", spanned, 0.16 * shares["u"]))
    return items + _right_angles(camera) if shares["v"] == 1 else items


def is_parallel(first: ArrayLike, second: ArrayLike) -> bool:
    """Return True if two vectors are parallel."""
    a, b = np.asarray(first, float), np.asarray(second, float)
    lengths = float(np.linalg.norm(a) * np.linalg.norm(b))
    return float(np.linalg.norm(np.cross(a, b))) < 1e-9 * lengths


def _right_angles(camera: Camera) -> list[Item]:
    """Mark the right angles of the basis."""
    eye, axes = np.asarray(camera.eye), np.array([camera.u, camera.v, camera.w])
    items: list[Item] = []
    for first, second in ((0, 1), (1, 2), (2, 0)):
        a, b = RIGHT_ANGLE * axes[first], RIGHT_ANGLE * axes[second]
        if abs(a @ b) < 1e-6 * float(np.linalg.norm(a) * np.linalg.norm(b)):
            lines = polyline(np.array([eye + a, eye + a + b, eye + b]))
            items.append(Segments(f"right angle {first}", "text", lines, 1.2, layer=2))
    return items


def _up(eye: Floats, target: Floats, up: Floats) -> list[Item]:
    """Return the target, and up if it has a length."""
    items: list[Item] = [
        Segments("to target", "extra", np.array([[eye, target]]), 1.6, dashed=True, layer=2),
        Dot("target", "extra", target, 6.0),
        Label("target", "extra", "target", target, away=target - WORLD_UP, strong=True),
    ]
    if up.any():
        items.append(Arrow("up", "extra", eye, eye + up))
        items.append(Label("up", "extra", "up", eye + up, away=eye, strong=True, least=8.0))
    return items


def _basis(camera: Camera, names: tuple[Role, ...], shares: dict[str, float]) -> list[Item]:
    eye = np.asarray(camera.eye)
    items: list[Item] = []
    for name in names:
        if not shares[name]:
            continue
        tip = eye + shares[name] * np.asarray(getattr(camera, name))
        items.append(Arrow(name, name, eye, tip))
        items.append(Label(name, name, name, tip, away=eye, strong=True, least=8.0))
    return items


def _ray(
    camera: Camera, size: Size, hit: RayEnd, end: float, width: float, name: str
) -> list[Item]:
    """Return a ray of a bundle to its hit, or as far as the scene if it hits nothing."""
    t = hit.t_or(end)
    plane = min(plane_parameter(camera), t)
    origin, through, reached = _on_ray(camera, hit.pixel, size, [0.0, plane, t])
    if not np.isfinite(reached).all():
        return []
    pale = (0.95, 0.35) if hit.is_hit else (0.42, 0.2)
    items: list[Item] = [
        Segments(name, "ray", np.array([[through, reached]]), width, *pale, layer=2)
    ]
    if plane > 0:  # thin before the image plane, whose picture must stay visible
        before = np.array([[origin, through]])
        items.append(Segments(f"{name} before", "ray", before, 0.6 * width, 0.44, 0.2, layer=2))
    if hit.is_hit:
        items.append(Dot(f"{name} hit", "mark", reached, 1.6 * width, layer=2))
    return items


def _marked(
    camera: Camera, size: Size, hit: RayEnd, end: float, washed: bool, names_t: bool
) -> list[Item]:
    """Return the marked pixel, its ray through its centre, its hit, and the way beyond.

    washed: fill the pixel, which has no colour of the image that must stay visible.
    """
    t = hit.t_or(end)
    last = max(end, t + 0.35 * max(end, t))
    origin, reached, far = _on_ray(camera, hit.pixel, size, [0.0, t, last])
    of_lens = [] if camera.lens is None else lens_pixel(camera, size, hit.pixel)
    if not np.isfinite(reached).all():
        return of_lens
    center = image_point(camera, *camera.image_point(*hit.pixel, size))
    corners = pixel_corners(camera, hit.pixel, size)
    items: list[Item] = [
        *of_lens,
        Segments("ray", "ray", np.array([[origin, reached]]), 2.6, hidden=0.6, layer=3),
        *([Face("pixel", "mark", corners, 0.5, on_plane=True, layer=2)] if washed else []),
        Segments("pixel", "mark", polyline(corners, True), 1.6, on_plane=True, layer=3),
        Dot("pixel", "mark", center, 3.0, on_plane=True, layer=4),
    ]
    if hit.is_hit:
        beyond = np.array([[reached, far]])
        items += [
            Segments("beyond", "ray", beyond, 1.4, 0.5, 0.3, dashed=True, layer=2),
            Dot("hit", "mark", reached, 6.0),
        ]
        if names_t:
            items.append(Label("hit", "mark", f"t = {t:.4g}", reached, away=origin))
    return items


def _on_ray(camera: Camera, pixel: Pixel, size: Size, t: Sequence[float]) -> Floats:
    """Return the points (n, 3) of a pixel's ray at parameters t."""
    x, y = camera.image_point(*pixel, size)
    return point_at(camera, [x] * len(t), [y] * len(t), t)
