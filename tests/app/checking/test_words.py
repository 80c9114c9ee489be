"""Each word of a convention, by what a course's student makes of it: then the ray is right."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.checking.cases import camera_kinds, shots
from lucida.app.checking.checked import judged
from lucida.app.checking.conventions import (
    CAMERA_WORDS,
    PAIRS,
    PIXEL_WORDS,
    Conventions,
)
from lucida.app.checking.courses import course_names, task_path
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.task_file import BUILTIN, load_tasks
from lucida.app.checking.tasks import Run

KIND = KINDS["viewing-ray"]
BASE = next(task for task in BUILTIN if task.name == "viewing-ray")


def a(values):
    return np.array(values, float)


def unit(vector):
    return vector / np.linalg.norm(vector)


def course(arguments, camera=None, returns=("origin", "direction"), **more):
    """A task in a course's words."""
    fields = {"camera": tuple(camera.items())} if camera else {}
    conventions = Conventions(
        arguments=tuple((word, word) for word in arguments), returns=returns, **fields, **more
    )
    return replace(BASE, conventions=conventions, count=12, cameras=camera_kinds(conventions))


def tried(task, function):
    """The result of a function in this process, which is given its values by name."""
    cases = KIND.cases(task)
    values = []
    for call in KIND.calls(task, cases):
        made = function(**dict(call.arguments))
        values.append([np.asarray(part, float).tolist() for part in made])
    return judged(task, cases, Run(tuple(values)))


def from_the_top(xy01, camera):
    s, t = xy01
    point = a(camera["top_left"]) + s * a(camera["horizontal"]) - t * a(camera["vertical"])
    return camera["origin"], point - a(camera["origin"])


def target_and_up(i, j, size, eye, target, up, fov_x_rad):
    w = unit(a(eye) - a(target))
    u = unit(np.cross(up, w))
    v = np.cross(w, u)
    half = math.tan(fov_x_rad / 2)
    width, height = size
    y = (1 - 2 * (i + 0.5) / height) * half * height / width
    return (eye, (2 * (j + 0.5) / width - 1) * half * u + y * v - w)


def upside_down(x_pixel, y_pixel, size, viewport, distance, rotation, eye):
    """y downwards and z forwards, as in computer vision."""
    left, right, bottom, top = viewport
    x = left + x_pixel / size[0] * (right - left)
    y = -top + y_pixel / size[1] * (top - bottom)
    return eye, a(rotation) @ [x, y, distance]


def sized(xy11, camera):
    u, v, w = (a(camera[name]) for name in "uvw")
    x, y = xy11[0] / 2 * camera["wide"], xy11[1] / 2 * camera["high"]
    return (a(camera["eye"]) + x * u + y * v, -w)


BOTTOM = {"rows": "bottom"}
COURSES = {
    "from the top": (
        course(
            ["xy01", "camera"],
            {
                "origin": "eye",
                "top_left": "top_left",
                "horizontal": "horizontal",
                "vertical": "vertical",
            },
        ),
        from_the_top,
    ),
    "target and up": (
        course(["i", "j", "size", "eye", "target", "up", "fov_x_rad"]),
        target_and_up,
    ),
    "y downwards": (
        course(
            ["x_pixel", "y_pixel", "size", "viewport", "distance", "rotation", "eye"],
            axes=(1, -1, -1),
        ),
        upside_down,
    ),
    "parallel by its size": (
        replace(
            course(
                ["xy11", "camera"],
                {
                    **{name: name for name in ("eye", "u", "v", "w")},
                    "wide": "viewport_width",
                    "high": "viewport_height",
                },
                **BOTTOM,
            ),
            projection="parallel",
            cameras=("canonical", "moved", "turned"),
        ),
        sized,
    ),
}


@pytest.mark.parametrize("name", COURSES)
def test_a_course_s_words_lead_to_the_right_ray(name):
    task, function = COURSES[name]
    result = tried(task, function)
    assert result.status == "right", result.first


def test_cameras_are_mirrored_where_the_course_is():
    (task, *_) = load_tasks(task_path("ray-tracer-challenge")).tasks
    assert all(shot.camera.determinant < 0 for shot in shots(task))


def test_every_word_has_been_used_here():
    """Or by a course, whose own functions are in courses/written."""
    tasks = [task for task, _ in COURSES.values()]
    tasks += [task for name in course_names() for task in load_tasks(task_path(name)).tasks]
    used = {word for task in tasks for word in task.conventions.words}
    used |= {part for word in used & PAIRS.keys() for part in PAIRS[word]}
    known = {*PIXEL_WORDS, *CAMERA_WORDS, *PAIRS}
    rest = known - used
    assert rest == {"ij", "ji", "fov_long", "fov_short_rad"}
