"""A camera's basis from an eye, a target and an up vector.

Answers in the kind's own form are arrays (N, 3, 3): the rows are u, v, w in the world.

Tolerance of each vector: eye - target cancels, so its direction has an error of FLOAT32 * C with
C = (|eye| + |target|) / |eye - target|. up x w loses what up and w have in common, so the sum is
divided by the sine of their angle: FLOAT32 * (1 + C) / sin(up, w).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.cases import generator, look
from lucida.app.checking.kinds.kind import FLOAT32, Cases, CheckKind, Flags, Read, named, tolerances
from lucida.app.checking.kinds.values import text_of
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector

Floats = NDArray[np.float64]

# Index of u, v or w, and its sign.
PARTS = {
    "u": (0, 1), "v": (1, 1), "w": (2, 1),
    "right": (0, 1), "up": (1, 1), "back": (2, 1),
    "left": (0, -1), "down": (1, -1), "forward": (2, -1),
}  # fmt: skip


class BasisKind(CheckKind):
    name = "basis"
    function = "basis"
    words: ClassVar[Mapping[str, str]] = {
        "eye": "the camera's position",
        "target": "a point that is looked at",
        "up": "a vector that is upwards in the image; not of length 1, nor at right angles to w",
        "forward": "from the eye to the target, of length 1",
    }
    arguments = ("eye", "target", "up")
    returns = ("u", "v", "w")
    return_words: ClassVar[Mapping[str, str]] = {
        "u": "right in the image", "v": "up", "w": "back, from the target to the eye",
        "right": "u", "up": "v", "back": "w", "left": "-u", "down": "-v", "forward": "-w",
    }  # fmt: skip
    answer = "u, v and w, three numbers each"

    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        simple: list[tuple[Vector, Vector, Vector]] = [
            ((0.0, 0.0, 4.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
            ((4.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
            ((1.0, 2.0, 3.0), (1.0, 2.0, -2.0), (0.0, 1.0, 0.0)),
            ((3.0, 3.0, 3.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        ]
        made = [*simple, *(look(random) for _ in range(task.count))]
        return [case_of(task, *one) for one in made]

    def wanted(self, task: CheckTask) -> str:
        return f"{', '.join(task.conventions.returns)}, three numbers each"

    def given(self, task: CheckTask, cases: Cases, values: Sequence[Any]) -> Read:
        parts, problems = super().given(task, cases, values)
        given = self.right(cases)  # parts that are not asked for
        for place, name in enumerate(task.conventions.returns):
            which, sign = PARTS[name]
            given[:, which] = sign * parts[:, place]
        return given, problems

    def wrong(self, task: CheckTask, cases: Cases, given: Floats) -> Flags:
        with np.errstate(all="ignore"):
            apart = np.linalg.norm(given - self.right(cases), axis=2)
            return ~np.all(apart <= tolerances(cases)[:, None], axis=1)

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Floats) -> str:
        parts = []
        for name in task.conventions.returns:
            which, sign = PARTS[name]
            parts.append(f"{name} {text_of((sign * np.asarray(answer)[which]).tolist())}")
        return ", ".join(parts)


def conditioning(eye: Vector, target: Vector, up: Vector) -> float:
    """Return how much a relative error of the vectors grows in the basis."""
    back = np.subtract(eye, target)
    away, length = np.linalg.norm(back), np.linalg.norm(up)
    sine = np.linalg.norm(np.cross(up, back)) / (length * away)
    return float((1 + (np.linalg.norm(eye) + np.linalg.norm(target)) / away) / sine)


def case_of(task: CheckTask, eye: Vector, target: Vector, up: Vector) -> CheckCase:
    camera = Camera.look_at(eye, target, up)
    right = np.array([camera.u, camera.v, camera.w])
    near = FLOAT32 * conditioning(eye, target, up)
    values = {
        "eye": list(eye),
        "target": list(target),
        "up": list(up),
        "forward": (-right[2]).tolist(),
    }
    return CheckCase(named(task, values), right, near, values, target=target, up=up)
