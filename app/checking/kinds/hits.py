"""Intersection of a ray with a sphere, a triangle, and the nearest of several objects.

An answer is t, inf for a miss. For the nearest object it is its number from 0 and t; -1 and inf for
a miss.

Tolerances. For a sphere, let M = |o| + |c| + r; no intermediate result exceeds M^2 |d|^2. The
discriminant cancels to (s |d|)^2, where s is half of the chord, and its root has an error of
FLOAT32 * M^2 / (2 s) relative to |d|: t is correct within FLOAT32 * (M + M^2 / (2 s)) / |d|.
For a triangle, let L be the longest edge, M = |o| + the farthest corner, and n the cross product of
two edges. The numerator n . (a - o) has an error of FLOAT32 * L^2 M, the denominator of
FLOAT32 * L^2 |d|: t is correct within FLOAT32 * L^2 (M + t |d|) / |n . d|. Tasks use only rays
for which rounding cannot turn a hit into a miss: MARGIN (shapes.py) is a thousand times the
rounding of float32.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from lucida.app.checking.cases import generator, point, rounded
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.checking.words import FIRST_CASES, described

from .kind import FLOAT32, CheckKind, Floats, in_order, is_miss, named, number, text_of
from .shapes import hits, tolerance

if TYPE_CHECKING:
    from numpy.random import Generator as Random

MARGIN = 0.05
MISS = (-1.0, np.inf)
Place = Literal["ahead", "beside", "behind", "around"]
Values = dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class HitKind(CheckKind):
    """A ray and one object, or several.

    rays, objects: combined with each other in the first cases. A ray is an origin and a direction.
    shape: the type of the one object; "" for several of both types.
    places: the generated objects' places, in turn; see _sphere and _triangle.
    """

    rays: list[tuple[list[float], list[float]]]
    objects: list[list[Values]]
    places: list[Place]
    shape: str = ""

    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        made = [
            ({"origin": origin, "direction": direction}, objects)
            for (origin, direction), objects in product(self.rays, self.objects)
        ]
        make = self._one_object if self.shape else _several_objects
        made += [make(random, number) for number in range(task.count)]
        return [self._case(task, *one) for one in made]

    def _one_object(self, random: Random, number: int) -> tuple[Values, list[Values]]:
        ray = _ray(random)
        return ray, [_object(random, ray, self.shape, self.places[number % len(self.places)])]

    def _case(self, task: CheckTask, ray: Values, objects: list[Values]) -> CheckCase:
        met = [*_all_hits(ray, objects), np.inf]
        first = int(np.argmin(met))
        t, near, right = met[first], 0.0, MISS
        if t < np.inf:
            near = tolerance(**ray, shape=objects[first], t=t, rounding=FLOAT32)
            right = (float(first), t)
        values = {**ray, "ray": ray, "objects": objects}
        if not self.shape:
            return CheckCase(named(task, values), right, near, values)
        values |= objects[0] | {self.shape: objects[0]}
        return CheckCase(named(task, values), t, near, values)

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> Any:
        if self.shape:
            return parameter(value)
        returns = task.conventions.returns
        value = in_order(value, returns)
        if is_miss(value):
            return MISS
        if not isinstance(value, list) or len(value) != 2:
            return None
        which, t = (value[returns.index(name)] for name in self.returns)
        if is_miss(t):
            return MISS
        found = number(which), number(t)
        return None if None in found else np.array(found) - (task.conventions.base, 0)

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        if np.isinf(np.ravel(answer)[-1]):
            return "None (no hit)"
        if self.shape:
            return text_of(float(answer))
        return super().answer_text(task, case, answer)

    def parts(self, task: CheckTask, case: CheckCase, answer: Any) -> dict[str, Any]:
        return {"object": answer[0] + task.conventions.base, "t": float(answer[1])}


SPHERE = HitKind(**described("hit-sphere"), shape="sphere", **FIRST_CASES["hit-sphere"])
TRIANGLE = HitKind(**described("hit-triangle"), shape="triangle", **FIRST_CASES["hit-triangle"])
CLOSEST = HitKind(**described("closest-hit"), **FIRST_CASES["closest-hit"])


def parameter(value: Any) -> float | None:
    """Return t, inf for a miss. Also accepts (hit, t), which some courses return."""
    if isinstance(value, list) and len(value) == 2 and isinstance(value[0], bool):
        value = value[1] if value[0] else None
    if isinstance(value, dict) and "t" in value:
        value = value["t"]
    return np.inf if is_miss(value) else number(value)


def _all_hits(ray: Values, objects: list[Values]) -> list[float]:
    return [float(hits(**ray, shape=shape)[0]) for shape in objects]


def _several_objects(random: Random, number: int) -> tuple[Values, list[Values]]:
    """Return a ray and objects, of which it hits at least `number` % 3."""
    while True:
        ray, objects = _ray(random), []
        for _ in range(int(random.integers(2, 7))):
            shape = "sphere" if random.random() < 0.6 else "triangle"
            objects.append(_object(random, ray, shape, random.choice(CLOSEST.places)))
        met = np.sort(_all_hits(ray, objects))
        met = met[np.isfinite(met)]
        if met.size >= number % 3 and np.all(np.diff(met) > 0.02 * met[1:]):
            return ray, objects


def _ray(random: Random) -> Values:
    """Return a ray. Its direction has a length from 0.4 to 3, which exposes code that assumes 1."""
    unit = _unit(random.normal(size=3))
    direction = np.round(unit * random.uniform(0.4, 3.0), 3).tolist()
    return {"origin": list(point(random)), "direction": direction}


def _object(random: Random, ray: Values, kind: str, place: Place) -> Values:
    """Return an object that the ray clearly hits, or clearly misses.

    place: ahead of the ray, which hits it; next to the ray; behind it; or around its origin.
    """
    make = _sphere if kind == "sphere" else _triangle
    while True:
        shape = {"type": kind, **make(random, ray, place)}
        if _is_clear(ray, shape):
            return shape


def _sphere(random: Random, ray: Values, place: Place) -> Values:
    radius = rounded(random.uniform(0.4, 2.0))
    unit = _unit(ray["direction"])
    aside = _unit(np.cross(unit, random.normal(size=3)))
    offset = random.uniform(1.1, 2.0) if place == "beside" else random.uniform(0.0, 0.9)
    away = random.uniform(0.0, 0.3) if place == "around" else random.uniform(1.3, 4.0)
    away = -away if place == "behind" else away
    center = ray["origin"] + radius * (offset * aside + away * unit)
    return {"center": np.round(center, 3).tolist(), "radius": radius}


def _triangle(random: Random, ray: Values, place: Place) -> Values:
    """Return a triangle. If it is next to the ray, the ray hits its plane beyond an edge."""
    corners = random.uniform(-2.0, 2.0, (3, 3))
    weights = random.dirichlet((2.0, 2.0, 2.0))
    if place == "beside":
        weights[random.integers(3)] *= -1.0
        weights += (1 - weights.sum()) / 3
    away = random.uniform(1.0, 4.0) * (-1 if place == "behind" else 1)
    corners += ray["origin"] + away * _unit(ray["direction"]) - weights @ corners
    return dict(zip("abc", np.round(corners, 3).tolist(), strict=True))


def _unit(vector: ArrayLike) -> Floats:
    values = np.asarray(vector, float)
    return values / np.linalg.norm(values)


def _is_clear(ray: Values, shape: Values) -> bool:
    """Return True if rounding cannot turn a hit into a miss, or a miss into a hit.

    A triangle must be neither thin nor seen edge-on, so that float32 keeps the digits of t.
    """
    if shape["type"] == "triangle":
        a, b, c = (np.array(shape[name]) for name in "abc")
        longest = max(float(np.linalg.norm(edge)) for edge in (b - a, c - a, c - b))
        facing = abs(float(np.cross(b - a, c - a) @ ray["direction"]))
        if not facing > 0.1 * longest**2 * float(np.linalg.norm(ray["direction"])) > 0.02:
            return False
    return bool(hits(**ray, shape=shape)[1] > MARGIN)
