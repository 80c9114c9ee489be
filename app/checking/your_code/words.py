"""The findings on a file as words next to its pictures, line by line. Pure."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lucida.app.checking.checked import TaskResult, failure_lines
from lucida.app.checking.kinds.kind import text_of
from lucida.app.checking.mistakes.diagnosis import READ
from lucida.app.checking.tasks import Failure
from lucida.app.state.options.shared import Pixel
from lucida.renderer.system.errors import one_line, visible

from .model import RAY_TASK, CodeRays, CodeReport

ToldRole = Literal["good", "bad", "text", "code", "dim", "read"]
HALTED = "It is not run again by itself: choose fewer pixels, save the file, or press Run."
OUTPUT_LINES = 40  # last lines of the printed output


@dataclass(frozen=True)
class ToldLine:
    """A line of words.

    role: its meaning, which determines its look. read: a link to the lecture's step that it names.
    code: True for a fixed-width font.
    """

    role: ToldRole
    text: str


def told_of(report: CodeReport, pixel: Pixel | None) -> list[ToldLine]:
    """Return all findings, the most helpful first. pixel: the marked one, in the pictures."""
    if report.failure is not None:
        lines = [*_of_failure(report.failure)]
        if report.halted:
            lines.append(ToldLine("dim", HALTED))
    else:
        assert report.rays is not None
        lines = [*_of_rays(report.rays, report.results.get(report.rays.task.name))]
    if report.rays is not None and pixel is not None and report.rays.came[pixel]:
        lines += _of_pixel(report.rays, pixel)
    return [*lines, *_of_output(report.output)]


def _of_failure(failure: Failure) -> Iterator[ToldLine]:
    if failure.kind == "answer" and "returned None" in failure.text:  # as a starter file does
        yield ToldLine("text", f"{RAY_TASK.function} returns nothing yet. {RAY_TASK.text}")
        return
    yield ToldLine("bad", one_line(failure.text))
    for line in failure_lines(failure):
        if not re.fullmatch(r" *[~^][ ~^]*", line):  # wrapped text would separate it from its code
            yield ToldLine("code", line)


def _of_rays(rays: CodeRays, tried: TaskResult | None) -> Iterator[ToldLine]:
    """Yield the findings in the pictures, then the reason, or the result of other cameras."""
    is_wrong = rays.result.status == "wrong"
    if is_wrong:
        yield ToldLine("bad", f"{rays.wrong.sum()} of {rays.wrong.size} rays are wrong.")
    else:
        yield ToldLine("good", "Every ray is correct.")
    if tried is None:
        yield ToldLine("dim", f"{'looking for the reason' if is_wrong else 'trying others'} ...")
    elif is_wrong:
        yield from map(_explained, tried.diagnosis.sentences if tried.diagnosis else ())
    elif tried.status == "right":
        yield ToldLine("good", f"{tried.task.name}: correct in all of {tried.cases} cases.")
    else:
        yield ToldLine("bad", "But not for every camera:")
        yield from map(_explained, tried.lines)


def _of_pixel(rays: CodeRays, pixel: Pixel) -> Iterator[ToldLine]:
    yield ToldLine("dim", f"pixel {pixel}, from 0, of the pictures:")
    for name, image in (("yours  ", rays.given), ("correct", rays.right)):
        origin, direction = map(text_of, np.round(image[pixel], 12).tolist())
        yield ToldLine("code", f"{name}  {origin} + t {direction}")


def _explained(sentence: str) -> ToldLine:
    return ToldLine("read" if sentence.startswith(READ) else "text", sentence)


def _of_output(output: str) -> Iterator[ToldLine]:
    printed = output.rstrip().splitlines()
    if printed:
        cut = f", the last {OUTPUT_LINES} of {len(printed)} lines"
        yield ToldLine("dim", f"printed{cut if len(printed) > OUTPUT_LINES else ''}:")
        for line in printed[-OUTPUT_LINES:]:
            yield ToldLine("code", visible(line).expandtabs(4))
