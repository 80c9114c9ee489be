"""Cases of hits and images: clear ones, in float32 too, and what pixels of an image are judged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida.app.checking.kinds import KINDS
from lucida.app.checking.kinds.basis import conditioning
from lucida.app.checking.kinds.hits import MARGIN
from lucida.app.checking.kinds.shapes import hits
from lucida.app.checking.task_file import BUILTIN

TASKS = {task.name: task for task in BUILTIN}


def cases(name, count):
    return KINDS[name].cases(replace(TASKS[name], count=count))


def differ(name, made, given):
    found, problems = KINDS[name].given(TASKS[name], made, given)
    assert not problems
    return KINDS[name].wrong(TASKS[name], made, found)


def sphere32(origin, direction, center, radius):
    o, d, c = (np.float32(part) for part in (origin, direction, center))
    oc = o - c
    a, h, k = d @ d, oc @ d, oc @ oc - np.float32(radius) ** 2
    disc = h * h - a * k
    if disc < 0:
        return None
    roots = [(-h - np.sqrt(disc)) / a, (-h + np.sqrt(disc)) / a]
    assert all(root.dtype == np.float32 for root in roots)
    return next((float(root) for root in roots if root > 0), None)


def triangle32(origin, direction, a, b, c):
    o, d, a, b, c = (np.float32(part) for part in (origin, direction, a, b, c))
    n = np.cross(b - a, c - a)
    if n @ d == 0:
        return None
    t = (n @ (a - o)) / (n @ d)
    p = o + t * d
    sides = [np.cross(q - r, p - r) @ n for r, q in ((a, b), (b, c), (c, a))]
    return float(t) if t > 0 and min(sides) > 0 else None


@pytest.mark.parametrize(
    ("name", "solve"), [("hit-sphere", sphere32), ("hit-triangle", triangle32)]
)
def test_float32_is_right_in_six_hundred_cases(name, solve):
    made = cases(name, 600)
    given = [solve(*(value for _, value in case.arguments)) for case in made]
    assert not differ(name, made, given).any()
    count = sum(answer is not None for answer in given)
    assert 180 < count < 510
    nearly = [None if answer is None else answer * 1.02 for answer in given]
    assert np.count_nonzero(differ(name, made, nearly)) == count


@pytest.mark.parametrize("name", ["hit-sphere", "hit-triangle"])
def test_what_is_asked_is_clear(name):
    for case in cases(name, 300):
        shape = {**case.values, "type": name.removeprefix("hit-")}
        assert hits(case.values["origin"], case.values["direction"], shape)[1] > MARGIN


@pytest.mark.parametrize("name", ["hit-sphere", "closest-hit", "basis"])
def test_answers_that_are_missing_are_wrong(name):
    made = cases(name, 5)
    assert differ(name, made, []).all()


@pytest.mark.parametrize("name", ["render", "render-parallel"])
def test_one_object_hides_another_in_every_image(name):
    for case in KINDS["render"].cases(replace(TASKS[name], count=20)):
        rays = case.camera.rays(case.size)
        t = [hits(*rays, shape)[0] for shape in case.values["scene"]["objects"]]
        assert (np.isfinite(t).sum(axis=0) > 1).any()


def test_a_basis_is_as_exact_as_its_vectors_are_far_from_parallel_and_no_longer_ones_change_it():
    eye, target, up = np.array([0.0, 0, 3]), np.zeros(3), np.array([0.0, 1, 0])
    assert conditioning(eye, target, up) == pytest.approx(2)
    assert conditioning(eye, target, (0, 0.5, 0.75**0.5)) == pytest.approx(4)
    assert conditioning(10 * eye, target, 0.01 * up) == pytest.approx(2)
    assert conditioning(3 * eye, 2 * eye, up) == pytest.approx(1 + 15 / 3)
