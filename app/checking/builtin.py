"""The built-in tasks, one for each part of the lecture. Their texts settle what the lecture leaves
open.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

from lucida.app.checking.conventions import Conventions
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.tasks import CheckTask
from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining.symbols import spoken
from lucida.renderer.images.shared_numbers import LUMINANCE

_HIT = (
    "Give the ray parameter t of the nearest hit with t > 0: the point is "
    "`origin + t * direction`. Give None where there is none. The direction is of any length: "
    "do not assume 1."
)


def default_conventions(kind: str) -> Conventions:
    """Return the conventions of the camera contract: counted from 0, with row 0 at the top."""
    return Conventions(
        arguments=tuple((word, word) for word in KINDS[kind].arguments),
        returns=KINDS[kind].returns,
    )


def _task(kind: str, part: str, text: str, points: float, **more: Any) -> CheckTask:
    name = more.pop("name", kind)
    conventions = default_conventions(kind)
    return CheckTask(name, kind, KINDS[kind].function, part, text, points, conventions, **more)


_LUMINANCE = " + ".join(
    f"{weight} {name}" for weight, name in zip(LUMINANCE, ("red", "green", "blue"), strict=True)
)

_TASKS = (
    _task(
        "to-gray",
        "2D arrays of numbers",
        f"The gray of each pixel: {_LUMINANCE}, the luminance of linear "
        "light. rgb is an array of `height` x `width` x 3 numbers from 0 to 1, linear light; give "
        "`height` x `width`.",
        1.0,
        count=4,
    ),
    _task(
        "to-bitmap",
        "2D arrays of numbers",
        "One bit per pixel: 1 where gray is at least the threshold, else 0. gray is an array of "
        "`height` x `width` numbers, from 0 to 255 or from 0 to 1 as the threshold is; give as "
        "many of 0 and 1.",
        1.0,
        count=5,
    ),
    _task(
        "memory-offset",
        "2D arrays in Julia",
        "How many pixels lie in memory before pixel (i, j), in an image of rows one after another "
        "(row-major)? i, j count from 0.",
        1.0,
        count=20,
    ),
    _task(
        "viewing-ray",
        "Any camera",
        "The viewing ray of pixel (i, j) in perspective: its origin, the eye, and its direction, "
        "of any length. i, j count from 0, row 0 is at the top, the ray goes through the pixel's "
        "centre. The basis u, v, w may be any: use it as it is.",
        3.0,
    ),
    _task(
        "viewing-ray",
        "Parallel: the pixel moves the origin",
        "The same where camera.projection is 'parallel': the pixel moves the origin, in the plane "
        "of the eye; all directions are -w.",
        2.0,
        name="viewing-ray-parallel",
        projections=("parallel",),
    ),
    _task(
        "basis",
        "The basis from a target",
        "The camera's basis u (right), v (up), w (back), each of length 1 and at right angles to "
        "the others. up is neither of length 1 nor at right angles to the view.",
        2.0,
        count=20,
    ),
    _task(
        "hit-sphere",
        "A ray is half a line",
        f"Where does a ray meet a sphere? {_HIT} From inside, that is the far side.",
        2.0,
        count=25,
    ),
    _task(
        "hit-triangle",
        "A ray is half a line",
        f"Where does a ray meet the triangle a, b, c? {_HIT} Both of its sides count; a ray "
        "parallel to its plane does not meet it.",
        2.0,
        count=24,
    ),
    _task(
        "closest-hit",
        "Ray tracing",
        "Which object does a ray meet first? objects is a list; each has a type: 'sphere', with "
        "center and radius, or 'triangle', with a, b and c. Give its number, from 0, and t > 0; "
        "None where nothing is hit. The list may be empty.",
        2.0,
        count=24,
    ),
    _task(
        "render",
        "The program",
        "The image: for each pixel the color of the nearest object as it is, without light; "
        "scene.background where there is none. scene.objects are as in closest_hit, each with a "
        "color, three numbers from 0 to 1. Give an array of `height` x `width` x 3, row 0 at the "
        "top. Pixels whose ray just touches an edge are not judged.",
        3.0,
        count=6,
        projections=("perspective", "parallel"),
        cameras=("canonical", "turned", "off-axis"),
    ),
    _task(
        "project",
        "Straight lines bend",
        "Where does a lens show a point? Divide by Z, distort the ideal point (a, b) as OpenCV "
        "does, with k1, k2, k3 along the radius and p1, p2 across it, then apply fx, fy, cx and "
        "cy. The point is in the camera's coordinates: X to the right, Y down, Z forwards.",
        2.0,
        count=12,
    ),
    _task(
        "project-fisheye",
        "Straight lines bend",
        "The same for a fisheye as OpenCV has it: the radius in the image is the angle theta to "
        "the axis, in radians, times 1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8. "
        "Points with Z < 0 are seen as well.",
        2.0,
        count=12,
    ),
    _task(
        "undistort",
        "Straight lines bend",
        "The way back: which ideal point (a, b) = (X / Z, Y / Z) does a pixel of a lens's image "
        "show? The coefficients are those of project. There is no formula: iterate, to a "
        "thousandth of a pixel.",
        3.0,
        count=12,
    ),
)


@lru_cache
def builtin_tasks(notation: Notation) -> tuple[CheckTask, ...]:
    """Return the tasks in a notation."""
    return tuple(
        replace(task, text=spoken(task.text, notation), notation=notation) for task in _TASKS
    )


BUILTIN = builtin_tasks("book")
