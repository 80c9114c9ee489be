"""The simple camera of a lecture, one fact after another, and the numbers of a frame's pixels.
Pure.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from lucida.app.instruments.outside.diagram import (
    Arrow,
    Dot,
    Eye,
    Face,
    Item,
    Label,
    Segments,
    polyline,
)
from lucida.app.instruments.outside.frustum import image_point, pixel_corners, plane_corners
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size

MOST_NUMBERED = 12  # rows or columns that are all numbered
AXES = 0.55  # the length of the world's axes, in distances of the image plane


def simple_camera(camera: Camera, grown: float, measured: bool) -> list[Item]:
    """Return what makes the simple camera.

    grown: the number of complete facts: the eye's place, where it looks, its viewport, the
    viewport's sides, the distance. measured: with the world's axes and the lengths of the sides.
    """
    eye, share = np.asarray(camera.eye, float), [min(max(grown - k, 0.0), 1.0) for k in range(5)]
    u, v, ahead = (np.asarray(axis, float) for axis in (camera.u, camera.v, -np.asarray(camera.w)))
    corners = plane_corners(camera)
    middle = corners.mean(axis=0)
    items: list[Item] = []
    if share[0]:
        items += [
            Eye("eye", eye, ahead, 10.0 * share[0]),
            Label("eye", "text", text_tuple(camera.eye), eye, away=eye + v, strong=True),
        ]
    for name, way in (("x", u), ("y", v)) if measured else ():
        tip = eye + AXES * camera.distance * share[0] * way
        items.append(Arrow(name, "volume", eye, tip, 2.0))
        items.append(Label(name, "volume", name, tip, away=eye, strong=True, least=8.0))
    if share[1] and not share[4]:
        tip = eye + 0.8 * share[1] * camera.distance * ahead
        items.append(Arrow("-z", "w", eye, tip, 4.2))
        line = np.array([eye, tip])
        items.append(Label("-z", "w", "-z", tip, away=tip - v, strong=True, least=8.0, line=line))
    if share[2]:
        edges = polyline(middle + share[2] * (corners - middle), True)
        items.append(Segments("image plane", "plane", edges, 3.0, on_plane=True))
    if share[3] and measured:
        upper_left, _, lower_right, lower_left = corners
        left, below = upper_left - 0.08 * (lower_right - lower_left), lower_left - 0.08 * v
        for name, start, way in (
            ("height", left, lower_left - upper_left),
            ("width", below, lower_right - lower_left),
        ):
            length = number(float(np.linalg.norm(way)))
            items += _measure(name, start, start + share[3] * way, length, middle)
    if share[4]:
        reached = eye + share[4] * (middle - eye)
        line = np.array([[eye, reached]])
        items.append(Segments("distance", "w", line, 3.6, hidden=0.6, layer=3))
        if share[4] == 1:
            at = eye + 0.45 * (middle - eye)
            text = f"d = {number(camera.distance)}"
            items.append(Label("distance", "w", text, at, away=at - v, strong=True, line=line[0]))
    return items


def _measure(name: str, start: Floats, end: Floats, text: str, middle: Floats) -> Iterator[Item]:
    """Yield a line of measure with its length."""
    yield Segments(name, "extra", np.array([[start, end]]), 3.0, layer=3)
    yield Dot(f"{name} start", "extra", start, 4.0)
    yield Dot(f"{name} end", "extra", end, 4.0)
    line = np.array([start, end])
    yield Label(name, "extra", text, line.mean(axis=0), away=middle, strong=True, line=line)


def simple_ray(
    camera: Camera, size: Size, pixel: Pixel, base: int, grown: float, numbers: bool
) -> list[Item]:
    """Return a pixel's u and v on the viewport, and its ray's direction.

    base: the number of the first row and column. grown: the complete parts: the pixel, u and v, the
    direction. numbers: in place of letters.
    """
    share = [min(max(grown - k, 0.0), 1.0) for k in range(3)]
    eye = np.asarray(camera.eye, float)
    x, y = (float(one) for one in camera.image_point(*pixel, size))
    center, middle = image_point(camera, x, y), image_point(camera, 0.0, 0.0)
    corners = pixel_corners(camera, pixel, size)
    row, column = (one + base for one in pixel)
    items: list[Item] = [
        Face("pixel", "mark", corners, 0.5 * share[0], on_plane=True, layer=2),
        Segments("pixel", "mark", polyline(corners, True), 2.0, on_plane=True, layer=3),
    ]
    if not share[1]:
        text = f"({row}, {column})" if numbers else "(i, j)"
        items.append(Label("pixel", "mark", text, center, away=middle, strong=True))
        return items
    items.append(Dot("pixel", "mark", center, 4.0, on_plane=True, layer=5))
    for name, value, foot in (
        ("u", x, image_point(camera, x, 0.0)),
        ("v", y, image_point(camera, 0.0, y)),
    ):
        lines = np.array([[middle, middle + share[1] * (foot - middle)], [foot, center]])
        items.append(Segments(name, name, lines[:1], 4.0, on_plane=True, layer=3))  # type: ignore[arg-type]
        items.append(
            Segments(f"{name} foot", "mark", lines[1:], 1.4, dashed=True, on_plane=True, layer=3)
        )
        text = f"{name} = {number(value)}" if numbers else name
        at = (middle + foot) / 2
        label = Label(name, name, text, at, away=center, strong=True, line=lines[0])  # type: ignore[arg-type]
        items.append(label)
    if share[2]:
        tip = eye + share[2] * (center - eye)
        items.append(Arrow("direction", "ray", eye, tip, 4.2, layer=4))
        text = text_tuple((x, y, -camera.distance)) if numbers else "(u, v, -d)"
        at, below = (eye + tip) / 2, np.asarray(camera.v) * (1 if y > 0 else -1)
        line = np.array([eye, tip])
        items.append(
            Label("direction", "ray", text, at, away=at - below, strong=True, least=20.0, line=line)
        )
    return items


def pixel_numbers(
    camera: Camera, size: Size, marked: Pixel | None, base: int, step: int
) -> list[Item]:
    """Return the numbers of rows, at the left of the image plane, and of columns, above it.

    base: the number of the first ones. step: the least from one number to the next. Larger images
    than MOST_NUMBERED have only the first, the last and the marked pixel numbered.
    """
    left, _, _, top = camera.viewport
    items: list[Item] = []
    for axis, count in enumerate(size[::-1]):
        chosen = {0}
        if max(size) <= MOST_NUMBERED:
            chosen = set(range(0, count, step))
        for extra in (count - 1, *(() if marked is None else (marked[axis],))):
            chosen = {k for k in chosen if abs(k - extra) >= step} | {extra}
        for k in sorted(chosen):
            row, column = (k, 0) if axis == 0 else (0, k)
            x, y = (float(one) for one in camera.image_point(row, column, size))
            edge = (left, y) if axis == 0 else (x, top)
            is_marked = marked is not None and k == marked[axis]
            at, inside = image_point(camera, *edge), image_point(camera, x, y)
            name, role = f"{'row' if axis == 0 else 'column'} {k}", "mark" if is_marked else "text"
            items.append(
                Label(name, role, str(k + base), at, away=inside, strong=is_marked, fixed=True)  # type: ignore[arg-type]
            )
    return items
