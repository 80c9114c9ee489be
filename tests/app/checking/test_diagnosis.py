"""Wrong rays by name: one mistake, two at once, never another; right rays never."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from asked_rays import KINDS, TASKS, asked_cases, made_camera
from numpy.typing import NDArray

from lucida.app.checking.mistakes.candidates import LOOSE, candidates
from lucida.app.checking.mistakes.program import Mistakes, Program
from lucida.app.checking.mistakes.ray_trial import RayCase, RayTrial
from lucida.app.checking.mistakes.rays import RayTask, ray_program

PROJECTIONS = ("perspective", "parallel")


class KeptTrial(RayTrial):
    """One that remembers what programs make: many answers to the same cases."""

    def made(
        self, program: Program, tried: Sequence[Mistakes], cases: NDArray[np.intp]
    ) -> NDArray[np.float64]:
        kept = self.__dict__.setdefault("kept", {})
        key = (len(tried), tuple(tried[:1]), tuple(tried[-1:]), cases.tobytes())
        if key not in kept:
            kept[key] = super().made(program, tried, cases)
        return kept[key]


def alone(trial: RayTrial, program: Program, mistakes: Mistakes) -> NDArray[np.float64]:
    return RayTrial.made(trial, program, [mistakes], np.arange(trial.count))[0]


def same(trial: RayTrial, rays: NDArray[np.float64], others: NDArray[np.float64]) -> bool:
    """By numbers of its own: origins, and directions up to a positive factor."""
    with np.errstate(all="ignore"):
        along, along_others = (
            each[:, 1] / np.linalg.norm(each[:, 1], axis=1)[:, None] for each in (rays, others)
        )
    near = 1e-9 * (1 + np.abs(others[:, 0]).max())
    clear = (np.linalg.norm(others[:, 1], axis=1) > 1e-9) & np.isfinite(along).all(axis=1)
    return bool(
        (np.abs(rays[:, 0] - others[:, 0]) <= near).all()
        and (np.abs(along - along_others)[clear] <= 1e-9).all()
    )


def as_student(rays: NDArray[np.float64], how: str) -> NDArray[np.float64]:
    """In another form that is as right: normalised, longer, in float32."""
    if how == "float32":
        return rays.astype(np.float32).astype(float)
    made = rays.copy()
    length = np.linalg.norm(made[:, 1], axis=1)
    factor = np.where(length > 0, 1 / np.where(length > 0, length, 1), 0)
    made[:, 1] *= factor[:, None] if how == "unit" else np.linspace(0.1, 10, len(made))[:, None]
    return made


@pytest.mark.parametrize("name", TASKS)
def test_each_mistake_is_named(name):
    """Use 52 cameras together, with rays of any length in float64, and of length 1, in float32,
    too.
    """
    task = TASKS[name]
    program = ray_program(task)
    trial = KeptTrial(asked_cases(task, 52), np.zeros((1, 2, 3)), task)
    everywhere = np.ones(trial.count, bool)
    named = 0
    for mistake in program.mistakes:
        rays = alone(trial, program, (mistake,))
        if same(trial, rays, trial.right):
            continue
        named += 1
        for how in ("unit", "long") if named % 4 else ("unit", "float32"):
            trial.given = as_student(rays, how)
            found = candidates(program, trial, everywhere)
            assert (mistake,) in found, (mistake.name, how)
            for others in found:
                assert len(others) == 1
                assert same(trial, rays, alone(trial, program, others)), (mistake.name, others)
    assert named >= len(program.mistakes) - 3


@pytest.mark.parametrize(("name", "first"), [("perspective", 0), ("parallel", 1)])
def test_two_mistakes_at_once_are_named(name, first):
    """Every other pair, of eight cameras together: by their names, or by those of what is the
    same.
    """
    task = TASKS[name]
    program = ray_program(task)
    trial = KeptTrial(asked_cases(task, 8), np.zeros((1, 2, 3)), task)
    everywhere = np.ones(trial.count, bool)
    pairs, exactly = list(program.pairs())[first::2], 0
    rays_of = dict(zip(pairs, trial.made(program, pairs, np.arange(trial.count)), strict=True))
    for pair, rays in rays_of.items():
        if same(trial, rays, trial.right):
            continue
        trial.given = rays
        found = candidates(program, trial, everywhere)
        assert found, [mistake.name for mistake in pair]
        exactly += pair in found
        for others in found:
            if others != pair:
                assert same(trial, rays, alone(trial, program, others)), (pair, others)
    assert len(pairs) > 200 and exactly > 0.85 * len(pairs)


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize(("form", "count"), [(np.float32, 5_000), (np.float64, 500)])
def test_right_answers_of_10_000_cameras_have_no_name(projection, form, count):
    """5,000 cameras in each projection, a pixel each, computed in float32; fewer in float64: of any
    length, nothing is told of them, even if they were handed over as wrong."""
    random = np.random.default_rng(7)
    task = RayTask(projection)
    program = ray_program(task)
    cases = []
    for number in range(count):
        camera = made_camera(random, KINDS[number % len(KINDS)], projection)
        width, height = random.integers(2, 2000, 2).tolist()
        pixel = (int(random.integers(height)), int(random.integers(width)))
        cases.append(RayCase(camera, (width, height), pixel))
    trial = RayTrial(cases, np.zeros((1, 2, 3)), task)
    known = {key: np.asarray(value, form) for key, value in trial.known.items()}
    origin, direction = program.run(known)
    assert origin.dtype == direction.dtype == form
    length = random.uniform(1e-3, 1e3, len(cases)).astype(form)
    given = np.empty((len(cases), 2, 3))
    given[:, 0], given[:, 1] = origin, direction * length[:, None]
    assert trial.apart(given, trial.right, np.arange(len(cases))).max() < LOOSE / 4
    for first in range(0, len(cases), 500):
        chosen = slice(first, first + 500)
        part = RayTrial(cases[chosen], given[chosen], task)
        assert candidates(program, part, np.ones(500, bool)) == ()
