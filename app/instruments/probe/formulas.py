"""A pixel's viewing ray as the lecture writes it down, line by line, with the pixel's numbers.

These are the lines from the pixel to the hit. color_formulas.py has those of the colour,
notation.py the format of numbers.

Symbols: i, j the pixel, H, W the image, u, v its position on the image plane (bold: the basis),
d the distance of the viewport, bold d the direction, bold p the origin.
"""

from __future__ import annotations

import numpy as np

from lucida.app.ui.explaining.notation import (
    Line,
    Slot,
    bold,
    formula,
    latex_number,
    results,
    scalar_slot,
    vector_slot,
)
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import Indexing

from .lens_formulas import lens_lines
from .reading import Reading
from .shading import SurfaceHit

LECTURE_VIEWPORT = (-0.5, 0.5, -0.5, 0.5)
LEAST_COSINE = (
    1e-3  # between the light's normal and the viewer, as in renderer/trace/reference/shade.py
)


def ray_lines(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> list[Line]:
    """Return the lines for u, v; the direction in the camera's and in the world's coordinates; the
    origin; the ray; the valid range of t.
    """
    camera = reading.camera
    lines = [_on_plane(reading, indexing, axis) for axis in (0, 1)]
    way = _direction_and_origin(reading)
    lines += way if camera.lens is None else [*lens_lines(reading), way[-1]]
    if reading.is_outside:
        return lines[:-1]
    p, d = vector_slot("p", reading.origin), vector_slot("d", reading.direction)
    ray = Line(
        "ray",
        "ray",
        rf"\mathbf{{r}}(t) = {p.latex} + t\,{d.latex}",
        rf"= {p.latex_value} + t\,{d.latex_value}",
        (*reading.origin, *reading.direction),
    )
    return [*lines, ray, _range(camera)]


def hit_lines(reading: Reading) -> list[Line]:
    """Return the lines from the visible object to t, the hit and the normals. Empty for a miss."""
    hit = reading.hit
    if hit is None:
        return []
    found = _sphere_t(reading) if reading.sphere is not None else _triangle_t(reading)
    t = scalar_slot("t", hit.t, factor=True)
    p, d = vector_slot("p", reading.origin), vector_slot("d", reading.direction)
    point = formula(
        "point",
        "hit point",
        r"\mathbf{x} = \mathbf{r}(t)",
        r"<p> + <t>\,<d>",
        {"p": p, "t": t, "d": d},
        hit.point,
    )
    lines = [*found, point, _geometric_normal(reading)]
    if hit.has_own_normal:
        lines.append(_normal_for_light(hit))
    return lines


def pixel_text(reading: Reading, indexing: Indexing) -> str:
    """Return `row 3, column 5 of 1280 x 720, from 1`, in this indexing."""
    width, height = reading.size
    return f"{indexing.words(reading.pixel)} of {width} x {height}, {indexing.told}"


# The image plane.


def _on_plane(reading: Reading, indexing: Indexing, axis: int) -> Line:
    """Return the line for u (axis 0) or v (1) of the pixel's centre."""
    low, high = reading.camera.viewport[2 * axis : 2 * axis + 2]
    pixel, count = "ji"[axis], "WH"[axis]
    first, last = (r"\mathrm{left}", low), (r"\mathrm{right}", high)
    if axis:  # rows are counted from the top
        first, last = (r"\mathrm{top}", high), (r"\mathrm{bottom}", low)
    slots = {
        "p": Slot(pixel, str(reading.pixel[1 - axis] + indexing.value)),
        "n": Slot(count, str(reading.size[axis])),
        "a": scalar_slot(*first),
        "b": scalar_slot(*last, factor=bool(axis)),
        "af": scalar_slot(*first, factor=True),
    }
    part = rf"\frac{{<p> {indexing.offset}}}{{<n>}}"
    if reading.camera.viewport == LECTURE_VIEWPORT:
        right = rf"-\left({part} - 0.5\right)" if axis else f"{part} - 0.5"
    else:
        right = rf"<a> - (<a> - <b>)\,{part}" if axis else rf"<a> + (<b> - <af>)\,{part}"
    symbol = "uv"[axis]
    value = reading.y if axis else reading.x
    return formula(symbol, f"along {symbol}", symbol, right, slots, value)


# Direction and origin.


def _direction_and_origin(reading: Reading) -> list[Line]:
    camera, parallel = reading.camera, reading.camera.is_parallel
    slots = {
        **{name: vector_slot(name, getattr(camera, name)) for name in ("u", "v", "w")},
        "e": vector_slot("e", camera.eye),
        "x": scalar_slot("u", reading.x, factor=True),
        "y": scalar_slot("v", reading.y, factor=True),
        "d": scalar_slot("d", camera.distance, factor=True),
    }
    across = r"<x>\,<u> + <y>\,<v>"
    if parallel:
        in_camera, own = r"(0,\ 0,\ -1)", (0.0, 0.0, -1.0)
        direction, origin = "-<w>", f"<e> + {across}"
    else:
        in_camera, own = r"(u,\ v,\ -d)", (reading.x, reading.y, -camera.distance)
        direction, origin = rf"{across} - <d>\,<w>", "<e>"
    d, p = r"\mathbf{d}", r"\mathbf{p}"
    return [
        formula("camera direction", "direction, camera", rf"{d}_{{uvw}}", in_camera, {}, own),
        formula("direction", "direction, world", d, direction, slots, reading.direction),
        formula("origin", "origin", p, origin, slots, reading.origin),
    ]


def _range(camera: Camera) -> Line:
    """Return the line for the valid t: t > 0, or between near and far."""
    low, high = camera.t_range
    if camera.near is None and camera.far is None:
        return Line("range", "half a line", "t > 0", "", (low, high))
    near, far = (
        rf"\mathrm{{{name}}}" if camera.is_parallel else rf"\frac{{\mathrm{{{name}}}}}{{d}}"
        for name in ("near", "far")
    )
    near = "0" if camera.near is None else near
    far = r"\infty" if camera.far is None else far
    numbers = f"{latex_number(low)} < t < {latex_number(high)}"
    return Line("range", "clipped by near and far", f"{near} < t < {far}", numbers, (low, high))


# The hit on the visible object.


def _sphere_t(reading: Reading) -> list[Line]:
    """Return the lines for the quadratic a t^2 + 2 b t + c = 0 and its root."""
    assert reading.hit is not None
    assert reading.sphere is not None
    center, radius = reading.sphere
    d, f = np.array(reading.direction), np.subtract(reading.origin, center)
    a, b, c = float(d @ d), float(f @ d), float(f @ f - radius * radius)
    p, way = vector_slot("p", reading.origin), vector_slot("d", reading.direction)
    middle, r = vector_slot("c", center), scalar_slot("R", radius, factor=True)
    quadratic = Line(
        "sphere",
        "the sphere's points",
        r"|\mathbf{p} + t\,\mathbf{d} - \mathbf{c}|^2 = R^2",
        rf"|{p.latex_value} + t\,{way.latex_value} - {middle.latex_value}|^2 = {r.latex_value}^2",
        (a, b, c),
    )
    coefficients = Line(
        "coefficients",
        "a quadratic equation in t",
        r"a = \mathbf{d} \cdot \mathbf{d}, \quad b = \mathbf{d} \cdot (\mathbf{p} - \mathbf{c}),"
        r" \quad c = |\mathbf{p} - \mathbf{c}|^2 - R^2",
        "",
        (a, b, c),
    )
    t = reading.hit.t
    # The root with - is nearer; + applies if the ray begins, or is clipped, inside the sphere.
    sign = "-" if t <= -b / a else "+"
    slots = {
        "a": scalar_slot("a", a, factor=True),
        "b": scalar_slot("b", b, factor=True),
        "c": scalar_slot("c", c, factor=True),
    }
    right = rf"\frac{{-<b> {sign} \sqrt{{<b>^2 - <a> \cdot <c>}}}}{{<a>}}"
    root = formula("t", "its root", "t", right, slots, t)
    return [quadratic, coefficients, root]


def _triangle_t(reading: Reading) -> list[Line]:
    """Return the lines for the hit on the triangle's plane, and the test that it is inside."""
    hit = reading.hit
    assert hit is not None
    slots = {
        "n": vector_slot(_geometric_symbol(hit), hit.geometric),
        "a": vector_slot("a", reading.corners[0]),
        "p": vector_slot("p", reading.origin),
        "d": vector_slot("d", reading.direction),
    }
    plane = formula(
        "t",
        f"the plane of triangle {hit.primitive}",
        "t",
        r"\frac{<n> \cdot (<a> - <p>)}{<n> \cdot <d>}",
        slots,
        hit.t,
    )
    weights = (1 - hit.b1 - hit.b2, hit.b1, hit.b2)
    terms = {}
    for k, (letter, at) in enumerate(zip("abc", reading.corners, strict=True)):
        terms[f"b{k}"] = scalar_slot(f"b_{k}", weights[k], factor=True)
        terms[letter] = vector_slot(letter, at)
    right = r"<b0>\,<a> + <b1>\,<b> + <b2>\,<c>"
    name = "inside: no weight of a corner is negative"
    inside = formula("inside", name, r"\mathbf{x}", right, terms, weights, results(hit.point))
    return [plane, inside]


def _geometric_normal(reading: Reading) -> Line:
    hit = reading.hit
    assert hit is not None
    symbol = _geometric_symbol(hit)
    if reading.sphere is not None:
        center, _ = reading.sphere
        slots = {"x": vector_slot("x", hit.point), "c": vector_slot("c", center)}
        # This is 0 if a tiny sphere far away is rounded to its centre.
        outside = np.dot(hit.geometric, np.subtract(hit.point, center)) >= 0
        first, second = ("<x>", "<c>") if outside else ("<c>", "<x>")
        return formula(
            "geometric",
            "normal" if outside else "normal, towards the viewer",
            rf"\mathbf{{{symbol}}}",
            rf"\frac{{{first} - {second}}}{{|{first} - {second}|}}",
            slots,
            hit.geometric,
        )
    a, b, c = (np.array(corner) for corner in reading.corners)
    is_front = np.cross(b - a, c - a) @ np.array(hit.geometric) >= 0
    sign = "" if is_front else "-"
    product = r"\frac{(\mathbf{b} - \mathbf{a}) \times (\mathbf{c} - \mathbf{a})}{|\dots|}"
    name = "normal of the triangle, towards the viewer"
    return formula("geometric", name, bold(symbol), sign + product, {}, hit.geometric)


def _normal_for_light(hit: SurfaceHit) -> Line:
    """Return the line for the normal used for lighting, if it is not the surface's own."""
    if not hit.corner_normals:
        g, d = r"\mathbf{g}", r"\hat{\mathbf{d}}"
        right = rf"\frac{{{g} - ({g} \cdot {d} + {LEAST_COSINE:g})\,{d}}}{{|\dots|}}"
        name = "normal for the light, bent to the viewer"
        return formula("normal", name, bold("n"), right, {}, hit.normal)
    weights = (1 - hit.b1 - hit.b2, hit.b1, hit.b2)
    # Towards the viewer, too, even if the corners' normals point away.
    sign = "-" if np.dot(weights, hit.corner_normals) @ np.array(hit.normal) < 0 else ""
    corners = r"b_0 \mathbf{n}_a + b_1 \mathbf{n}_b + b_2 \mathbf{n}_c"
    right = rf"{sign}\frac{{{corners}}}{{|\dots|}}"
    name = "normal for the light, between the corners'"
    return formula("normal", name, bold("n"), right, {}, hit.normal)


def _geometric_symbol(hit: SurfaceHit) -> str:
    return "g" if hit.has_own_normal else "n"
