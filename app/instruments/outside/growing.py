"""The key formula as it grows: the viewing ray of a pixel, term by term, head to tail. Pure.

Perspective: -d **w**, u **u** and v **v** lead from the eye to the pixel's centre; their sum is the
direction. Parallel: the direction is -**w**, and the origin slides over the viewport by u **u** and
v **v**. With a lens, the pixel's ideal point comes first, and the
terms lead there.

A position counts stages: 2.5 is half of the third one.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from lucida.app.instruments.outside.camera_diagram import Content, diagram, plane_items
from lucida.app.instruments.outside.diagram import (
    Arrow,
    Dot,
    Face,
    Item,
    Label,
    RayEnd,
    Role,
    Segments,
    in_notation,
    polyline,
)
from lucida.app.instruments.outside.frustum import ideal_point, image_point, pixel_corners, ways
from lucida.app.instruments.outside.simple_camera import simple_ray
from lucida.app.state.options.outside import LENS_STAGES, STAGES
from lucida.app.state.options.shared import Notation, Pixel
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.app.ui.explaining.symbols import latex
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, three
from lucida.renderer.camera.image_plane import Size

BASIS = ("u", "v", "w")
THIN = 1.6  # the width of the basis, next to the terms along it
ENDS = (r"\text{origin}", r"\text{direction}")  # a ray's, as a lecture may write them
GROWS = 0.7  # of a stage's time; then it rests, for the class to look
# With a lens, for directions that have a length, and for those that reach the plane at distance 1.
_LENS_TEXTS = (
    ("-d Z vec(w)", "d X vec(u)", "-d Y vec(v)"),
    ("-d vec(w)", "d a vec(u)", "-d b vec(v)"),
)
# What a stage adds to a formula of the probe or of the lecture.
_LIT = {
    "pixel": ("(i, j)",),
    "centre": ("u, v",),
    "undistort": ("(a, b)", "(X, Y, Z)"),
    "w": (r"d\,\mathbf{w}", r"Z\,\mathbf{w}"),
    "u": (r"u\,\mathbf{u}", r"a\,\mathbf{u}", r"X\,\mathbf{u}"),
    "v": (r"v\,\mathbf{v}", r"b\,\mathbf{v}", r"Y\,\mathbf{v}"),
    "ray": (r"\mathbf{r}(t)",),
}


@dataclass(frozen=True, eq=False)
class Vector:
    """A term of the formula, drawn from start to end, (3,) each. text: its label."""

    name: str
    role: Role
    text: str
    start: Floats
    end: Floats


@dataclass(frozen=True, eq=False)
class Growth:
    """The formula at one position.

    shares: the drawn part of each stage, 0 to 1. lit: the stage whose term is pointed out; "" at
    the end. vectors: those that have begun. center: of the pixel, in the image. ideal: where a lens
    moves it back to. foots: where its u and v are read off, (2, 3).
    """

    shares: dict[str, float]
    lit: str
    vectors: tuple[Vector, ...]
    center: Floats
    ideal: Floats
    foots: Floats


def stages_of(camera: Camera) -> tuple[str, ...]:
    """Return the stages of a camera's formula."""
    return STAGES if camera.lens is None else LENS_STAGES


def lit_in(formula: str, stage: str, notation: Notation = "book") -> str:
    """Return the part of a formula, in LaTeX, that a stage adds; "" if that is not in it."""
    if stage == "centre" and formula.startswith(
        tuple(latex(name, notation) + " = " for name in "uv")
    ):
        return formula
    if stage == "ray" and formula.startswith(
        (*ENDS, *(latex(rf"\mathbf{{{name}}}", notation) for name in "pdr"))
    ):
        return formula
    known = [latex(term, notation) for term in _LIT.get(stage, ())]
    if stage == "w" and formula.endswith(r"= -\mathbf{w}"):
        known = [r"-\mathbf{w}"]
    return next((term for term in known if term in formula), "")


def shares(position: float, stages: tuple[str, ...] = STAGES) -> dict[str, float]:
    """Return the drawn part of each stage."""
    return {
        stage: min(max((position - number) / GROWS, 0.0), 1.0)
        for number, stage in enumerate(stages)
    }


def stage_at(position: float, stages: tuple[str, ...] = STAGES) -> str:
    """Return the last stage that has begun at a position; "" at the end, when nothing is to
    be pointed out.
    """
    return stages[max(math.ceil(position) - 1, 0)] if position < len(stages) else ""


def growth(camera: Camera, size: Size, pixel: Pixel, position: float) -> Growth:
    """Return the formula of a pixel of an image of `size` at a position."""
    stages = stages_of(camera)
    part = {name: _eased(share) for name, share in shares(position, stages).items()}
    x, y = (float(value) for value in camera.image_point(*pixel, size))
    center = image_point(camera, x, y)
    vectors = (_parallel if camera.is_parallel else _perspective)(camera, x, y, part)
    foots = image_point(camera, [x, 0.0], [0.0, y])
    begun = tuple(one for one in vectors if (one.start != one.end).any())
    ideal = ideal_point(camera, x, y)
    return Growth(part, stage_at(position, stages), begun, center, ideal, foots)


def _perspective(camera: Camera, x: float, y: float, part: dict[str, float]) -> Iterator[Vector]:
    at, texts = np.asarray(camera.eye, float), ("-d vec(w)", "u vec(u)", "v vec(v)")
    along = x, y, -camera.distance
    if camera.lens is not None:
        along = ways(camera, x, y).tolist()
        texts = _LENS_TEXTS[camera.lens.model == "brown"]
    for name, text, term in (
        ("w", texts[0], along[2] * np.asarray(camera.w)),
        ("u", texts[1], along[0] * np.asarray(camera.u)),
        ("v", texts[2], along[1] * np.asarray(camera.v)),
    ):
        yield Vector(name, name, text, at, at + part[name] * term)  # type: ignore[arg-type]
        at = at + term
    eye = np.asarray(camera.eye, float)
    yield Vector("d", "ray", "vec(d)", eye, eye + part["ray"] * (at - eye))


def _parallel(camera: Camera, x: float, y: float, part: dict[str, float]) -> Iterator[Vector]:
    eye, u, v, w = (np.asarray(a, float) for a in (camera.eye, camera.u, camera.v, camera.w))
    slid = eye + part["u"] * x * u
    yield Vector("u", "u", "u vec(u)", eye, slid)
    origin = slid + part["v"] * y * v
    yield Vector("v", "v", "v vec(v)", slid, origin)
    yield Vector("d", "ray", "vec(d)", origin, origin - part["w"] * w)


def _eased(share: float) -> float:
    return share * share * (3 - 2 * share)


def grown_diagram(content: Content) -> list[Item]:
    """Return diagram() with the marked pixel's formula, if the options ask for it."""
    camera, size, options, marked = content.camera, content.size, content.options, content.marked
    notation = content.notation
    if options.formula is None or marked is None or not options.ray:
        return diagram(content)
    if camera.lens is not None and not np.isfinite(camera.ray(*marked.pixel, size).direction).all():
        return diagram(content)  # which says that the pixel is outside of the lens
    without = replace(content, options=replace(options, ray=False))
    if options.simple:
        return diagram(without) + simple_ray(
            camera, size, marked.pixel, content.base, options.formula, options.numbers
        )
    if options.to_parallel and camera.lens is None and not camera.is_parallel:
        return in_notation(_turning(without, marked.pixel, options.to_parallel), notation)
    complete = options.formula >= len(stages_of(camera))
    items = _thin_basis(diagram(content if complete else without))
    now = growth(camera, size, marked.pixel, options.formula)
    if not complete:
        items += in_notation(
            _pixel(camera, size, marked.pixel, now, washed=not options.image), notation
        )
        items += _ray(camera, marked, now, content.end)
    terms = [item for vector in now.vectors for item in _vector(vector, now, camera)]
    items += in_notation(terms, notation)
    return _with_numbers(items, content, marked.pixel) if options.numbers else items


def _thin_basis(items: Iterable[Item]) -> list[Item]:
    """Return items with a thinner basis, next to the terms along it."""
    return [
        replace(item, width=THIN, head=9.0)
        if isinstance(item, Arrow) and item.name in BASIS
        else item
        for item in items
    ]


def _with_numbers(items: Iterable[Item], content: Content, pixel: Pixel) -> list[Item]:
    """Return items whose labels have numbers in place of the formula's letters."""
    camera, size = content.camera, content.size
    x, y = (float(one) for one in camera.image_point(*pixel, size))
    row, column = (one + content.base for one in pixel)
    direction = [round(one, 2) for one in camera.ray(*pixel, size).direction.tolist()]
    texts = {
        "eye": f"vec(e) = {text_tuple(camera.eye)}",
        "pixel": f"({row}, {column})",
        "centre": text_tuple((x, y)),
        "term u": f"{number(x)} vec(u)",
        "term v": f"{number(y)} vec(v)",
        "term d": f"vec(d) = {text_tuple(direction)}",
    }
    if not camera.is_parallel:
        texts["term w"] = f"{number(-camera.distance)} vec(w)"
    return [
        replace(item, text=texts.get(item.name, item.text)) if isinstance(item, Label) else item
        for item in items
    ]


def _turning(content: Content, pixel: Pixel, share: float) -> list[Item]:
    """Return the formula on its way from perspective to parallel.

    The viewport moves back to the eye, and u **u** and v **v** with it. Each ray still goes through
    its pixel: its origin slides away from the eye, and its direction turns to -**w**.

    content: without the marked pixel's ray. share: of the way, more than 0.
    """
    camera, size, options = content.camera, content.size, content.options
    eye, u, v, w = (np.asarray(a, float) for a in (camera.eye, camera.u, camera.v, camera.w))
    left, back = 1 - share, camera.distance * w
    moved = replace(camera, eye=three(eye + share * back))
    bare = replace(options, image=False, grid=False, volume=False, points=())
    items = _thin_basis(diagram(replace(content, options=bare, hits=(), number_step=None)))
    items += plane_items(replace(content, camera=moved))

    def ray(one: Pixel) -> tuple[Floats, Floats]:
        """Return a pixel's origin and direction."""
        x, y = camera.image_point(*one, size)
        across = float(x) * u + float(y) * v
        return eye + (1 - left**2) * across, left * across - back

    for hit in content.hits:
        origin, way = ray(hit.pixel)
        line = np.array([[origin, origin + content.end * way]])
        items.append(Segments(f"bundle {hit.pixel}", "ray", line, 1.4, 0.55, 0.25, layer=2))
    x, y = (float(one) for one in camera.image_point(*pixel, size))
    middle, corners = eye - left * back, pixel_corners(moved, pixel, size)
    origin, way = ray(pixel)
    d = origin + (left + share / camera.distance) * way
    items += [
        Face("pixel", "mark", corners, 0.5, on_plane=True, layer=2),
        Segments("pixel", "mark", polyline(corners, True), 1.6, on_plane=True, layer=3),
        Segments("ray", "ray", np.array([[origin, origin + content.end * way]]), 2.6, hidden=0.6,
                 layer=3),
        Dot("p", "ray", origin, 6.0, layer=5),
        Label("p", "ray", "vec(p)", origin, away=origin - v, strong=True),
    ]  # fmt: skip
    complete = growth(camera, size, pixel, len(STAGES))
    for name, role, text, start, end in (
        ("w", "w", "-d vec(w)", eye, middle),
        ("u", "u", "u vec(u)", middle, middle + x * u),
        ("v", "v", "v vec(v)", middle + x * u, middle + x * u + y * v),
        ("d", "ray", "vec(d)", origin, d),
    ):
        if np.linalg.norm(end - start) > 1e-3 * camera.distance:
            vector = Vector(name, role, text, start, end)  # type: ignore[arg-type]
            items += _vector(vector, complete, camera)
    return items


def _pixel(camera: Camera, size: Size, pixel: Pixel, now: Growth, washed: bool) -> list[Item]:
    """Return the pixel, then its centre, with the lines that lead to its u and v."""
    part, corners = now.shares, pixel_corners(camera, pixel, size)
    middle = image_point(camera, 0.0, 0.0)
    items: list[Item] = [
        Segments("pixel", "mark", polyline(corners, True), 1.6, on_plane=True, layer=3)
    ]
    if washed:
        fill = 0.5 * part["pixel"]
        items.append(Face("pixel", "mark", corners, fill, on_plane=True, layer=2))
    if now.lit == "pixel":
        items.append(Label("pixel", "mark", "(i, j)", now.center, away=middle, strong=True))
    if part["centre"] > 0:
        items.append(Dot("pixel", "mark", now.center, 4.0 * part["centre"], on_plane=True, layer=5))
    if now.lit == "centre":
        reached = now.foots + part["centre"] * (now.center - now.foots)
        lines = np.stack([now.foots, reached], axis=1)
        items.append(Segments("foots", "mark", lines, 1.6, dashed=True, on_plane=True, layer=3))
        items.append(Label("centre", "mark", "(u, v)", now.center, away=middle, strong=True))
    share = part.get("undistort", 0.0)
    if share > 0:
        reached = now.center + share * (now.ideal - now.center)
        way = np.array([[now.center, reached]])
        items.append(Segments("lens", "mark", way, 2.2, on_plane=True, layer=4))
        items.append(Dot("ideal", "ray", reached, 4.0, on_plane=True, layer=5))
    if now.lit == "undistort":
        items.append(Label("ideal", "ray", "(a, b)", now.ideal, away=now.center, strong=True))
    return items


def _vector(vector: Vector, now: Growth, camera: Camera) -> list[Item]:
    """Return a term with its label, on the side where no other term is."""
    up = np.asarray(camera.v) * _sign((now.center - now.foots[0]) @ camera.v)
    out = np.asarray(camera.u) * _sign((now.center - now.foots[1]) @ camera.u)
    aside = {"w": -up, "u": -up, "v": out, "d": up}[vector.name]
    middle = (vector.start + vector.end) / 2
    return [
        Arrow(f"term {vector.name}", vector.role, vector.start, vector.end, 4.2, layer=4),
        Label(
            f"term {vector.name}",
            vector.role,
            vector.text,
            middle,
            away=middle - aside,
            strong=True,
            line=np.array([vector.start, vector.end]),
            lit=now.lit == {"d": "ray"}.get(vector.name, vector.name),
        ),
    ]


def _sign(value: float) -> float:
    return -1.0 if value < 0 else 1.0


def _ray(camera: Camera, marked: RayEnd, now: Growth, end: float) -> list[Item]:
    """Return the ray itself, through the pixel's centre to its hit, as far as it has grown."""
    share = now.shares["ray"]
    if share == 0:
        return []
    way = next(one for one in now.vectors if one.name == "d")
    reached = way.start + share * marked.t_or(end) * (way.end - way.start) / (
        1.0 if camera.is_parallel else share
    )
    items: list[Item] = [
        Segments("ray", "ray", np.array([[way.start, reached]]), 2.6, hidden=0.6, layer=3)
    ]
    if marked.is_hit and share == 1:
        items.append(Dot("hit", "mark", reached, 6.0))
    return items
