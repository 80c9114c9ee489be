"""The program for each kind of task, and the values that its lines use."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from lucida.app.checking.tasks import CheckCase, CheckTask

from .catalogue import part
from .program import Program
from .rays import RayTask, ray_program, ray_task, ray_values
from .vectors import SHAPES


def program_of(task: CheckTask) -> Program:
    """Return the program whose mistakes may explain a task's answers."""
    if task.kind == "viewing-ray":
        return ray_program(ray_task(task))
    if task.kind == "render":
        return _render_program(ray_task(task))
    return _value_program(task)


@functools.lru_cache(32)
def _render_program(task: RayTask) -> Program:
    """Return the ray's lines, then both loops. Pairs in the ray are left to its task."""
    rays, (lines, mistakes) = ray_program(task), part("render")
    others = (one for one in rays.mistakes if one.name != "normalised")
    paired = frozenset(line.key for line in lines)
    return Program((*rays.lines, *lines), (*mistakes, *others), ("answer",), paired)


def _value_program(task: CheckTask) -> Program:
    lines, mistakes = part(task.kind, {"back": "eye - target"}, {"target"})
    if task.kind == "basis":
        answer, more = part("answer")
        lines, mistakes = lines + answer, mistakes + more
    return Program(tuple(lines), tuple(mistakes), (lines[-1].code.partition(" ")[0],))


def known_values(task: CheckTask, case: CheckCase) -> dict[str, Any]:
    """Return the values that the lines use in a case, by name: numbers, vectors (3,), arrays."""
    if task.kind == "render":
        return _image_values(task, case)
    known = {
        name: np.asarray(value, float) if isinstance(value, list) and name != "objects" else value
        for name, value in case.values.items()
    }
    return known | SHAPES


def _image_values(task: CheckTask, case: CheckCase) -> dict[str, Any]:
    """Return the values for all pixels of an image, with rows numbered as in the task."""
    assert case.camera is not None and case.size is not None
    rays = ray_task(task)
    width, height = case.size
    i, j = np.arange(height)[:, None], np.arange(width)
    known = case_values(case, i if rays.from_top else i[::-1], j, rays)
    known |= {name: _remembered(function) for name, function in SHAPES.items()}
    known |= {"far_away": _far_away, "plain": _plain}
    return known | case.values["scene"]


def case_values(case: CheckCase, i: Any, j: Any, task: RayTask) -> dict[str, Any]:
    """Return the values of a case's camera and of its pixels (i, j)."""
    assert case.camera is not None and case.size is not None
    vectors = {"target": np.asarray(case.target, float), "up": np.asarray(case.up, float)}
    return ray_values(case.camera, i, j, case.size, task) | vectors


def _remembered(function: Callable[..., Any]) -> Callable[..., Any]:
    """Cache intersections, because many mistakes leave the rays unchanged."""
    answers: dict[tuple[bytes, bytes, int], Any] = {}

    def asked(origin: Any, direction: Any, shape: Mapping[str, Any]) -> Any:
        key = np.asarray(origin).tobytes(), np.asarray(direction).tobytes(), id(shape)
        if key not in answers:
            answers[key] = function(origin, direction, shape)
        return answers[key]

    return asked


def _far_away(width: float, height: float) -> Any:
    return np.full((int(height), int(width)), np.inf)


def _plain(color: Sequence[float], width: float, height: float) -> Any:
    return np.broadcast_to(np.asarray(color, float), (int(height), int(width), 3)).copy()
