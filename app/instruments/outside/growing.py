"""The key formula as it grows: the viewing ray of a pixel, term by term, head to tail. Pure.

In perspective, -d **w**, u **u** and v **v** lead from the eye to the pixel's centre; their sum is
the direction. In parallel projection, the direction is -**w**, and the origin slides over the
viewport by u **u** and v **v**. A lens has no such formula: its camera is drawn without one.

A position counts stages: 2.5 is halfway through the third one.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lucida.app.state.options.outside import STAGES
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, three

from .camera_diagram import Content, diagram, plane_items
from .diagram import Arrow, Dot, Item, Label, Role, Segments, line, named_dot, term
from .frustum import image_point, on_ray
from .pixel_drawing import pixel_square
from .simple_camera import simple_ray

GROWS = 0.7  # the growing share of a stage's time; the class can look in the rest
ENDS = (r"\text{origin}", r"\text{direction}")  # names of a ray's parts that a lecture may write
# The part that a stage adds to a formula of the probe or of the lecture.
_LIT = {
    "pixel": "(i, j)",
    "centre": "u, v",
    "w": r"d\,\mathbf{w}",
    "u": r"u\,\mathbf{u}",
    "v": r"v\,\mathbf{v}",
    "ray": r"\mathbf{r}(t)",
}


class Term(NamedTuple):
    """A term of the formula, drawn from start to end, (3,) each. text: its label."""

    name: str
    role: Role
    text: str
    start: Floats
    end: Floats


def stage_at(position: float | None, camera: Camera) -> str:
    """Return the last stage that has begun at a position; "" if nothing is highlighted."""
    if position is None or position >= len(STAGES) or camera.lens is not None:
        return ""
    return STAGES[max(math.ceil(position) - 1, 0)]


def lit_in(formula: str, stage: str) -> str:
    """Return the part of a formula, in LaTeX, that a stage adds; "" if that is not in it."""
    whole = {
        "centre": [f"{name} = " for name in "uv"],
        "ray": [*ENDS, *(rf"\mathbf{{{name}}}" for name in "pdr")],
    }
    if formula.startswith(tuple(whole.get(stage, ()))):
        return formula
    if stage == "w" and formula.endswith(r"= -\mathbf{w}"):
        return r"-\mathbf{w}"
    added = _LIT[stage] if stage else ""
    return added if added in formula else ""


def stage_shares(position: float) -> dict[str, float]:
    """Return the drawn share of each stage, with a slow start and a slow end."""
    part = {stage: min(max((position - n) / GROWS, 0.0), 1.0) for n, stage in enumerate(STAGES)}
    return {stage: share * share * (3 - 2 * share) for stage, share in part.items()}


def terms(camera: Camera, x: float, y: float, share: Mapping[str, float]) -> list[Term]:
    """Return the terms that lead to (x, y) on the viewport, as far as they have grown, head to
    tail; the direction is the last one.
    """
    eye, (u, v, w) = np.asarray(camera.eye, float), camera.basis.T
    steps: list[tuple[Role, str, Floats]] = [("u", "u vec(u)", x * u), ("v", "v vec(v)", y * v)]
    if not camera.is_parallel:
        steps.insert(0, ("w", "-d vec(w)", -camera.distance * w))
    found, at = [], eye
    for name, text, step in steps:
        found.append(Term(name, name, text, at, at + share[name] * step))
        at = found[-1].end
    direction = share["ray"] * (x * u + y * v - camera.distance * w)
    if camera.is_parallel:
        direction = -share["w"] * w
    else:
        at = eye
    found.append(Term("d", "ray", "vec(d)", at, at + direction))
    return [one for one in found if (one.start != one.end).any()]


def grown_diagram(content: Content) -> list[Item]:
    """Return diagram(), with the marked pixel's formula if the options ask for it."""
    camera, size, options, marked = content.camera, content.size, content.options, content.marked
    is_asked = options.formula is not None and options.ray and marked is not None
    if not is_asked or camera.lens is not None:
        return diagram(content)
    assert options.formula is not None
    assert marked is not None
    without = replace(content, options=replace(options, ray=False))
    if options.simple:
        return diagram(without) + simple_ray(
            camera, size, marked.pixel, content.base, options.formula, options.numbers
        )
    if options.to_parallel and not camera.is_parallel:
        return _turning(without, marked.pixel, options.to_parallel)
    complete, share = options.formula >= len(STAGES), stage_shares(options.formula)
    items = _thin_basis(diagram(content if complete else without))
    x, y = (float(value) for value in camera.image_point(*marked.pixel, size))
    lit = stage_at(options.formula, camera)
    if not complete:
        items += _pixel(content, marked.pixel, x, y, share, lit)
        if share["ray"]:
            t = [0.0, share["ray"] * marked.t_or(content.end)]
            ends = on_ray(camera, marked.pixel, size, t)
            items.append(_ray(*ends))
            if marked.is_hit and share["ray"] == 1:
                items.append(Dot("hit", "mark", ends[1], 6.0))
    items += _drawn(terms(camera, x, y, share), camera, x, y, lit)
    return _with_numbers(items, content, marked.pixel) if options.numbers else items


def _thin_basis(items: Iterable[Item]) -> list[Item]:
    """Return the items with a thinner basis, because terms lie along it."""
    return [
        replace(item, width=1.6, head=9.0)
        if isinstance(item, Arrow) and item.name in ("u", "v", "w")
        else item
        for item in items
    ]


def _drawn(found: Iterable[Term], camera: Camera, x: float, y: float, lit: str) -> list[Item]:
    """Return terms with their labels, each on the side where no other term is."""
    up, out = math.copysign(1, y) * camera.basis[:, 1], math.copysign(1, x) * camera.basis[:, 0]
    aside = {"w": -up, "u": -up, "v": out, "d": up}
    items: list[Item] = []
    for one in found:
        is_lit = lit == {"d": "ray"}.get(one.name, one.name)
        items += term(f"term {one.name}", *one[1:], aside[one.name], is_lit)
    return items


def _pixel(
    content: Content, pixel: Pixel, x: float, y: float, share: Mapping[str, float], lit: str
) -> list[Item]:
    """Return the pixel, then its centre, with the lines that lead to its u and v."""
    camera, center = content.camera, image_point(content.camera, x, y)
    middle, foots = image_point(camera, 0.0, 0.0), image_point(camera, [x, 0.0], [0.0, y])
    fill = 0.0 if content.options.image else 0.5 * share["pixel"]
    items = pixel_square(camera, content.size, pixel, fill)
    if share["centre"] > 0:
        items.append(Dot("pixel", "mark", center, 4.0 * share["centre"], on_plane=True, layer=5))
    if lit == "centre":
        lines = np.stack([foots, foots + share["centre"] * (center - foots)], axis=1)
        items.append(Segments("foots", "mark", lines, 1.6, dashed=True, on_plane=True, layer=3))
    text = {"pixel": "(i, j)", "centre": "(u, v)"}.get(lit)
    if text is not None:
        items.append(Label(lit, "mark", text, center, away=middle, strong=True))
    return items


def _ray(start: Floats, end: Floats) -> Segments:
    return line("ray", "ray", start, end, 2.6, hidden=0.6, layer=3)


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
        "term w": f"{number(-camera.distance)} vec(w)",
        "term u": f"{number(x)} vec(u)",
        "term v": f"{number(y)} vec(v)",
        "term d": f"vec(d) = {text_tuple(direction)}",
    }
    return [
        replace(item, text=texts.get(item.name, item.text)) if isinstance(item, Label) else item
        for item in items
    ]


def _turning(content: Content, pixel: Pixel, share: float) -> list[Item]:
    """Return the formula in transition from perspective to parallel.

    The viewport moves back to the eye, and u **u** and v **v** with it. Each ray still goes through
    its pixel: its origin slides away from the eye, and its direction turns to -**w**.

    content: a content without the marked pixel's ray. share: the share of the transition, above 0.
    """
    camera, size = content.camera, content.size
    eye, (u, v, w) = np.asarray(camera.eye, float), camera.basis.T
    left, back = 1 - share, camera.distance * w
    moved = replace(camera, eye=three(eye + share * back))
    bare = replace(content.options, image=False, grid=False, volume=False, points=())
    items = _thin_basis(diagram(replace(content, options=bare, hits=(), number_step=None)))
    items += plane_items(replace(content, camera=moved))

    def ray(one: Pixel) -> tuple[Floats, Floats]:
        """Return a pixel's origin and direction."""
        x, y = camera.image_point(*one, size)
        across = float(x) * u + float(y) * v
        return eye + (1 - left**2) * across, left * across - back

    for hit in content.hits:
        origin, way = ray(hit.pixel)
        end, pale = origin + content.end * way, {"opacity": 0.55, "hidden": 0.25}
        items.append(line(f"bundle {hit.pixel}", "ray", origin, end, 1.4, layer=2, **pale))
    x, y = (float(one) for one in camera.image_point(*pixel, size))
    origin, way = ray(pixel)
    items += [
        *pixel_square(moved, size, pixel, 0.5),
        _ray(origin, origin + content.end * way),
        *named_dot("p", "ray", "vec(p)", origin, origin - v, layer=5),
    ]
    found = terms(camera, x, y, {"w": left, "u": 1.0, "v": 1.0, "ray": 0.0})
    end = origin + (left + share / camera.distance) * way
    found.append(Term("d", "ray", "vec(d)", origin, end))
    least = 1e-3 * camera.distance
    found = [one for one in found if float(np.linalg.norm(one.end - one.start)) > least]
    return items + _drawn(found, camera, x, y, lit="")
