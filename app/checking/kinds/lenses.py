"""Points through a lens, and back: OpenCV's two models.

Answers are two numbers: column and row, or a and b.

Tolerances: a thousandth of a pixel, which float32 and any reasonable iteration reach. The points
are where a lens's map is one-to-one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from lucida.app.checking.cases import generator, rounded
from lucida.app.checking.kinds.kind import CheckKind, in_order, named, number
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.checking.words import described
from lucida.renderer.camera.lenses import Lens

if TYPE_CHECKING:
    from numpy.random import Generator as Random

Values = dict[str, Any]

PIXELS = 1e-3  # tolerance
INTRINSICS = ("fx", "fy", "cx", "cy")
BROWN_SPREAD = {"k1": 0.25, "k2": 0.06, "p1": 0.02, "p2": 0.02, "k3": 0.02}


@dataclass(frozen=True, kw_only=True)
class LensKind(CheckKind):
    """A point through a lens.

    model: the lens's.
    spread: of each random coefficient.
    is_inverse: the way back, from the pixel.
    """

    model: str = "brown"
    spread: Mapping[str, float] = field(default_factory=lambda: BROWN_SPREAD)
    is_inverse: bool = False

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
        return values | self._place(random)

    def _place(self, random: Random) -> Values:
        """Return a point in front of the lens. A fisheye sees behind itself: up to 100 degrees
        from the axis.
        """
        depth, angle = random.uniform(1.0, 6.0), random.uniform(0.0, 2 * np.pi)
        if self.model == "fisheye":
            theta = random.uniform(0.3, 1.75)
            across, depth = depth * np.sin(theta), depth * np.cos(theta)
        else:
            across = depth * random.uniform(0.25, 0.75)
        point = (across * np.cos(angle), across * np.sin(angle), depth)
        x, y, z = (rounded(part, 4) for part in point)
        return {"point": [x, y, z], "X": x, "Y": y, "Z": z}

    def _case(self, task: CheckTask, values: Values) -> CheckCase:
        fx, fy, cx, cy = (values[name] for name in INTRINSICS)
        values["K"] = [[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
        values["distortion"] = [values[name] for name in self.spread]
        lens = Lens(self.model, {name: values[name] for name in self.spread})
        x, y, z = values["point"]
        a, b = lens.image_point(x, y, z)
        right, near = (float(fx * a + cx), float(fy * b + cy)), PIXELS
        if self.is_inverse:
            values |= dict(zip(("column", "row"), right, strict=True))
            right, near = (x / z, y / z), PIXELS / fx
        return CheckCase(named(task, values), right, near, values)

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> list[float] | None:
        order = task.conventions.returns
        value = in_order(value, order)
        while isinstance(value, list) and len(value) == 1:
            value = value[0]
        if not isinstance(value, list) or len(value) != 2:
            return None
        parts = [number(value[order.index(name)]) for name in self.returns]
        found = [part for part in parts if part is not None]
        return found if len(found) == len(parts) else None


PROJECT = LensKind(**described("project"))
FISHEYE = LensKind(
    **described("project-fisheye"),
    model="fisheye",
    spread={"k1": 0.05, "k2": 0.01, "k3": 0.002, "k4": 0.0004},
)
UNDISTORT = LensKind(
    **described("undistort"),
    is_inverse=True,
)
