"""Cases of viewing rays, of many cameras together, and the distances between answers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.program import Mistakes, Program
from app.checking.mistakes.rays import RayTask, ray_values, run_rays
from renderer.camera import Camera, Size

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class RayCase:
    """The ray of one pixel that was asked for.

    pixel: (row, column), 0-based, row 0 at the top.
    target, up: the vectors that the task passes instead of a basis.
    """

    camera: Camera
    size: Size
    pixel: tuple[int, int]
    target: tuple[float, float, float] | None = None
    up: tuple[float, float, float] | None = None


def images(cases: Sequence[RayCase]) -> Iterator[tuple[int, int]]:
    """Yield (first, last + 1) of consecutive cases with the same camera and size."""
    first = 0
    for number in range(1, len(cases) + 1):
        if number == len(cases) or not _is_same_image(cases[number], cases[first]):
            yield first, number
            first = number


def _is_same_image(one: RayCase, other: RayCase) -> bool:
    return (one.camera, one.size, one.target, one.up) == (
        other.camera, other.size, other.target, other.up
    )  # fmt: skip


def known_values(cases: Sequence[RayCase], task: RayTask) -> dict[str, Any]:
    """Return the values that the programs' lines use, for all cases: numbers (N, 1), vectors (N,
    3).
    """
    parts: dict[str, list[Any]] = {}
    for first, last in images(cases):
        case = cases[first]
        i, j = np.array([one.pixel for one in cases[first:last]]).T
        values = ray_values(case.camera, i, j, case.size, task)
        for name in ("target", "up"):
            given = getattr(case, name)
            values[name] = np.full(3, np.nan) if given is None else np.asarray(given, float)
        for name, value in values.items():
            array = np.asarray(value, float)
            shape = array.shape if array.shape == (4, 4) else np.atleast_1d(array).shape[-1:]
            parts.setdefault(name, []).append(np.broadcast_to(array, (last - first, *shape)))
    return {name: np.concatenate(arrays) for name, arrays in parts.items()}


def largest_numbers(known: dict[str, Any]) -> Floats:
    """Return the largest intermediate result of each case, from |eye| and a point of the viewport;
    (N,).
    """
    length = {name: np.linalg.norm(known[name], axis=-1) for name in ("eye", "u", "v", "w")}
    sides = {name: np.abs(known[name][:, 0]) for name in ("left", "right", "bottom", "top")}
    across = np.maximum(sides["left"], sides["right"]) * length["u"]
    along = np.maximum(sides["bottom"], sides["top"]) * length["v"]
    return np.asarray(length["eye"] + across + along + known["distance"][:, 0] * length["w"])


class RayTrial:
    """The cases with given and correct rays, (N, 2, 3) each.

    any_origin: any point of the ray may be its origin.
    """

    def __init__(
        self,
        cases: Sequence[RayCase],
        given: Floats,
        task: RayTask,
        any_origin: bool = False,
    ) -> None:
        self.count = len(cases)
        self.known = known_values(cases, task)
        self.given = given
        rays = [case.camera.ray(*case.pixel, case.size) for case in cases]
        self.right = np.array(rays, float).reshape(-1, 2, 3)
        self.scale = largest_numbers(self.known)
        self.any_origin = any_origin

    def errors(
        self, program: Program, tried: Sequence[Mistakes], cases: Numbers
    ) -> tuple[Floats, Floats]:
        made = self.made(program, tried, cases)
        given = self.apart(self.given[cases], made, cases)
        return given, self.apart(self.right[cases], made, cases)

    def made(self, program: Program, tried: Sequence[Mistakes], cases: Numbers) -> Floats:
        """Return the rays with each of these mistakes, (tried, cases, 2, 3)."""
        known = {name: value[cases] for name, value in self.known.items()}
        return np.array([run_rays(program, known, one) for one in tried]).swapaxes(1, 2)

    def apart(self, rays: Floats, made: Floats, cases: Numbers) -> Floats:
        """Return the distance between rays, relative to the largest intermediate result: (...,
        cases).

        It is 0 if neither is finite: both divide by zero in the same place.
        """
        with np.errstate(all="ignore"):
            origins, directions = made[..., 0, :], made[..., 1, :]
            length = np.linalg.norm(directions, axis=-1)
            own = np.linalg.norm(rays[..., 1, :], axis=-1)
            scale = self.scale[cases] + np.linalg.norm(origins, axis=-1) + length
            along = directions / length[..., None]
            moved = rays[..., 0, :] - origins
            if self.any_origin:
                moved = moved - np.sum(moved * along, axis=-1)[..., None] * along
            turned = np.linalg.norm(rays[..., 1, :] / own[..., None] - along, axis=-1) * length
            no_way = (own == 0) | (length == 0)
            turned = np.where(no_way, np.maximum(own, length), turned)
            apart = np.maximum(np.linalg.norm(moved, axis=-1), turned) / scale
        numbers = [np.isfinite(one).all(axis=(-2, -1)) for one in (rays, made)]
        return np.where(numbers[0] | numbers[1], apart, 0.0)
