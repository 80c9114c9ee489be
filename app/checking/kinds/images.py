"""The lecture's part on images: gray, one bit per pixel, and the place of a pixel in memory.

Answers in the kind's own form: a list of arrays (H, W), one for each case; numbers (N,) for
memory_offset. None for an answer of the wrong shape.

Tolerances. Gray is a sum of three float32 products, or bytes divided by 255: half of 1/255 of the
brightest value. Bits and offsets must be exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.calls import Call
from lucida.app.checking.cases import generator
from lucida.app.checking.kinds.kind import Cases, CheckKind, Flags, Read, named
from lucida.app.checking.kinds.values import array, number, shown, text_of
from lucida.app.checking.tasks import CheckCase, CheckTask

if TYPE_CHECKING:
    from numpy.random import Generator as Random

Floats = NDArray[np.float64]

HALF_A_BYTE = 0.5 / 255


class ImageKind(CheckKind):
    """A function from an image to an image. Python code receives NumPy arrays."""

    def calls(self, task: CheckTask, cases: Cases) -> list[Call]:
        return [
            Call(task.function, case.arguments, vectorised=True, notation=task.notation)
            for case in cases
        ]

    def given(self, task: CheckTask, cases: Cases, values: Sequence[Any]) -> Read:
        found: list[Floats | None] = []
        problems: dict[int, str] = {}
        for case, value in zip(cases, values, strict=False):
            image = array(value)
            shape = np.shape(case.right)
            if image is None:
                problems[len(found)] = f"returned {shown(value)}, not an image of numbers"
            elif image.shape != shape:
                sides = " x ".join(map(str, shape))
                problems[len(found)] = f"returned {shown(value)}, not numbers {sides}"
                image = None
            found.append(image)
        return found + [None] * (len(cases) - len(found)), problems

    def right(self, cases: Cases) -> list[Floats]:
        return [case.right for case in cases]

    def wrong(self, task: CheckTask, cases: Cases, given: Any) -> Flags:
        marks = (
            self.wrong_pixels(task, case, image) for case, image in zip(cases, given, strict=True)
        )
        return np.array([bool(mark.any()) for mark in marks], bool)

    def wrong_pixels(self, task: CheckTask, case: CheckCase, image: Floats | None) -> Flags:
        """Return the wrong pixels of an image, bool (H, W)."""
        if image is None:
            return np.ones(np.shape(case.right)[:2], bool)
        with np.errstate(invalid="ignore"):
            near = np.abs(image - case.right) <= case.tolerance
        return ~near if near.ndim == 2 else ~near.all(axis=2)

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        """Return the first wrong pixel: its place, the correct value and the given one."""
        marks = self.wrong_pixels(task, case, answer)
        i, j = (int(part) for part in np.argwhere(marks)[0])
        height, width = marks.shape
        where = f"{int(marks.sum())} of {marks.size} pixels; the first: row {i}, column {j} "
        where += f"(from 0) of the array, {width}x{height} pixels"
        told = (text_of(np.asarray(image)[i, j].tolist()) for image in (case.right, answer))
        right, given = told
        return where, right, given

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        raise NotImplementedError  # first_wrong is overridden


class GrayKind(ImageKind):
    name = "to-gray"
    function = "to_gray"
    words: ClassVar[Mapping[str, str]] = {
        "rgb": "height x width x 3 numbers from 0 to 1",
        "width": "the number of columns",
        "height": "the number of rows",
    }
    arguments = ("rgb",)
    answer = "height x width numbers"

    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        simple = np.zeros((2, 3, 3))
        simple[0] = np.eye(3)
        simple[1, 0], simple[1, 1] = 1.0, 0.5
        return [
            self._case(task, image)
            for image in (simple, *(_image(random, (3,)) for _ in range(task.count)))
        ]

    def _case(self, task: CheckTask, image: Floats) -> CheckCase:
        height, width = image.shape[:2]
        values = {"rgb": image.tolist(), "width": width, "height": height}
        right = image @ np.array(task.weights)
        return CheckCase(named(task, values), right, HALF_A_BYTE, values)


class BitmapKind(ImageKind):
    name = "to-bitmap"
    function = "to_bitmap"
    words: ClassVar[Mapping[str, str]] = {
        "gray": "height x width numbers",
        "threshold": "the number that decides",
        "width": "the number of columns",
        "height": "the number of rows",
    }
    arguments = ("gray", "threshold")
    answer = "height x width of 0 and 1"

    def cases(self, task: CheckTask) -> list[CheckCase]:
        """Return bytes as in the lecture, then numbers from 0 to 1. One pixel is exactly at the
        threshold.
        """
        random = generator(task)
        made = [(np.array([[0.0, 127.0, 128.0], [129.0, 200.0, 255.0]]), 128.0)]
        for number_ in range(task.count):
            image = _image(random)
            threshold = float(random.choice(image.ravel()))
            made.append(
                (np.round(image * 255), round(threshold * 255))
                if number_ % 2
                else (image, threshold)
            )
        return [self._case(task, image, float(threshold)) for image, threshold in made]

    def _case(self, task: CheckTask, image: Floats, threshold: float) -> CheckCase:
        height, width = image.shape
        values = {"gray": image.tolist(), "threshold": threshold, "width": width, "height": height}
        white = image >= threshold if task.inclusive else image > threshold
        return CheckCase(named(task, values), white.astype(float), 0.0, values)

    def given(self, task: CheckTask, cases: Cases, values: Sequence[Any]) -> Read:
        """Read the answers. White may be 1, True or 255."""
        images, problems = super().given(task, cases, values)
        return [
            image / 255 if image is not None and np.isin(image, (0, 255)).all() else image
            for image in images
        ], problems


class OffsetKind(CheckKind):
    name = "memory-offset"
    function = "memory_offset"
    words: ClassVar[Mapping[str, str]] = {
        "i": "the row",
        "j": "the column",
        "row": "the row",
        "column": "the column",
        "width": "the number of columns",
        "height": "the number of rows",
    }
    arguments = ("i", "j", "width")
    answer = "a whole number"

    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        made = [(0, 0, 8, 6), (0, 1, 8, 6), (1, 0, 8, 6), (5, 7, 8, 6)]
        for _ in range(task.count):
            width, height = (int(side) for side in random.integers(2, 2000, 2))
            made.append((int(random.integers(height)), int(random.integers(width)), width, height))
        return [self._case(task, *one) for one in made]

    def _case(self, task: CheckTask, i: int, j: int, width: int, height: int) -> CheckCase:
        base = task.conventions.base
        row, column = i + base, j + base
        values = {"i": row, "row": row, "j": column, "column": column}
        values |= {"width": width, "height": height}
        pixels = j * height + i if task.column_major else i * width + j
        return CheckCase(
            named(task, values), pixels * task.stride, 0, values, size=(width, height), pixel=(i, j)
        )

    def read(self, task: CheckTask, value: Any) -> float | None:
        return number(value)

    def shape(self, task: CheckTask) -> tuple[int, ...]:
        return ()

    def wrong(self, task: CheckTask, cases: Cases, given: Floats) -> Flags:
        return given != self.right(cases)

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        return f"{float(answer):.15g}"


def _image(random: Random, more: tuple[int, ...] = ()) -> Floats:
    height, width = random.integers(2, 7, 2)
    made: Floats = np.round(random.random((height, width, *more)), 3)
    return made
