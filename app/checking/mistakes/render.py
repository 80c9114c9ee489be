"""The lines of both loops, and their mistakes: the ray, then the nearest object of each pixel."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from app.checking.mistakes.hits import CLOSEST, SHAPES
from app.checking.mistakes.images import flipped
from app.checking.mistakes.program import CodeLine, Mistake, Program
from app.checking.mistakes.rays import RayTask, ray_program, ray_values
from renderer.camera import Camera, Size

PART = "The program"

LINES = (
    CodeLine("start", "best, image = far_away(width, height), plain(background, width, height)"),
    CodeLine("loop", "for shape in objects:"),
    CodeLine("t", "    t = hit(origin, direction, shape)"),
    CodeLine("if", "    closer = t < best"),
    CodeLine("color", "    image[closer] = shape['color']"),
    CodeLine("keep", "    best = where(closer, t, best)"),
    CodeLine("answer", "answer = image"),
)


def _one(name: str, key: str, code: str, hint: str) -> Mistake:
    return Mistake(name, ((key, code),), hint, PART)


def _hint(name: str) -> str:
    return next(one.hint for one in CLOSEST.mistakes if one.name == name)


MISTAKES = (
    _one("the last object wins", "if", "    closer = t < inf", _hint("the last object wins")),
    _one("the first object wins", "if", "    closer = (t < inf) & (best == inf)",
         _hint("the first object wins")),
    _one("the farthest wins", "if", "    closer = (t < inf) & ((best == inf) | (t > best))",
         _hint("the farthest wins")),
    _one("t < 0 accepted", "t", "    t = first_crossing(origin, direction, shape)",
         _hint("t < 0 accepted")),
    _one("the far root", "t", "    t = last_crossing(origin, direction, shape)",
         _hint("the far root")),
    _one("spheres alone", "t",
         "    t = hit(origin, direction, shape) if shape['type'] == 'sphere' else best",
         _hint("spheres alone")),
    _one("triangles alone", "t",
         "    t = hit(origin, direction, shape) if shape['type'] == 'triangle' else best",
         _hint("triangles alone")),
    _one("the last object is not asked", "loop", "for shape in objects[:-1]:",
         _hint("the last object is not asked")),
    _one("the first object is not asked", "loop", "for shape in objects[1:]:",
         _hint("the first object is not asked")),
    _one("the background black", "start",
         "best, image = far_away(width, height), plain([0, 0, 0], width, height)",
         "Where nothing is hit, the pixel is the scene's background."),
    _one("the background white", "start",
         "best, image = far_away(width, height), plain([1, 1, 1], width, height)",
         "Where nothing is hit, the pixel is the scene's background."),
    _one("bytes for numbers from 0 to 1", "answer", "answer = 255 * image",
         "Colours go from 0 to 1 here: do not multiply by 255."),
    _one("blue and red exchanged", "answer", "answer = image[:, :, ::-1]",
         "A colour is red, green, blue, in this order."),
    _one("whole bytes for numbers from 0 to 1", "answer", "answer = floor(255 * image)",
         "Colours go from 0 to 1 here: do not multiply by 255."),
    _one("rounded to whole bytes", "answer", "answer = floor(255 * image + 0.5)",
         "Colours go from 0 to 1 here: do not multiply by 255."),
    _one("the last row and column are missing", "answer",
         "image[-1], image[:, -1] = 0, 0\nanswer = image",
         "The loops go over all rows and columns, the last ones too."),
    _one("the last row is missing", "answer", "image[-1] = 0\nanswer = image",
         "The loop goes over all rows, the last one too."),
    _one("the last column is missing", "answer", "image[:, -1] = 0\nanswer = image",
         "The loop goes over all columns, the last one too."),
    _one("the first row and column are missing", "answer",
         "image[0], image[:, 0] = 0, 0\nanswer = image",
         "The loops go over all rows and columns, from the first one."),
    *flipped("image", PART),
)  # fmt: skip


@functools.lru_cache(32)
def render_program(task: RayTask) -> Program:
    rays = ray_program(task)
    mistakes = (*MISTAKES, *(one for one in rays.mistakes if one.name != "normalised"))
    loops = frozenset(line.key for line in LINES)  # pairs in a ray's lines are viewing_ray's
    return Program((*rays.lines, *LINES), mistakes, ("answer",), loops)


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
