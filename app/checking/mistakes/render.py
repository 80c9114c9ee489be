"""The lines of both loops, and their mistakes: the ray, then the nearest object of each pixel."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from lucida.app.checking.mistakes.catalogue import part
from lucida.app.checking.mistakes.hits import SHAPES
from lucida.app.checking.mistakes.program import Program
from lucida.app.checking.mistakes.rays import RayTask, ray_program, ray_values
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size


@functools.lru_cache(32)
def render_program(task: RayTask) -> Program:
    """Return the ray's lines, then both loops. Pairs in the ray are left to its task."""
    rays, (lines, mistakes) = ray_program(task), part("render")
    others = (one for one in rays.mistakes if one.name != "normalised")
    paired = frozenset(line.key for line in lines)
    return Program((*rays.lines, *lines), (*mistakes, *others), ("answer",), paired)


def render_values(
    camera: Camera,
    size: Size,
    task: RayTask,
    objects: Sequence[Mapping[str, Any]],
    background: Sequence[float],
) -> dict[str, Any]:
    """Return the values that the lines use, for all pixels of an image. Rows count as in the
    task.
    """
    i, j = np.arange(size[1])[:, None], np.arange(size[0])
    if not task.from_top:
        i = i[::-1]
    known = ray_values(camera, i, j, size, task)
    return known | {name: _remembered(function) for name, function in SHAPES.items()} | {
        "objects": objects, "background": background,
        "far_away": _far_away, "plain": _plain,
    }  # fmt: skip


def _remembered(function: Callable[..., Any]) -> Callable[..., Any]:
    """Cache intersections: many mistakes leave the rays unchanged, so each object is asked only
    once.
    """
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
