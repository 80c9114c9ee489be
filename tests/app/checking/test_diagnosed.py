"""Wrong answers reach the table of mistakes, in the task's own words."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lucida.app.checking.builtin import BUILTIN
from lucida.app.checking.calls import Run
from lucida.app.checking.checked import judged
from lucida.app.checking.diagnosed import MOST
from lucida.app.checking.kinds import KINDS
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import View

TASKS = {task.name: task for task in BUILTIN}


def diagnosis_of(task, answers):
    cases = KINDS[task.kind].cases(task)
    return judged(task, cases, Run(tuple(answers(cases)))).diagnosis


def test_answers_that_are_all_misses():
    for name in ("hit-sphere", "hit-triangle", "closest-hit"):
        told = diagnosis_of(TASKS[name], lambda cases: [None] * len(cases))
        assert told.sentences == ("You never find a hit.",)


def test_right_directions_that_are_not_of_unit_length():
    task = TASKS["viewing-ray"]
    task = replace(task, conventions=replace(task.conventions, unit=True))

    def twice(cases):
        return [[case.right[0].tolist(), (2 * case.right[1]).tolist()] for case in cases]

    assert "not of length 1" in diagnosis_of(task, twice).sentences[0]


def test_of_a_large_image_some_rays_are_looked_at():
    camera = Camera.look_at((3, 2, 4), (0, 0, 0))
    task = replace(TASKS["viewing-ray"], views=(View(camera, False),), count=0, size=(64, 48))

    def flipped(cases):
        rays = camera.ray(*np.array([(47 - c.pixel[0], c.pixel[1]) for c in cases]).T, (64, 48))
        return np.stack([rays.origin, rays.direction], 1).tolist()

    assert MOST < 64 * 48
    found = diagnosis_of(task, flipped).candidates  # of one symmetric camera, others look the same
    assert "rows count upwards" in [mistake.name for one in found for mistake in one]
