"""The drawing of a wrong answer in the outside view, next to the correct one. Pure."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lucida.app.instruments.outside import answers
from lucida.app.instruments.outside.diagram import Item, Role
from lucida.app.instruments.outside.second_camera import GivenRay
from lucida.app.state.kept_lecture import Judgement
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats

from .exercises import RayExercise, VectorExercise, Wanted, is_close, is_multiple, vectors
from .model import Exercise

BASIS: dict[str, Role] = {"u": "u", "v": "v", "w": "w"}


def ghosts(
    task: Exercise | None,
    texts: tuple[tuple[str, str], ...],
    camera: Camera,
    end: float,
) -> tuple[Item, ...]:
    """Return the drawing of a wrong answer; empty if it has nothing to draw.

    texts: the typed text of each field. camera: of the step. end: the ray parameter at the
    scene's end.
    """
    items: list[Item] = []
    if isinstance(task, RayExercise):
        items = _ray(task, dict(texts), end)
    elif isinstance(task, VectorExercise):
        items = _vectors(task, dict(texts), camera)
    return tuple(items)


def _ray(task: RayExercise, texts: Mapping[str, str], end: float) -> list[Item]:
    given = vectors(texts, task.fields)
    if isinstance(given, Judgement):
        return []
    ray = task.camera.ray(*task.pixel, task.size)
    correct = GivenRay(np.asarray(ray.origin, float), np.asarray(ray.direction, float))
    reach = end * float(np.linalg.norm(correct.direction))
    return answers.ray(GivenRay(given["origin"], given["direction"]), correct, reach)


def _vectors(task: VectorExercise, texts: Mapping[str, str], camera: Camera) -> list[Item]:
    given = vectors(texts, task.fields)
    if isinstance(given, Judgement):
        return []
    items: list[Item] = []
    for wanted in task.answers:
        exact = np.asarray(wanted.value, float)
        same = is_multiple if wanted.scaled else is_close
        if not same(given[wanted.name], exact, task.tolerance):
            items += _vector(wanted, given[wanted.name], exact, camera)
    return items


def _vector(wanted: Wanted, given: Floats, exact: Floats, camera: Camera) -> list[Item]:
    if wanted.drawn == "point":
        return answers.point(f"vec({wanted.name})", camera.eye, given, exact)
    if wanted.drawn == "corner":
        corners = [_corner(camera, value) for value in (given, exact)]
        return answers.point("corner", camera.eye, *corners)
    role = BASIS.get(wanted.name, "extra")
    return answers.vector(wanted.name, role, camera.eye, given, exact)


def _corner(camera: Camera, left_top_d: Floats) -> Floats:
    """Return the viewport's upper left corner, from left, top and the distance."""
    left, top, distance = left_top_d.tolist()
    u, v, w = (np.asarray(axis) for axis in (camera.u, camera.v, camera.w))
    return np.asarray(camera.eye) + left * u + top * v - distance * w
