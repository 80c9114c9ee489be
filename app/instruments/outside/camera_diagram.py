"""A camera as a diagram in the outside view: basis, image, view volume, viewing rays. Pure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin

from .diagram import (
    Dot,
    Eye,
    Face,
    Item,
    Label,
    RayEnd,
    Role,
    Segments,
    line,
    named_arrow,
    named_dot,
    polyline,
    shares,
)
from .frustum import (
    CURVE,
    MOST_GRID_LINES,
    border,
    grid,
    image_point,
    on_ray,
    plane_corners,
    plane_parameter,
    point_at,
)
from .lens_diagram import lens_pixel
from .pixel_drawing import pixel_numbers, pixel_square
from .pixel_plane import pixel_items
from .ray_drawing import half_line, meetings, rays_to
from .simple_camera import simple_camera

RIGHT_ANGLE = 0.2  # the side of its mark, in lengths of the axes
ABOVE_HANDLES = 0.8  # the height of a failure's message, in lengths of w
WORLD_UP = np.array([0.0, 1.0, 0.0])
LENS_PARTS = (6, 2, CURVE)  # faces, edges and curves per side of a lens's view volume


@dataclass(frozen=True)
class Content:
    """The content of a diagram: a camera and its rays.

    camera: the camera, fitted to its image of `size` pixels.
    end: the ray parameter at which the scene ends.
    hits: the bundle's rays.
    marked: the marked pixel's ray.
    grid_parts: the maximum number of parts of a side of the grid.
    base: the number of the first row and column.
    origin: the point of a pixel that has whole coordinates in K.
    number_step: see pixel_numbers(); None if rows and columns are not numbered.
    meetings: the t of all points where the marked pixel's line meets objects.
    names_t: True to write the t of the marked pixel's hit.
    arrow: the length of the basis's arrows, in lengths of its vectors.
    """

    camera: Camera
    size: Size
    options: OutsideOptions
    end: float
    hits: Sequence[RayEnd] = ()
    marked: RayEnd | None = None
    grid_parts: int = MOST_GRID_LINES
    base: int = 1
    origin: PixelOrigin = "center"
    number_step: int | None = None
    meetings: tuple[float, ...] = ()
    names_t: bool = True
    arrow: float = 1.0


def diagram(content: Content) -> list[Item]:
    """Return all items that the content's options switch on, with the letters of the book."""
    camera, size, options, end = content.camera, content.size, content.options, content.end
    marked = content.marked
    items: list[Item] = []
    if options.volume:
        items += _volume(camera, end)
    items += plane_items(content)
    for hit in content.hits:
        items += _ray(camera, size, hit, end)
    items += rays_to(camera, options.points, options.points_grown, end)
    if marked is not None and options.ray:
        pixel = marked.pixel
        if options.half_line:
            return items + half_line(camera, size, pixel, options.half_line)
        if options.meetings:
            items += meetings(camera, size, pixel, content.meetings, end, options.meetings)
        else:
            items += _marked(content, marked)
    if options.simple:
        return items + simple_camera(camera, options.simple, measured=options.formula is None)
    items += _basis(camera, options, content.arrow) + _eye(camera, options)
    return [*items, *pixel_items(camera, size, content.origin)] if options.pixels else items


def plane_items(content: Content) -> list[Item]:
    """Return the image plane with its pixels, as far as the options show them."""
    camera, size, options = content.camera, content.size, content.options
    items: list[Item] = []
    if (options.image or options.grid) and not options.simple:
        items += _image(camera)
    if options.grid:
        lines = grid(camera, size, content.grid_parts)
        items.append(Segments("grid", "grid", lines, 0.75, 0.4, 0.1, on_plane=True, layer=0))
    if content.number_step is not None:
        pixel = None if content.marked is None else content.marked.pixel
        items += pixel_numbers(camera, size, pixel, content.base, content.number_step)
    return items


def _image(camera: Camera) -> list[Item]:
    edges = polyline(plane_corners(camera), True)
    return [Segments("image plane", "plane", edges, 2.4, on_plane=True)]


def _volume(camera: Camera, end: float) -> list[Item]:
    """Return the view volume from near to far, or to the end of the scene: a pyramid, a box, or
    a lens's volume.
    """
    near, far = camera.t_range
    last = far if np.isfinite(far) else max(end, 1.5 * near)

    def rays(parts: int) -> Floats:
        """Return the points (n, 3, 3) of rays along the border: their origins, near, far."""
        x, y = border(camera, parts).T[..., None]
        found = point_at(camera, x, y, [0.0, max(near, 0.0), last])
        return found[np.isfinite(found).all(axis=(1, 2))]

    def named(name: str, points: Floats) -> list[Item]:
        label = Label(name, "text", name, points[len(points) // 4], away=points[0])
        items: list[Item] = [Segments(name, "volume", polyline(points, True), 1.75), label]
        return items if camera.lens else [Face(name, "volume", points, 0.08), *items]

    sides, edges, curves = map(rays, LENS_PARTS) if camera.lens else [rays(1)] * 3
    _, first, back = curves.swapaxes(0, 1)
    faces = np.concatenate([sides[:, 1:], np.roll(sides, -1, axis=0)[:, :0:-1]], axis=1)
    items: list[Item] = [Face("side", "volume", corners, 0.055) for corners in faces]
    if near > 0:  # thin, because nothing is drawn before near
        before = edges[:, :2]
        items.append(Segments("before near", "volume", before, 1.0, 0.55, 0.2, dashed=True))
        items += named("near", first)
    items.append(Segments("edges", "volume", edges[:, 1:], 1.8))
    if np.isfinite(far):
        items += named("far", back)
    else:
        items.append(Segments("end", "volume", polyline(back, True), 1.0, 0.6, 0.25, dashed=True))
    if camera.lens is None and not camera.is_parallel and near < 1:
        middle, pale = plane_corners(camera).mean(axis=0), {"opacity": 0.55, "hidden": 0.25}
        items.append(line("distance", "plane", camera.eye, middle, 1.0, dashed=True, **pale))
    return items


def _eye(camera: Camera, options: OutsideOptions) -> list[Item]:
    """Return the eye. Parallel rays have none; **e** is then the point where the basis starts."""
    eye = np.asarray(camera.eye)
    label = Label("eye", "text", "vec(e)", eye, strong=True)
    if not camera.is_parallel:
        return [Eye("eye", eye, -np.asarray(camera.w)), label]
    return [Dot("eye", "eye", eye), label] if options.basis else []


def _basis(camera: Camera, options: OutsideOptions, arrow: float) -> list[Item]:
    """Return the basis. If there is a target, add it and the vector up."""
    eye, names = np.asarray(camera.eye, float), ("w", "up", "u", "v")
    share = dict(zip(names, shares(options.basis_grown, len(names)), strict=True))
    up, w = arrow * np.asarray(options.up), arrow * np.asarray(camera.w)
    length = "" if arrow == 1 else f"{arrow:g} "
    has_target = options.target is not None
    lengths = float(np.linalg.norm(up) * np.linalg.norm(w))
    fails = has_target and float(np.linalg.norm(np.cross(up, w))) < 1e-9 * lengths
    items: list[Item] = []
    axes: tuple[Role, ...] = ("w",) if fails else ("u", "v", "w")
    for name in axes if options.basis else ():
        if share[name]:
            tip = eye + share[name] * arrow * np.asarray(getattr(camera, name))
            items += named_arrow(name, name, f"{length}vec({name})", eye, tip)
    if has_target:
        items += _target(eye, np.asarray(options.target, float), share["up"] * up)
    if not has_target or not options.basis:  # an exercise asks the student for it
        return items
    if fails:
        at = eye + ABOVE_HANDLES * np.linalg.norm(w) * WORLD_UP
        text = "up x w = 0: no vec(u), no vec(v)"
        return [*items, Label("fails", "text", text, at, away=eye, strong=True)]
    if share["u"]:
        spanned = np.array([eye, eye + up, eye + up + w, eye + w])
        items.append(Face("up and w", "extra", spanned, 0.16 * share["u"]))
    return items + _right_angles(camera, arrow) if share["v"] == 1 else items


def _target(eye: Floats, target: Floats, up: Floats) -> list[Item]:
    """Return the target, and up if it has a length."""
    return [
        line("to target", "extra", eye, target, 1.6, dashed=True, layer=2),
        *named_dot("target", "extra", "target", target, target - WORLD_UP),
        *(named_arrow("up", "extra", "up", eye, eye + up) if up.any() else ()),
    ]


def _right_angles(camera: Camera, arrow: float) -> list[Item]:
    """Mark the right angles of the basis."""
    eye, axes = np.asarray(camera.eye), RIGHT_ANGLE * arrow * camera.basis.T
    items: list[Item] = []
    for a, b in zip(axes, np.roll(axes, -1, axis=0), strict=True):
        if abs(a @ b) < 1e-6 * float(np.linalg.norm(a) * np.linalg.norm(b)):
            lines = polyline(np.array([eye + a, eye + a + b, eye + b]))
            items.append(Segments("right angle", "text", lines, 1.2, layer=2))
    return items


def _ray(camera: Camera, size: Size, hit: RayEnd, end: float) -> list[Item]:
    """Return a ray of a bundle to its hit, or to the end of the scene if it hits nothing."""
    t = hit.t_or(end)
    plane = min(plane_parameter(camera), t)
    origin, through, reached = on_ray(camera, hit.pixel, size, [0.0, plane, t])
    if not np.isfinite(reached).all():
        return []
    pale = (0.95, 0.35) if hit.is_hit else (0.42, 0.2)
    items: list[Item] = [
        Segments("bundle", "ray", np.array([[through, reached]]), 1.6, *pale, layer=2)
    ]
    if plane > 0:  # thin before the image plane, whose picture must stay visible
        before = np.array([[origin, through]])
        items.append(Segments("bundle before", "ray", before, 0.96, 0.44, 0.2, layer=2))
    if hit.is_hit:
        items.append(Dot("bundle hit", "mark", reached, 2.56, layer=2))
    return items


def _marked(content: Content, hit: RayEnd) -> list[Item]:
    """Return the marked pixel, the ray through its centre, its hit, and the ray beyond the hit. The
    pixel is filled only if no image is shown, because an image's colour must stay visible.
    """
    camera, size, end, t = content.camera, content.size, content.end, hit.t_or(content.end)
    items = [] if camera.lens is None else lens_pixel(camera, size, hit.pixel)
    last = max(end, t + 0.35 * max(end, t))
    origin, reached, far = on_ray(camera, hit.pixel, size, [0.0, t, last])
    if not np.isfinite(reached).all():
        return items
    center = image_point(camera, *camera.image_point(*hit.pixel, size))
    items += [
        line("ray", "ray", origin, reached, 2.6, hidden=0.6, layer=3),
        *pixel_square(camera, size, hit.pixel, 0.0 if content.options.image else 0.5),
        Dot("pixel", "mark", center, 3.0, on_plane=True, layer=4),
    ]
    if hit.is_hit:
        pale = {"opacity": 0.5, "hidden": 0.3}
        items += [
            line("beyond", "ray", reached, far, 1.4, dashed=True, layer=2, **pale),
            Dot("hit", "mark", reached, 6.0),
        ]
        if content.names_t:
            items.append(Label("hit", "mark", f"t = {t:.4g}", reached, away=origin))
    return items
