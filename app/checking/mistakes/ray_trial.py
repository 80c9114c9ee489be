"""Cases of viewing rays, of many cameras together, and the distances between answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.kinds.viewing_ray import largest_number
from lucida.app.checking.mistakes.program import Mistakes, Program
from lucida.app.checking.mistakes.rays import RayTask, ray_values, run_rays
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

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


def known_values(cases: Sequence[RayCase], task: RayTask) -> dict[str, Any]:
    """Return the values that the programs' lines use, for all cases: numbers (N, 1), vectors
    (N, 3), matrices (N, 4, 4).
    """
    made = []
    for case in cases:
        values = ray_values(case.camera, *case.pixel, case.size, task)
        for name in ("target", "up"):
            given = getattr(case, name)
            values[name] = np.full(3, np.nan) if given is None else given
        made.append(values)
    return {name: np.array([np.atleast_1d(one[name]) for one in made], float) for name in made[0]}


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
        self.scale = np.array([largest_number(case.camera) for case in cases])
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
