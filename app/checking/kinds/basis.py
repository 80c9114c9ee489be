"""A camera's basis from an eye, a target and an up vector.

Answers are arrays (3, 3): the rows are u, v, w in the world.

Tolerance of each number: eye - target cancels, so that its direction has an error of FLOAT32 * C
with C = (|eye| + |target|) / |eye - target|. The error of up x w grows as up and w become parallel,
so the sum is divided by the sine of their angle: FLOAT32 * (1 + C) / sin(up, w).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lucida.app.checking.cases import generator, look
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.checking.words import FIRST_CASES, described
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector

from .kind import FLOAT32, CheckKind, Floats, named, vectors

# Index of u, v or w, and its sign.
PARTS = {
    "u": (0, 1), "v": (1, 1), "w": (2, 1),
    "right": (0, 1), "up": (1, 1), "back": (2, 1),
    "left": (0, -1), "down": (1, -1), "forward": (2, -1),
}  # fmt: skip


class BasisKind(CheckKind):
    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        made = [*FIRST_CASES["basis"]["looks"], *(look(random) for _ in range(task.count))]
        return [case_of(task, *one) for one in made]

    def wanted(self, task: CheckTask, case: CheckCase) -> str:
        return f"{', '.join(task.conventions.returns)}, three numbers each"

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> Floats | None:
        returns = task.conventions.returns
        if (parts := vectors(value, returns)) is None:
            return None
        given = np.array(case.right)  # parts that are not required count as correct
        for name, part in zip(returns, parts, strict=True):
            which, sign = PARTS[name]
            given[which] = sign * np.array(part)
        return given

    def parts(self, task: CheckTask, case: CheckCase, answer: Floats) -> dict[str, Any]:
        return {name: (sign * answer[which]).tolist() for name, (which, sign) in PARTS.items()}


BASIS = BasisKind(**described("basis"))


def conditioning(eye: Vector, target: Vector, up: Vector) -> float:
    """Return the growth of the vectors' relative error in the basis."""
    back = np.subtract(eye, target)
    away, length = np.linalg.norm(back), np.linalg.norm(up)
    sine = np.linalg.norm(np.cross(up, back)) / (length * away)
    return float((1 + (np.linalg.norm(eye) + np.linalg.norm(target)) / away) / sine)


def case_of(task: CheckTask, eye: Vector, target: Vector, up: Vector) -> CheckCase:
    camera = Camera.look_at(eye, target, up)
    right = np.array([camera.u, camera.v, camera.w])
    values = {"eye": eye, "target": target, "up": up, "forward": -right[2]}
    values = {word: np.asarray(value).tolist() for word, value in values.items()}
    near = FLOAT32 * conditioning(eye, target, up)
    return CheckCase(named(task, values), right, near, values, target=target, up=up)
