"""The lecture's part on images: gray, one bit per pixel, and the place of a pixel in memory.

Answers: arrays (H, W) or (H, W, 3); a number for memory_offset.

Tolerances. Gray is a sum of three float32 products, or bytes divided by 255: half of 1/255 of the
brightest value. Bits and offsets must be exact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lucida.app.checking.cases import generator
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.checking.words import described

from .kind import (
    Cases,
    CheckKind,
    Flags,
    Floats,
    array,
    named,
    number,
    text_of,
    wrong_numbers,
)

if TYPE_CHECKING:
    from numpy.random import Generator as Random

HALF_A_BYTE = 0.5 / 255


@dataclass(frozen=True, kw_only=True)
class ImageKind(CheckKind):
    """A function that makes an image. make: makes the cases."""

    make: Callable[[CheckTask], list[CheckCase]]

    def cases(self, task: CheckTask) -> list[CheckCase]:
        return self.make(task)

    def wanted(self, task: CheckTask, case: CheckCase) -> str:
        return f"numbers {' x '.join(map(str, np.shape(case.right)))}"

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> Floats | None:
        """Read an image. White may be 1, True or 255 where there is only black and white."""
        image = array(value)
        if image is None or image.shape != np.shape(case.right):
            return None
        return image / 255 if self.name == "to-bitmap" and np.isin(image, (0, 255)).all() else image

    def wrong(self, task: CheckTask, cases: Cases, given: Any) -> Flags:
        pairs = zip(cases, given, strict=True)
        return np.array([_wrong_pixels(case, image).any() for case, image in pairs], bool)

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        """Return the first wrong pixel: its place, the correct value and the given one."""
        marks = _wrong_pixels(case, answer)
        i, j = (int(part) for part in np.argwhere(marks)[0])
        height, width = marks.shape
        where = f"{int(marks.sum())} of {marks.size} pixels; the first: row {i}, column {j} "
        where += f"(from 0) of the array, {width}x{height} pixels"
        right, given = (text_of(np.asarray(image)[i, j].tolist()) for image in (case.right, answer))
        return where, right, given


def _wrong_pixels(case: CheckCase, image: Floats) -> Flags:
    """Return the wrong pixels of an image, bool (H, W)."""
    wrong = wrong_numbers(case, image)
    pixels = wrong.any(axis=2) if wrong.ndim == 3 else wrong
    return np.asarray(pixels & case.values.get("judged", True))


def _gray_cases(task: CheckTask) -> list[CheckCase]:
    random = generator(task)
    simple = np.zeros((2, 3, 3))
    simple[0] = np.eye(3)
    simple[1, 0], simple[1, 1] = 1.0, 0.5
    cases = []
    for image in (simple, *(_image(random, (3,)) for _ in range(task.count))):
        height, width = image.shape[:2]
        values = {"rgb": image.tolist(), "width": width, "height": height}
        right = image @ np.array(task.weights)
        cases.append(CheckCase(named(task, values), right, HALF_A_BYTE, values))
    return cases


def _bitmap_cases(task: CheckTask) -> list[CheckCase]:
    """Return bytes as in the lecture, then numbers from 0 to 1. One pixel is exactly at the
    threshold.
    """
    random = generator(task)
    made = [(np.array([[0.0, 127.0, 128.0], [129.0, 200.0, 255.0]]), 128.0)]
    for number_ in range(task.count):
        image = _image(random)
        threshold = float(random.choice(image.ravel()))
        if number_ % 2:
            image, threshold = np.round(image * 255), float(round(threshold * 255))
        made.append((image, threshold))
    cases = []
    for image, threshold in made:
        height, width = image.shape
        values = {"gray": image.tolist(), "threshold": threshold, "width": width, "height": height}
        white = image >= threshold
        cases.append(CheckCase(named(task, values), white.astype(float), 0.0, values))
    return cases


def _image(random: Random, more: tuple[int, ...] = ()) -> Floats:
    height, width = random.integers(2, 7, 2)
    made: Floats = np.round(random.random((height, width, *more)), 3)
    return made


GRAY = ImageKind(**described("to-gray"), make=_gray_cases, as_arrays=True)
BITMAP = ImageKind(**described("to-bitmap"), make=_bitmap_cases, as_arrays=True)


class OffsetKind(CheckKind):
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
        return CheckCase(named(task, values), pixels * task.stride, 0.0, values)

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> float | None:
        return number(value)

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Any) -> str:
        return f"{float(answer):.15g}"


OFFSET = OffsetKind(**described("memory-offset"))
