"""Lines and mistakes for the intersection of a ray with a sphere, a triangle, and the nearest of
several objects.

t is infinite for a miss.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.program import CodeLine, Mistake, Program

RAY = "A ray is half a line"
NEAREST = "Ray tracing"
BEHIND = "What has t < 0 lies behind the ray's origin: it is not on the ray."
DISTANCE = (
    "t counts in lengths of the direction: the point is p + t d. That is the distance, t |d|."
)


def _one(name: str, key: str, code: str, hint: str, part: str = RAY) -> Mistake:
    return Mistake(name, ((key, code),), hint, part)


SPHERE = Program(
    (
        CodeLine("from_center", "from_center = origin - center"),
        CodeLine("a", "a = dot(direction, direction)"),
        CodeLine("b", "b = 2 * dot(direction, from_center)"),
        CodeLine("c", "c = dot(from_center, from_center) - radius**2"),
        CodeLine("discriminant", "discriminant = b**2 - 4*a*c"),
        CodeLine("near", "near = (-b - sqrt(discriminant)) / (2*a)"),
        CodeLine("far", "far = (-b + sqrt(discriminant)) / (2*a)"),
        CodeLine("t", "t = where(near > 0, near, far)"),
        CodeLine("hit", "t = where((discriminant >= 0) & (t > 0), t, inf)"),
    ),
    (
        _one("the far root", "t", "t = far", "Of two roots, the smaller t > 0 is the nearer hit."),
        _one("t < 0 accepted", "hit", "t = where(discriminant >= 0, t, inf)", BEHIND),
        Mistake(
            "the smaller root, whatever its sign",
            (("t", "t = near"), ("hit", "t = where(discriminant >= 0, t, inf)")),
            BEHIND,
            RAY,
        ),
        _one("not from inside", "t", "t = near",
             "From inside the smaller root is behind: then the larger one is the hit."),
        _one("the direction taken for a unit vector", "a", "a = 1",
             "The direction is of any length: a = d . d, not 1."),
        _one("the distance for t", "hit",
             "t = where((discriminant >= 0) & (t > 0), t * norm(direction), inf)", DISTANCE),
        _one("the radius not squared", "c", "c = dot(from_center, from_center) - radius",
             "Points of the sphere have |p - c|^2 = r^2: square the radius."),
        _one("from the origin to the centre", "from_center", "from_center = center - origin",
             "p + t d - c has the part p - c: from the centre to the ray's origin."),
        _one("b without its 2", "b", "b = dot(direction, from_center)",
             "|p + t d - c|^2 has the part 2 t d . (p - c)."),
        Mistake(
            "not divided by a",
            (
                ("near", "near = (-b - sqrt(discriminant)) / 2"),
                ("far", "far = (-b + sqrt(discriminant)) / 2"),
            ),
            "The roots are divided by 2 a, with a = d . d.",
            RAY,
        ),
        Mistake(
            "2 a without brackets",
            (
                ("near", "near = (-b - sqrt(discriminant)) / 2*a"),
                ("far", "far = (-b + sqrt(discriminant)) / 2*a"),
            ),
            "/ 2*a divides by 2 and multiplies by a: write / (2*a).",
            RAY,
        ),
        _one("4 a c added", "discriminant", "discriminant = b**2 + 4*a*c",
             "The discriminant is b^2 - 4 a c."),
        _one("a c without its 4", "discriminant", "discriminant = b**2 - a*c",
             "The discriminant is b^2 - 4 a c; it is b^2 - a c where b has no 2."),
        _one("hit and miss exchanged", "hit", "t = where((discriminant < 0) & (t > 0), t, inf)",
             "With a discriminant below 0 there is no root: the ray misses."),
        _one("the centre left out", "from_center", "from_center = origin",
             "The sphere is at its centre c, not at the world's origin: p - c."),
        _one("the origin left out", "from_center", "from_center = -center",
             "The ray begins at its origin p, not at the world's: p - c."),
    ),
    ("t",),
)  # fmt: skip

_INSIDE = "inside = (alpha >= 0) & (beta >= 0) & (gamma >= 0)"
TRIANGLE = Program(
    (
        CodeLine("normal", "normal = cross(b - a, c - a)"),
        CodeLine("t", "t = dot(normal, a - origin) / dot(normal, direction)"),
        CodeLine("point", "point = origin + t*direction"),
        CodeLine("alpha", "alpha = dot(normal, cross(c - b, point - b))"),
        CodeLine("beta", "beta = dot(normal, cross(a - c, point - c))"),
        CodeLine("gamma", "gamma = dot(normal, cross(b - a, point - a))"),
        CodeLine("inside", _INSIDE),
        CodeLine("hit", "t = where(inside & (t > 0) & (t < inf), t, inf)"),
    ),
    (
        _one("t < 0 accepted", "hit", "t = where(inside, t, inf)", BEHIND),
        _one("the whole plane", "inside", "inside = t == t",
             "The ray meets the plane there: whether inside the triangle, three edges must say."),
        _one(
            "the parallelogram",
            "inside",
            "inside = (beta >= 0) & (gamma >= 0) & (beta + alpha >= 0) & (gamma + alpha >= 0)",
            "That is the parallelogram of two edges: alpha = 1 - beta - gamma must not be "
            "below 0 either.",
        ),
        _one("the edge b c not asked", "inside", "inside = (beta >= 0) & (gamma >= 0)",
             "All three edges are asked: alpha, that of b c, must not be below 0."),
        _one("the edge c a not asked", "inside", "inside = (alpha >= 0) & (gamma >= 0)",
             "All three edges are asked: beta, that of c a, must not be below 0."),
        _one("the edge a b not asked", "inside", "inside = (alpha >= 0) & (beta >= 0)",
             "All three edges are asked: gamma, that of a b, must not be below 0."),
        _one("seen from one side only", "inside", f"{_INSIDE} & (dot(normal, direction) < 0)",
             "Both sides of the triangle count: do not leave out what faces away."),
        _one("seen from the back only", "inside", f"{_INSIDE} & (dot(normal, direction) > 0)",
             "Both sides of the triangle count, and the front faces the ray."),
        _one("the distance for t", "hit",
             "t = where(inside & (t > 0) & (t < inf), t * norm(direction), inf)", DISTANCE),
        _one("the origin minus the corner", "t",
             "t = dot(normal, origin - a) / dot(normal, direction)",
             "n . (p + t d - a) = 0 gives t = n . (a - p) / n . d."),
        _one("the corner left out", "t", "t = -dot(normal, origin) / dot(normal, direction)",
             "The plane goes through a: t = n . (a - p) / n . d."),
        Mistake(
            "the origin left out",
            (
                ("t", "t = dot(normal, a) / dot(normal, direction)"),
                ("point", "point = t*direction"),
            ),
            "The ray begins at its origin p, not at the world's: p + t d.",
            RAY,
        ),
        _one("outside for inside", "inside", "inside = (alpha < 0) | (beta < 0) | (gamma < 0)",
             "Inside, none of the three is below 0."),
    ),
    ("t",),
)  # fmt: skip

CLOSEST = Program(
    (
        CodeLine("start", "best, number = inf, -1"),
        CodeLine("loop", "for k, shape in enumerate(objects):"),
        CodeLine("t", "    t = hit(origin, direction, shape)"),
        CodeLine("if", "    if t < best:"),
        CodeLine("keep", "        best, number = t, k"),
        CodeLine("answer", "answer = number, best"),
    ),
    (
        _one("the last object wins", "if", "    if t < inf:",
             "The nearest hit wins: compare with the smallest t so far, and keep it.", NEAREST),
        _one("the first object wins", "if", "    if t < inf and number < 0:",
             "The nearest hit wins, not the first one in the list: go on to the end.", NEAREST),
        _one("the farthest wins", "if", "    if t < inf and (number < 0 or t > best):",
             "The smallest t > 0 is the nearest hit, not the largest.", NEAREST),
        _one("t < 0 accepted", "t", "    t = first_crossing(origin, direction, shape)", BEHIND,
             NEAREST),
        _one("the far root", "t", "    t = last_crossing(origin, direction, shape)",
             "Of two crossings of one object, the smaller t > 0 is the nearer hit.", NEAREST),
        _one("objects counted from 1", "keep", "        best, number = t, k + 1",
             "Objects count from 0: the first one's number is 0.", NEAREST),
        _one("objects counted from 0", "keep", "        best, number = t, k - 1",
             "Objects count from 1: the first one's number is 1.", NEAREST),
        _one("the distance for t", "answer", "answer = number, best * norm(direction)", DISTANCE,
             NEAREST),
        _one("spheres alone", "t",
             "    t = hit(origin, direction, shape) if shape['type'] == 'sphere' else inf",
             "Triangles are objects as well: ask them, too.", NEAREST),
        _one("triangles alone", "t",
             "    t = hit(origin, direction, shape) if shape['type'] == 'triangle' else inf",
             "Spheres are objects as well: ask them, too.", NEAREST),
        _one("the last object is not asked", "loop", "for k, shape in enumerate(objects[:-1]):",
             "All objects are asked: the loop ends one too early.", NEAREST),
        _one("the first object is not asked", "loop",
             "for k, shape in list(enumerate(objects))[1:]:",
             "All objects are asked, from number 0.", NEAREST),
    ),
    ("answer",),
)  # fmt: skip


def crossings(origin: Any, direction: Any, shape: Mapping[str, Any]) -> list[NDArray[np.float64]]:
    """Return all t, of any sign, at which the rays' lines hit a sphere or a triangle; NaN for a
    miss.

    origin, direction: (..., 3).
    shape: type, then center and radius, or a, b and c.
    """
    origin, direction = np.asarray(origin, float), np.asarray(direction, float)
    known = {name: np.asarray(value, float) for name, value in shape.items() if name != "type"}
    known |= {"origin": origin, "direction": direction}
    if shape["type"] == "sphere":
        roots = Program(SPHERE.lines, SPHERE.mistakes, ("near", "far")).run(known)
    else:
        accepted = next(one for one in TRIANGLE.mistakes if one.name == "t < 0 accepted")
        roots = TRIANGLE.run(known, (accepted,))
        roots = tuple(np.where(np.isfinite(root), root, np.nan) for root in roots)
    return [root[..., 0] for root in roots]


def _least(found: list[NDArray[np.float64]], positive: bool = True) -> Any:
    made = [np.where(np.isnan(t) | (positive & (t <= 0)), np.inf, t) for t in found]
    return np.minimum.reduce(made)


def hit(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the smallest t > 0."""
    return _least(crossings(origin, direction, shape))


def first_crossing(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the smallest t of any sign."""
    return _least(crossings(origin, direction, shape), positive=False)


def last_crossing(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
    """Return the largest t > 0."""
    found = [np.where(t > 0, t, -np.inf) for t in crossings(origin, direction, shape)]
    last = np.maximum.reduce(found)
    return np.where(last > 0, last, np.inf)


SHAPES = {"hit": hit, "first_crossing": first_crossing, "last_crossing": last_crossing}
