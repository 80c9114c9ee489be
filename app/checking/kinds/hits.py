"""Intersection of a ray with a sphere, a triangle, and the nearest of several objects.

Answers in the kind's own form: t, float64 (N,), inf for a miss; for the nearest object (N, 2): its
number from 0 and t, -1 and inf for a miss.

Tolerances. Sphere: with M = |o| + |c| + r, no intermediate result is larger than M^2 |d|^2. The
discriminant cancels to (s |d|)^2, where s is half of the chord, and its root has an error of
FLOAT32 * M^2 / (2 s) relative to |d|: t is correct within FLOAT32 * (M + M^2 / (2 s)) / |d|.
Triangle: let L be the longest edge, M = |o| + the farthest corner, and n the cross product of two
edges. The numerator n . (a - o) has an error of FLOAT32 * L^2 M, the denominator of
FLOAT32 * L^2 |d|: t is correct within FLOAT32 * L^2 (M + t |d|) / |n . d|. Rays are only asked for
where rounding cannot decide between hit and miss: MARGIN (shapes.py) is a thousand times the
rounding of float32.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.checking.cases import generator, point, rounded
from lucida.app.checking.kinds.kind import FLOAT32, Cases, CheckKind, Flags, named, tolerances
from lucida.app.checking.kinds.shapes import hits, tolerance
from lucida.app.checking.kinds.values import in_order, is_miss, number, text_of
from lucida.app.checking.tasks import CheckCase, CheckTask

if TYPE_CHECKING:
    from numpy.random import Generator as Random

Floats = NDArray[np.float64]

MARGIN = 0.05
Place = Literal["ahead", "beside", "behind", "around"]
_PLACES: tuple[Place, ...] = ("ahead", "ahead", "beside", "behind")
RAY_WORDS = {
    "origin": "where the ray starts",
    "direction": "where it goes; of any length",
    "ray": "an object with origin and direction",
}
Values = dict[str, Any]


class HitKind(CheckKind):
    """Base class for rays and objects.

    kind, fields: an object's type, and its fields.
    places: of the generated objects, in turn; see _sphere and _triangle.
    """

    answer = "a number t, or None"
    kind: ClassVar[str]
    fields: ClassVar[tuple[str, ...]]
    places: ClassVar[tuple[Place, ...]]

    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        made = [*self._simple(), *(self._made_up(random, n) for n in range(task.count))]
        return [self._case(task, values) for values in made]

    def _case(self, task: CheckTask, values: Values) -> CheckCase:
        ray = {name: values[name] for name in ("origin", "direction")}
        fields = {name: values[name] for name in self.fields}
        shape = {"type": self.kind, **fields}
        t = float(hits(**ray, shape=shape)[0])
        near = tolerance(**ray, shape=shape, t=t, rounding=FLOAT32)
        values = {**values, "ray": ray, self.kind: fields}
        return CheckCase(named(task, values), t, near, values)

    def _simple(self) -> list[Values]:
        raise NotImplementedError

    def _made_up(self, random: Random, number: int) -> Values:
        ray = _ray(random)
        return ray | _object(random, ray, self.kind, self.places[number % len(self.places)])

    def read(self, task: CheckTask, value: Any) -> Any:
        return parameter(value)

    def shape(self, task: CheckTask) -> tuple[int, ...]:
        return ()

    def wrong(self, task: CheckTask, cases: Cases, given: Floats) -> Flags:
        return _differ(self.right(cases), given, tolerances(cases))

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        return f"{float(answer):.6g}" if np.isfinite(answer) else "None (no hit)"


class SphereHitKind(HitKind):
    name = "hit-sphere"
    function = "hit_sphere"
    words: ClassVar[Mapping[str, str]] = {
        **RAY_WORDS,
        "center": "the sphere's centre",
        "radius": "its radius",
        "sphere": "an object with center and radius",
    }
    arguments = ("origin", "direction", "center", "radius")
    kind = "sphere"
    fields = ("center", "radius")
    places = ("ahead", "beside", "ahead", "behind", "around")

    def _simple(self) -> list[Values]:
        straight = {"origin": [0.0, 0.0, 5.0], "center": [0.0, 0.0, 0.0], "radius": 1.0}
        return [
            {**straight, "direction": [0.0, 0.0, -1.0]},
            {**straight, "direction": [0.0, 0.0, -2.0]},
            {**straight, "direction": [0.0, 0.0, 1.0]},
            {**straight, "direction": [0.0, 1.0, 0.0]},
            {**straight, "origin": [0.0, 0.0, 0.0], "direction": [0.0, 0.5, 0.0]},
        ]


class TriangleHitKind(HitKind):
    name = "hit-triangle"
    function = "hit_triangle"
    words: ClassVar[Mapping[str, str]] = {
        **RAY_WORDS,
        "a": "a corner",
        "b": "the next one",
        "c": "the last one",
        "triangle": "an object with a, b and c",
    }
    arguments = ("origin", "direction", "a", "b", "c")
    kind = "triangle"
    fields = ("a", "b", "c")
    places = ("ahead", "beside", "ahead", "beside", "beside", "behind")

    def _simple(self) -> list[Values]:
        flat = {"a": [-1.0, -1.0, 0.0], "b": [2.0, -1.0, 0.0], "c": [-1.0, 2.0, 0.0]}
        at = [0.0, 0.0, 4.0]
        return [
            {"origin": at, "direction": [0.0, 0.0, -1.0], **flat},
            {"origin": at, "direction": [0.0, 0.0, -2.0], **flat},
            {"origin": [0.0, 0.0, -4.0], "direction": [0.0, 0.0, 1.0], **flat},
            {"origin": at, "direction": [0.0, 0.0, 1.0], **flat},
            {"origin": [1.5, 1.5, 4.0], "direction": [0.0, 0.0, -1.0], **flat},
            {"origin": at, "direction": [0.0, 1.0, 0.0], **flat},
        ]


class ClosestHitKind(HitKind):
    name = "closest-hit"
    function = "closest_hit"
    words: ClassVar[Mapping[str, str]] = {
        **RAY_WORDS,
        "objects": "a list of objects: type ('sphere' or 'triangle') with center and radius, or a, "
        "b and c",
    }
    arguments = ("origin", "direction", "objects")
    return_words: ClassVar[Mapping[str, str]] = {"object": "its number", "t": "the ray parameter"}
    returns = ("object", "t")
    answer = "the object's number and t, or None"

    def _case(self, task: CheckTask, values: Values) -> CheckCase:
        ray = {name: values[name] for name in ("origin", "direction")}
        found = [*_all_hits(**ray, objects=values["objects"]), np.inf]
        number, t = int(np.argmin(found)), float(min(found))
        near = 0.0
        if t < np.inf:
            near = tolerance(**ray, shape=values["objects"][number], t=t, rounding=FLOAT32)
        else:
            number = -1
        values = {**values, "ray": ray}
        return CheckCase(named(task, values), (float(number), t), near, values)

    def _simple(self) -> list[Values]:
        ray = {"origin": [0.0, 0.0, 5.0], "direction": [0.0, 0.0, -1.0]}
        ahead, farther, behind = (
            {"type": "sphere", "center": [0.0, 0.0, z], "radius": 1.0} for z in (0.0, -4.0, 9.0)
        )
        beside = {"type": "sphere", "center": [5.0, 0.0, 0.0], "radius": 1.0}
        flat = {
            "type": "triangle",
            "a": [-1.0, -1.0, 2.0],
            "b": [2.0, -1.0, 2.0],
            "c": [-1.0, 2.0, 2.0],
        }
        many: tuple[list[dict[str, Any]], ...] = (
            [ahead], [ahead, farther], [farther, ahead], [ahead, flat, farther],
            [behind, farther, ahead], [beside, behind], [],
        )  # fmt: skip
        return [{**ray, "objects": objects} for objects in many]

    def _made_up(self, random: Random, number: int) -> Values:
        """Return several objects. In turn, the ray hits at least none, one or more of them."""
        while True:
            ray, objects = _ray(random), []
            for _ in range(int(random.integers(2, 7))):
                kind = "sphere" if random.random() < 0.6 else "triangle"
                objects.append(_object(random, ray, kind, random.choice(_PLACES)))
            met = np.sort(_all_hits(ray["origin"], ray["direction"], objects))
            met = met[np.isfinite(met)]
            if met.size >= number % 3 and np.all(np.diff(met) > 0.02 * met[1:]):
                return {**ray, "objects": objects}

    def shape(self, task: CheckTask) -> tuple[int, ...]:
        return (2,)

    def read(self, task: CheckTask, value: Any) -> list[float] | None:
        order = task.conventions.returns
        value = in_order(value, order)
        if is_miss(value):
            return [-1.0, np.inf]
        if not isinstance(value, list) or len(value) != 2:
            return None
        object_number, t = (value[order.index(name)] for name in ("object", "t"))
        if is_miss(t):
            return [-1.0, np.inf]
        which, parameter = number(object_number), number(t)
        if which is None or parameter is None:
            return None
        return [which - task.conventions.base, parameter]

    def wrong(self, task: CheckTask, cases: Cases, given: Floats) -> Flags:
        right = self.right(cases)
        is_other = given[:, 0] != right[:, 0]
        return is_other | _differ(right[:, 1], given[:, 1], tolerances(cases))

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        which, t = (float(part) for part in answer)
        if np.isinf(t) and which < 0:
            return "None (no hit)"
        parts = {"object": which + task.conventions.base, "t": t}
        return ", ".join(f"{name} {text_of(parts[name])}" for name in task.conventions.returns)


def _all_hits(origin: Any, direction: Any, objects: Sequence[Mapping[str, Any]]) -> Floats:
    return np.array([float(hits(origin, direction, shape)[0]) for shape in objects])


def parameter(value: Any) -> float | None:
    """Return t, inf for a miss. Also accepts (hit, t), which some courses return."""
    if isinstance(value, list) and len(value) == 2 and isinstance(value[0], bool):
        value = value[1] if value[0] else None
    if isinstance(value, dict) and "t" in value:
        value = value["t"]
    return np.inf if is_miss(value) else number(value)


def _differ(right: Floats, given: Floats, near: Floats) -> Flags:
    """Return where parameters differ. inf is a miss."""
    with np.errstate(invalid="ignore"):
        same = np.isinf(right) & np.isposinf(given)
        return ~(same | (np.abs(given - right) <= near))


def _ray(random: Random) -> Values:
    """Return a ray. Its direction has a length from 0.4 to 3, which exposes code that assumes 1."""
    unit = _unit(random.normal(size=3))
    direction = np.round(unit * random.uniform(0.4, 3.0), 3).tolist()
    return {"origin": list(point(random)), "direction": direction}


def _object(random: Random, ray: Values, kind: str, place: Place) -> dict[str, Any]:
    """Return an object that the ray clearly hits, or clearly misses.

    place: ahead of the ray, which hits it; beside the ray; behind it; or around its origin.
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
    """Return a triangle. Beside the ray, its plane is hit beyond an edge."""
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
    """Return True if rounding cannot decide between hit and miss.

    A triangle must be neither thin nor seen edge-on, so that float32 keeps the digits of t.
    """
    if shape["type"] == "triangle":
        a, b, c = (np.array(shape[name]) for name in "abc")
        longest = max(float(np.linalg.norm(edge)) for edge in (b - a, c - a, c - b))
        facing = abs(float(np.cross(b - a, c - a) @ ray["direction"]))
        if not facing > 0.1 * longest**2 * float(np.linalg.norm(ray["direction"])) > 0.02:
            return False
    return bool(hits(ray["origin"], ray["direction"], shape)[1] > MARGIN)
