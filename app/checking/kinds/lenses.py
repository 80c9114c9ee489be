"""Points through a lens, and back: OpenCV's two models.

Answers in the kind's own form are arrays (N, 2): column and row, or a and b.

Tolerances: a thousandth of a pixel, which float32 and any reasonable iteration reach. The points
are where a lens's map is one-to-one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.cases import generator, rounded
from lucida.app.checking.kinds.kind import Cases, CheckKind, Flags, named, tolerances
from lucida.app.checking.kinds.values import in_order, number, text_of
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.renderer.camera.lenses import Lens

if TYPE_CHECKING:
    from numpy.random import Generator as Random

Floats = NDArray[np.float64]
Values = dict[str, Any]

PIXELS = 1e-3  # tolerance
INTRINSICS = ("fx", "fy", "cx", "cy")
BROWN = ("k1", "k2", "p1", "p2", "k3")  # in OpenCV's order
FISHEYE = ("k1", "k2", "k3", "k4")
CAMERA_WORDS = {
    "fx": "the focal length in pixels, across",
    "fy": "the same, down",
    "cx": "the principal point's column, in pixels",
    "cy": "its row",
    "K": "the matrix of fx, fy, cx and cy, 3 x 3",
    "distortion": "all coefficients in a list, in OpenCV's order",
}
POINT_WORDS = {
    "point": "a point in the camera's coordinates: X to the right, Y down, Z forwards",
    "X": "its first coordinate, to the right",
    "Y": "the second, down",
    "Z": "the third, forwards",
    **CAMERA_WORDS,
}


class LensKind(CheckKind):
    """Base class. model, coefficients: the lens's. spread: of each random coefficient."""

    model: ClassVar[str]
    spread: ClassVar[Mapping[str, float]]

    def cases(self, task: CheckTask) -> list[CheckCase]:
        """Return cases of one coefficient after another, then of all together."""
        random = generator(task)
        wanted: list[tuple[str, ...]] = [(), *((name,) for name in self.spread)]
        wanted += [tuple(self.spread)] * task.count
        return [self._case(task, self._values(random, names)) for names in wanted]

    def _values(self, random: Random, names: tuple[str, ...]) -> Values:
        width, height = random.integers(300, 1200, 2)
        focal = rounded(random.uniform(0.6, 1.1) * width)
        values: Values = {"fx": focal, "fy": rounded(focal * random.uniform(0.9, 1.1))}
        values |= {"cx": rounded(width / 2 + random.uniform(-40, 40))}
        values |= {"cy": rounded(height / 2 + random.uniform(-40, 40))}
        for name, size in self.spread.items():
            drawn = random.uniform(0.4, 1.0) * size * random.choice((-1.0, 1.0))
            values[name] = rounded(drawn, 5) if name in names else 0.0
        return values | self._place(random, values)

    def _place(self, random: Random, values: Values) -> Values:
        """Return a point in front of the lens."""
        depth, angle = random.uniform(1.0, 6.0), random.uniform(0.0, 2 * np.pi)
        across = depth * random.uniform(0.25, 0.75)
        return _point(across * np.cos(angle), across * np.sin(angle), depth)

    def _case(self, task: CheckTask, values: Values) -> CheckCase:
        fx, fy, cx, cy = (values[name] for name in INTRINSICS)
        values["K"] = [[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
        values["distortion"] = [values[name] for name in self.spread]
        lens = Lens(self.model, {name: values[name] for name in self.spread})
        right, near = self._solved(lens, values)
        return CheckCase(named(task, values), right, near, values)

    def _solved(self, lens: Lens, values: Values) -> tuple[tuple[float, float], float]:
        """Return the correct answer and its tolerance: of projecting the point."""
        a, b = lens.image_point(values["X"], values["Y"], values["Z"])
        column, row = values["fx"] * a + values["cx"], values["fy"] * b + values["cy"]
        return (float(column), float(row)), PIXELS

    def shape(self, task: CheckTask) -> tuple[int, ...]:
        return (2,)

    def read(self, task: CheckTask, value: Any) -> list[float] | None:
        order = task.conventions.returns
        value = in_order(value, order)
        while isinstance(value, list) and len(value) == 1:
            value = value[0]
        if not isinstance(value, list) or len(value) != 2:
            return None
        parts = [number(value[order.index(name)]) for name in self.returns]
        found = [part for part in parts if part is not None]
        return found if len(found) == len(parts) else None

    def wrong(self, task: CheckTask, cases: Cases, given: Floats) -> Flags:
        apart = np.abs(given - self.right(cases)).max(axis=1)
        return ~(apart <= tolerances(cases))  # NaN is wrong

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        parts = dict(zip(self.returns, np.asarray(answer, float).tolist(), strict=True))
        return ", ".join(f"{name} {text_of(parts[name])}" for name in task.conventions.returns)


class ProjectKind(LensKind):
    name = "project"
    function = "project"
    words: ClassVar[Mapping[str, str]] = {
        **POINT_WORDS,
        "k1": "the first radial coefficient, of r^2",
        "k2": "the second, of r^4",
        "k3": "the third, of r^6",
        "p1": "the first tangential coefficient",
        "p2": "the second",
    }
    arguments = ("point", *INTRINSICS, *BROWN)
    returns = ("column", "row")
    return_words: ClassVar[Mapping[str, str]] = {
        "column": "where the point is seen, in pixels to the right",
        "row": "in pixels down",
    }
    answer = "column and row, two numbers"
    model = "brown"
    spread: ClassVar[Mapping[str, float]] = {
        "k1": 0.25, "k2": 0.06, "p1": 0.02, "p2": 0.02, "k3": 0.02,
    }  # fmt: skip


class FisheyeKind(LensKind):
    name = "project-fisheye"
    function = "project_fisheye"
    words: ClassVar[Mapping[str, str]] = {
        **POINT_WORDS,
        "k1": "the first coefficient, of theta^2",
        "k2": "the second, of theta^4",
        "k3": "the third, of theta^6",
        "k4": "the fourth, of theta^8",
    }
    arguments = ("point", *INTRINSICS, *FISHEYE)
    returns = ProjectKind.returns
    return_words = ProjectKind.return_words
    answer = ProjectKind.answer
    model = "fisheye"
    spread: ClassVar[Mapping[str, float]] = {"k1": 0.05, "k2": 0.01, "k3": 0.002, "k4": 0.0004}

    def _place(self, random: Random, values: Values) -> Values:
        """Return a point up to 100 degrees from the axis: a fisheye sees behind itself."""
        away, angle = random.uniform(1.0, 6.0), random.uniform(0.0, 2 * np.pi)
        theta = random.uniform(0.3, 1.75)
        across = away * np.sin(theta)
        return _point(across * np.cos(angle), across * np.sin(angle), away * np.cos(theta))


class UndistortKind(LensKind):
    name = "undistort"
    function = "undistort"
    words: ClassVar[Mapping[str, str]] = {
        "column": "where the point is seen, in pixels to the right",
        "row": "the same, down",
        **CAMERA_WORDS,
        **{name: ProjectKind.words[name] for name in BROWN},
    }
    arguments = ("column", "row", *INTRINSICS, *BROWN)
    returns = ("a", "b")
    return_words: ClassVar[Mapping[str, str]] = {"a": "X / Z of the point", "b": "Y / Z"}
    answer = "a and b, two numbers"
    model = "brown"
    spread = ProjectKind.spread

    def _solved(self, lens: Lens, values: Values) -> tuple[tuple[float, float], float]:
        (column, row), _ = super()._solved(lens, values)
        values |= {"column": column, "row": row}
        ideal = values["X"] / values["Z"], values["Y"] / values["Z"]
        return ideal, PIXELS / values["fx"]


def _point(x: float, y: float, z: float) -> Values:
    point = [rounded(part, 4) for part in (x, y, z)]
    return {"point": point, **dict(zip("XYZ", point, strict=True))}
