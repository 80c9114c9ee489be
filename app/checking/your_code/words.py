"""The findings on a file as words next to its pictures, line by line. Pure."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lucida.app.checking.checked import TaskResult
from lucida.app.checking.kinds.kind import text_of
from lucida.app.checking.mistakes.diagnosis import READ
from lucida.app.checking.reports import VERDICTS
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import CheckTask
from lucida.app.state.options.shared import Pixel
from lucida.renderer.system.errors import visible

from .model import CodeRays, CodeReport

ToldRole = Literal["good", "bad", "text", "code", "dim", "read"]
HALTED = "It is not run again by itself"
OUTPUT_LINES = 40  # last lines of the printed output


@dataclass(frozen=True)
class ToldLine:
    """A line of words.

    role: its meaning, which determines its look. read: a link to the lecture's step that it names.
    code: in a fixed-width font.
    """

    role: ToldRole
    text: str


def told_of(report: CodeReport, pixel: Pixel | None) -> list[ToldLine]:
    """Return all findings, the most helpful first. pixel: the marked one, in the pictures."""
    lines = [*_of_file(report)] or [*_of_task(report, pixel)]
    lines = [line for line in lines if not _is_marks(line)]
    return [*lines, *_of_output(report)]


def _is_marks(line: ToldLine) -> bool:
    """Return True for a traceback's line of ^^^ alone: wrapped text would separate it from its
    code.
    """
    return line.role == "code" and re.fullmatch(r" *[~^][ ~^]*", line.text) is not None


def verdict_of(report: CodeReport, task: CheckTask) -> str:
    """Return correct, wrong or failed; "empty" if the function is still a starter, or "" while it
    is unknown.
    """
    result = report.results.get(task.name)
    if result is None:
        return ""
    return "empty" if _is_empty(result) else VERDICTS.get(result.status, result.status)


def _is_empty(result: TaskResult) -> bool:
    """Return True if the function returns what a starter file does."""
    failure = result.failure
    return failure is not None and failure.kind == "answer" and "returned None" in failure.text


def _of_file(report: CodeReport) -> Iterator[ToldLine]:
    """Yield the reason why the file answers nothing; no lines if it answers."""
    if report.failure is not None:
        yield ToldLine("bad", report.failure.text)
        yield from (ToldLine("code", line) for line in report.failure.traceback)
        if report.halted:
            yield ToldLine("dim", f"{HALTED}: save the file, or press Run.")
    elif report.chosen is None:
        names = ", ".join(dict.fromkeys(task.function for task in BUILTIN))
        yield ToldLine("bad", f"The file has none of the functions that are asked for: {names}.")


def _of_task(report: CodeReport, pixel: Pixel | None) -> Iterator[ToldLine]:
    """Yield what the pictures show, and why; then the result of other cases."""
    chosen, rays = report.chosen, report.rays
    assert chosen is not None
    result = report.results.get(chosen.name)
    if rays is None:
        yield from _of_result(chosen, result)
    elif rays.result.failure is not None:
        yield from _of_failure(rays.result)
        if report.halted:
            yield ToldLine("dim", f"{HALTED}: choose fewer pixels, save the file, or press Run.")
    elif rays.result.status == "wrong":
        yield ToldLine("bad", f"{rays.wrong.sum()} of {rays.wrong.size} rays are wrong.")
        tried = report.results.get(rays.task.name)
        if tried is None:
            yield ToldLine("dim", "looking for the reason ...")
        elif tried.diagnosis is not None:
            yield from map(_explained, tried.diagnosis.sentences)
    else:
        yield ToldLine("good", "Every ray is correct.")
        if result is not None and result.status != "right":
            yield ToldLine("bad", "But not for every camera:")
        yield from _of_result(chosen, result)
    if rays is not None and pixel is not None and bool(rays.came[pixel]):
        yield from _of_pixel(rays, pixel)


def _of_failure(result: TaskResult) -> Iterator[ToldLine]:
    if _is_empty(result):
        yield ToldLine("text", f"{result.task.function} returns nothing yet. {result.task.text}")
        return
    for number, line in enumerate(result.lines):
        yield ToldLine("code" if number else "bad", line)


def _of_pixel(rays: CodeRays, pixel: Pixel) -> Iterator[ToldLine]:
    yield ToldLine("dim", f"pixel {pixel}, from 0, of the pictures:")
    for name, image in (("yours  ", rays.given), ("correct", rays.right)):
        origin, direction = map(text_of, np.round(image[pixel], 12).tolist())
        yield ToldLine("code", f"{name}  {origin} + t {direction}")


def _of_result(task: CheckTask, result: TaskResult | None) -> Iterator[ToldLine]:
    if result is None:
        yield ToldLine("dim", f"{task.name} is being tried with other cases ...")
    elif result.failure is not None:
        yield from _of_failure(result)
    elif result.status == "right":
        yield ToldLine("good", f"{task.name}: correct in all of {result.cases} cases.")
    else:
        yield ToldLine("bad", f"{task.function} is wrong.")
        yield from map(_explained, result.lines)


def _explained(sentence: str) -> ToldLine:
    return ToldLine("read" if sentence.startswith(READ) else "text", sentence)


def _of_output(report: CodeReport) -> Iterator[ToldLine]:
    output = report.output
    if not output and report.chosen is not None and report.rays is None:
        result = report.results.get(report.chosen.name)
        output = result.output if result is not None else ""
    printed = output.rstrip().splitlines()
    if printed:
        cut = f", the last {OUTPUT_LINES} of {len(printed)} lines"
        yield ToldLine("dim", f"printed{cut if len(printed) > OUTPUT_LINES else ''}:")
        for line in printed[-OUTPUT_LINES:]:
            yield ToldLine("code", visible(line).expandtabs(4))
