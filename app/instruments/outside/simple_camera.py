"""The simple camera of a lecture, one fact after another. Pure."""

from __future__ import annotations

import numpy as np

from lucida.app.state.options.shared import Pixel
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size

from .diagram import Dot, Eye, Item, Label, Role, Segments, named_arrow, polyline, shares, term
from .frustum import image_point, plane_corners
from .pixel_drawing import pixel_square

AXES = 0.55  # the length of the world's axes, in distances of the image plane


def simple_camera(camera: Camera, grown: float, measured: bool) -> list[Item]:
    """Return the drawing of the simple camera.

    grown: the number of complete facts: the eye's place, its direction, its viewport, the
    viewport's sides, the distance. measured: True to add the world's axes and the sides' lengths.
    """
    place, gaze, window, sides, distance = shares(grown, 5)
    eye, (u, v, w) = np.asarray(camera.eye, float), camera.basis.T
    corners = plane_corners(camera)
    middle = corners.mean(axis=0)
    items: list[Item] = []
    if place:
        items += [
            Eye("eye", eye, -w, 10.0 * place),
            Label("eye", "text", text_tuple(camera.eye), eye, away=eye + v, strong=True),
        ]
    for name, way in (("x", u), ("y", v)) if measured else ():
        tip = eye + AXES * camera.distance * place * way
        items += named_arrow(name, "volume", name, eye, tip, width=2.0)
    if gaze and not distance:
        tip = eye - 0.8 * gaze * camera.distance * w
        items += named_arrow("-z", "w", "-z", eye, tip, width=4.2)
    if window:
        edges = polyline(middle + window * (corners - middle), True)
        items.append(Segments("image plane", "plane", edges, 3.0, on_plane=True))
    if sides and measured:
        upper_left, _, lower_right, lower_left = corners
        left, below = upper_left - 0.08 * (lower_right - lower_left), lower_left - 0.08 * v
        items += _measure("height", left, lower_left - upper_left, sides, middle)
        items += _measure("width", below, lower_right - lower_left, sides, middle)
    if distance:
        line = np.array([eye, eye + distance * (middle - eye)])
        items.append(Segments("distance", "w", line[None], 3.6, hidden=0.6, layer=3))
        if distance == 1:
            at, text = eye + 0.45 * (middle - eye), f"d = {number(camera.distance)}"
            items.append(Label("distance", "w", text, at, away=at - v, strong=True, line=line))
    return items


def _measure(name: str, start: Floats, way: Floats, share: float, middle: Floats) -> list[Item]:
    """Return a dimension line with its length, as far as it has grown."""
    line, text = np.array([start, start + share * way]), number(float(np.linalg.norm(way)))
    return [
        Segments(name, "extra", line[None], 3.0, layer=3),
        *(Dot(name, "extra", end, 4.0) for end in line),
        Label(name, "extra", text, line.mean(axis=0), away=middle, strong=True, line=line),
    ]


def simple_ray(
    camera: Camera, size: Size, pixel: Pixel, base: int, grown: float, numbers: bool
) -> list[Item]:
    """Return a pixel's u and v on the viewport, and its ray's direction.

    base: the number of the first row and column. grown: the number of complete parts: the
    pixel, u and v, the direction. numbers: True to write numbers in place of letters.
    """
    filled, across, ahead = shares(grown, 3)
    eye, v = np.asarray(camera.eye, float), camera.basis[:, 1]
    x, y = (float(one) for one in camera.image_point(*pixel, size))
    center, middle = image_point(camera, x, y), image_point(camera, 0.0, 0.0)
    items = pixel_square(camera, size, pixel, 0.5 * filled, 2.0)
    if not across:
        row, column = (one + base for one in pixel)
        text = f"({row}, {column})" if numbers else "(i, j)"
        return [*items, Label("pixel", "mark", text, center, away=middle, strong=True)]
    items.append(Dot("pixel", "mark", center, 4.0, on_plane=True, layer=5))
    sides: list[tuple[Role, float, Floats]] = [
        ("u", x, image_point(camera, x, 0.0)),
        ("v", y, image_point(camera, 0.0, y)),
    ]
    for name, value, foot in sides:
        line = np.array([middle, middle + across * (foot - middle)])
        text, at = f"{name} = {number(value)}" if numbers else name, (middle + foot) / 2
        items += [
            Segments(name, name, line[None], 4.0, on_plane=True, layer=3),
            Segments("foot", "mark", np.array([[foot, center]]), 1.4, dashed=True,
                     on_plane=True, layer=3),
            Label(name, name, text, at, away=center, strong=True, line=line),
        ]  # fmt: skip
    if ahead:
        text = text_tuple((x, y, -camera.distance)) if numbers else "(u, v, -d)"
        aside, tip = v if y > 0 else -v, eye + ahead * (center - eye)
        items += term("direction", "ray", text, eye, tip, aside)
    return items
