"""The viewing ray of a pixel, in the words of any course.

Answers in the kind's own form are arrays (N, 2, 3): origin and direction in the world.

Tolerances. Let S = X|u| + Y|v| + d|w|, where X = max(|left|, |right|) + (right - left) and Y is
the same for bottom and top. No intermediate result is larger than M = |eye| + S: neither a point
on the viewport nor the difference after the eye is subtracted again. An origin is correct within
FLOAT32 * M; a direction, as an angle, within FLOAT32 * M / |direction|. If the basis follows from
a target, eye - target cancels as well, and so does up x w if the two are nearly parallel: the
angle grows by the tolerance of basis.py. A direction of unit length is correct within FLOAT32. The
generated cameras have M / |direction| < 60, which is a tolerance of 3e-4; half a pixel of their
images is at least 1e-2.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.calls import Call
from lucida.app.checking.cases import shots
from lucida.app.checking.conventions import (
    CAMERA,
    CAMERA_WORDS,
    PAIRS,
    PIXEL_WORDS,
    Conventions,
    Shot,
    argument_lists,
)
from lucida.app.checking.kinds.basis import conditioning
from lucida.app.checking.kinds.kind import FLOAT32, Cases, CheckKind, Flags, Read, tolerances
from lucida.app.checking.kinds.values import in_order, shown, text_of
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.renderer.camera.camera import Camera

Floats = NDArray[np.float64]


class ViewingRayKind(CheckKind):
    name = "viewing-ray"
    function = "viewing_ray"
    words: ClassVar[Mapping[str, str]] = {
        **PIXEL_WORDS,
        **{
            name: f"two numbers: {PIXEL_WORDS[a]}; {PIXEL_WORDS[b]}"
            for name, (a, b) in PAIRS.items()
        },
        **CAMERA_WORDS,
        CAMERA: "an object with these fields",
    }
    arguments = ("i", "j", "width", "height", "camera")
    returns = ("origin", "direction")
    return_words: ClassVar[Mapping[str, str]] = {
        "origin": "where the ray starts",
        "direction": "where it goes",
    }
    answer = "origin and direction, three numbers each"

    def cases(self, task: CheckTask) -> list[CheckCase]:
        return [case for shot in shots(task) for case in cases_of(task, shot)]

    def calls(self, task: CheckTask, cases: Cases) -> list[Call]:
        if not task.vectorised:
            return super().calls(task, cases)
        return [
            Call(task.function, _vectorised(task, cases[first:last]), True, task.notation)
            for first, last in _images(cases)
        ]

    def given(self, task: CheckTask, cases: Cases, values: Sequence[Any]) -> Read:
        returns = task.conventions.returns
        read = _vectorised_rays if task.vectorised else super().given
        rays, problems = read(task, cases, values)
        places = [("origin", "direction").index(name) for name in returns]
        given = np.full((len(cases), 2, 3), np.nan)
        given[:, places] = rays
        if task.conventions.space == "camera":
            for first, last in _images(cases):
                given[first:last] = _to_world(task.conventions, cases[first], given[first:last])
        for place in {0, 1} - set(places):  # parts that are not asked for
            given[:, place] = self.right(cases)[:, place]
        return given, problems

    def wrong(self, task: CheckTask, cases: Cases, given: Floats) -> Flags:
        return ~are_right(task.conventions, self.right(cases), given, tolerances(cases))

    def answer_text(self, task: CheckTask, case: CheckCase, answer: Floats) -> str:
        ray = np.asarray(answer, float)
        if task.conventions.space == "camera":
            ray = _to_camera(task.conventions, case, ray)
        parts = dict(zip(("origin", "direction"), ray.tolist(), strict=True))
        return ", ".join(f"{name} {text_of(parts[name])}" for name in task.conventions.returns)

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        assert case.size is not None and case.pixel is not None
        width, height = case.size
        i, j = case.pixel
        where = f"pixel in row {i}, column {j} (from 0, from the top left) of {width}x{height}"
        return where, *super().first_wrong(task, case, answer)[1:]


def cases_of(task: CheckTask, shot: Shot) -> list[CheckCase]:
    """Return a case for each pixel of an image."""
    width, height = shot.size
    i, j = (part.ravel() for part in np.indices((height, width)))
    rays = shot.camera.ray(i, j, shot.size)
    right = np.stack([rays.origin, rays.direction], axis=1)
    if task.conventions.unit:
        right[:, 1] /= np.linalg.norm(right[:, 1], axis=1, keepdims=True)
    tolerances = np.column_stack(_tolerances(task.conventions, shot, rays.direction))
    lists = argument_lists(shot, task.conventions, i, j)
    names = [name for name, _ in task.conventions.arguments]
    columns = [lists[word] for _, word in task.conventions.arguments]
    pixels = zip(i.tolist(), j.tolist(), strict=True)
    return [
        CheckCase(
            tuple(zip(names, values, strict=True)),
            ray,
            tolerance,
            camera=shot.camera,
            size=shot.size,
            pixel=pixel,
            target=shot.target,
            up=shot.up,
        )
        for *values, ray, tolerance, pixel in zip(*columns, right, tolerances, pixels, strict=True)
    ]


def _tolerances(conventions: Conventions, shot: Shot, directions: Floats) -> tuple[Floats, Floats]:
    """Return the tolerances of origins and of directions, (N,) each; the module's docstring derives
    them.
    """
    camera = shot.camera
    largest = largest_number(camera)
    angle = largest / np.linalg.norm(directions, axis=1)
    origin = np.full(len(directions), largest)
    if {"target", "up"} & conventions.words:
        basis = conditioning(camera.eye, shot.target, shot.up)
        angle = angle + basis
        origin = origin + basis * _reach(camera)
    return FLOAT32 * origin, FLOAT32 * angle


def _reach(camera: Camera) -> float:
    """Return the X|u| + Y|v| of the module's docstring."""
    left, right, bottom, top = camera.viewport
    x = max(abs(left), abs(right)) + right - left
    y = max(abs(bottom), abs(top)) + top - bottom
    return float(x * np.linalg.norm(camera.u) + y * np.linalg.norm(camera.v))


def largest_number(camera: Camera) -> float:
    """Return the M of the module's docstring."""
    depth = camera.distance * np.linalg.norm(camera.w)
    return float(np.linalg.norm(camera.eye) + _reach(camera) + depth)


def are_right(conventions: Conventions, right: Floats, given: Floats, tolerance: Floats) -> Flags:
    """Return the correct rays, bool (N,). right, given: (N, 2, 3) in the world; tolerance:
    (N, 2).
    """
    with np.errstate(all="ignore"):
        lengths = _norms(given[:, 1])
        directions = _unit(given[:, 1])
        wanted = _unit(right[:, 1])
        turned = _norms(np.cross(directions, wanted))
        ahead = np.sum(directions * wanted, axis=1) > 0
        fine = ahead & (turned <= tolerance[:, 1])
        apart = given[:, 0] - right[:, 0]
        along = np.zeros(len(right))
        if conventions.any_origin:
            along = np.sum(apart * wanted, axis=1)
            apart = apart - along[:, None] * wanted
        fine &= _norms(apart) <= tolerance[:, 0] + along * tolerance[:, 1]
        fine &= along >= -tolerance[:, 0]
        if conventions.unit:
            fine &= np.abs(lengths - 1) <= FLOAT32
    return fine


def _norms(vectors: Floats) -> Floats:
    """Return lengths without overflow: a direction may be of any length."""
    largest = np.max(np.abs(vectors), axis=1)
    return largest * np.linalg.norm(vectors / np.where(largest > 0, largest, 1)[:, None], axis=1)


def _unit(vectors: Floats) -> Floats:
    scaled = vectors / np.max(np.abs(vectors), axis=1, keepdims=True)
    return scaled / np.linalg.norm(scaled, axis=1, keepdims=True)


def _frame(conventions: Conventions, case: CheckCase) -> tuple[Floats, Floats]:
    """Return the axes of camera space as columns, and the eye."""
    assert case.camera is not None
    return case.camera.basis * np.array(conventions.axes, float), np.asarray(case.camera.eye)


def _to_world(conventions: Conventions, case: CheckCase, rays: Floats) -> Floats:
    frame, eye = _frame(conventions, case)
    with np.errstate(all="ignore"):
        world = rays @ frame.T
    world[..., 0, :] += eye
    return world


def _to_camera(conventions: Conventions, case: CheckCase, ray: Floats) -> Floats:
    frame, eye = _frame(conventions, case)
    return np.linalg.solve(frame, (ray - np.array([eye, np.zeros(3)])).T).T


def _images(cases: Cases) -> list[tuple[int, int]]:
    """Return (first, last + 1) of the cases of each image."""
    starts = [
        number
        for number, case in enumerate(cases)
        if number == 0 or case.camera is not cases[number - 1].camera
    ]
    return list(zip(starts, [*starts[1:], len(cases)], strict=True))


def _vectorised(task: CheckTask, cases: Cases) -> tuple[tuple[str, Any], ...]:
    """Return the arguments of a single call for all pixels. Arguments that depend on the pixel are
    lists.
    """
    columns = zip(*([value for _, value in case.arguments] for case in cases), strict=True)
    return tuple(
        (name, [*values] if word in PIXEL_WORDS or word in PAIRS else values[0])
        for (name, word), values in zip(task.conventions.arguments, columns, strict=True)
    )


def _vectorised_rays(task: CheckTask, cases: Cases, values: Sequence[Any]) -> Read:
    """Return the rays from calls that are each for a whole image: (N, parts, 3)."""
    returns = task.conventions.returns
    rays = np.full((len(cases), len(returns), 3), np.nan)
    problems: dict[int, str] = {}
    for value, (first, last) in zip(values, _images(cases), strict=False):
        parts = in_order(value, returns)
        parts = [parts] if len(returns) == 1 and isinstance(parts, list) else parts
        try:
            assert isinstance(parts, list) and len(parts) == len(returns)
            for place, part in enumerate(parts):
                array = np.array(part, float)
                rays[first:last, place] = array if array.ndim == 1 else array.reshape(-1, 3)
        except (AssertionError, TypeError, ValueError):
            problems[first] = (
                f"returned {shown(value)}, not {' and '.join(returns)} "
                f"with three numbers for each of {last - first} pixels"
            )
    return rays, problems
