"""Wrong answers to each kind of task reach the table of mistakes, in the task's own words."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.checking.builtin import BUILTIN
from app.checking.calls import Run
from app.checking.checked import checked, judged
from app.checking.diagnosed import MOST
from app.checking.kinds import KINDS
from app.checking.mistakes.rays import WORDS
from app.checking.ray_words import ray_task
from app.checking.running.file import FileStudent
from renderer.camera import Camera
from renderer.pixels import Indexing
from renderer.scene.model import View

ANSWERS = Path(__file__).parent / "answers"
TASKS = {task.name: task for task in BUILTIN}

# A wrong answer of tests/checking/answers, and the mistake.
NAMED = {
    ("viewing-ray", "viewing_ray.wrong_forwards"): "along +w",
    ("viewing-ray-parallel", "parallel_ray.wrong_at_the_eye"): "all rays start at the eye",
    ("basis", "basis.wrong_upside_down"): "u x w for w x u",
    ("hit-sphere", "hit_sphere.wrong_far_root"): "the far root",
    ("hit-triangle", "hit_triangle.wrong_plane"): "the whole plane",
    ("closest-hit", "closest_hit.wrong_last"): "the last object wins",
    ("render", "render.wrong_last_object"): "the last object wins",
    ("to-gray", "images.wrong_gray_mean"): "the mean",
    ("to-bitmap", "images.wrong_bitmap_above"): "the threshold itself",
    ("memory-offset", "images.wrong_offset_bytes"): "bytes for pixels",
}


@pytest.mark.parametrize(("task", "answer"), NAMED)
def test_a_mistake_of_each_kind_has_its_name(task, answer):
    file, _, function = answer.partition(".")
    with FileStudent(ANSWERS / f"{file}.py") as student:
        asked = replace(TASKS[task], function=function)
        result = checked(student, asked)
        assert result.diagnosis is not None
        assert [one.name for one in result.diagnosis.candidates[0]] == [NAMED[task, answer]]
        told_less = checked(student, replace(asked, feedback="first-wrong"))
        assert told_less.status == "wrong" and told_less.diagnosis is None


def diagnosis_of(task, answers):
    cases = KINDS[task.kind].cases(task)
    return judged(task, cases, Run(tuple(answers(cases)))).diagnosis


BOTH_LOOPS = """
import numpy as np
def render(scene, camera, width, height):
    image = np.empty((height, width, 3))
    image[:] = scene.background
    e, u, v, w = (np.array(camera[name]) for name in ("eye", "u", "v", "w"))
    for i in range(height):
        for j in range(width):
            x = camera.left + (j + HALF) / width * (camera.right - camera.left)
            y = camera.top - (i + HALF) / height * (camera.top - camera.bottom)
            o, d = e, x * u + y * v - camera.distance * w
            if camera.projection == "parallel":
                o, d = e + x * u + y * v, -w
            best = np.inf
            for one in scene.objects:
                if one.type == "sphere":
                    p = o - np.array(one.center)
                    h, a = p @ d, d @ d
                    D = h * h - a * (p @ p - one.radius**2)
                    if D < 0:
                        continue
                    t = (-h - D**0.5) / a
                else:
                    corner = np.array(one.a)
                    edges = corner - one.b, corner - one.c, d
                    beta, gamma, t = np.linalg.solve(np.stack(edges, axis=1), corner - o)
                    if min(beta, gamma, 1 - beta - gamma) < 0:
                        continue
                if 0 < t < best:
                    best = KEPT
                    image[i, j] = one.color
    return IMAGE
"""


@pytest.mark.parametrize(
    ("half", "kept", "image", "names"),
    [
        ("0", "np.inf", "image", {"the corner, not the centre", "the last object wins"}),
        ("0.5", "t", "image[::-1, :, ::-1]", {"upside down", "blue and red exchanged"}),
        ("0.5", "np.inf", "255 * image[:, ::-1]", None),
    ],
)
def test_two_mistakes_in_both_loops(tmp_path, half, kept, image, names):
    path = tmp_path / "loops.py"
    source = BOTH_LOOPS.replace("HALF", half).replace("KEPT", kept).replace("IMAGE", image)
    path.write_text(source, "utf-8")
    with FileStudent(path) as student:
        told = checked(student, TASKS["render"]).diagnosis
    assert told is not None
    found = [{one.name for one in both} for both in told.candidates]
    assert names in found if names else not found  # three at once are not looked for


def test_offsets_that_are_all_infinite_are_no_misses():
    told = diagnosis_of(TASKS["memory-offset"], lambda cases: [float("inf")] * len(cases))
    assert told.sentences == ("All your answers are inf, whatever is asked.",)


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


def test_words_of_a_course_are_those_of_the_table_where_it_has_them():
    conventions = TASKS["viewing-ray"].conventions
    own = ray_task(replace(conventions, base=1, rows="bottom"))
    assert (own.indexing, own.from_top, own.words) == (Indexing.LECTURE, False, WORDS)
    camera = (("pos", "eye"), ("look", "target"), ("up", "up"), ("fov", "fov_y"), ("a", "aspect"))
    arguments = (("xy", "xy01"), ("camera", "camera"))
    course = ray_task(replace(conventions, arguments=arguments, camera=camera))
    assert {"x01", "y01", "eye", "target", "up", "fov_y", "aspect"} <= course.words
    assert "i" not in course.words and "u" not in course.words
    deltas = (("p", "pixel00"), ("du", "delta_u"), ("dv", "delta_v"))
    arguments = (("column", "column"), ("row", "row"), ("camera", "camera"))
    other = ray_task(replace(conventions, arguments=arguments, camera=deltas))
    assert other.words == WORDS
