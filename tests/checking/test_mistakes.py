"""The wrong lines: the right program is the camera's, each mistake by hand, what is shown runs."""

from __future__ import annotations

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from asked_rays import made_cases

import app.lectures
from app.checking.mistakes.program import CodeLine, Mistake, Program
from app.checking.mistakes.ray_trial import known_values
from app.checking.mistakes.rays import (
    WORDS,
    RayTask,
    camera_rays,
    ray_program,
    ray_values,
    run_rays,
)
from app.checking.mistakes.value_programs import value_program
from renderer.camera import Camera
from renderer.pixels import Indexing

PROJECTIONS = ("perspective", "parallel")
BASIS = value_program("basis")
CAMERA_PARTS = {"eye", "distance", "left", "right", "bottom", "top"}
FRAME = {"u", "v", "w"}
PIXEL = {"i", "j", "width", "height"}
TASKS = {
    "all": WORDS,
    "from a target": PIXEL | CAMERA_PARTS | {"target", "up"},
    "camera to world": PIXEL | CAMERA_PARTS - {"eye"} | {"camera_to_world"},
    "world to camera": PIXEL | CAMERA_PARTS - {"eye"} | {"world_to_camera"},
    "field of view": PIXEL | {"eye", "target", "up", "fov_y", "aspect"},
    "field of view at a distance": PIXEL | FRAME | {"eye", "distance", "fov_y"},
    "field of view in radians": PIXEL | FRAME | {"eye", "fov_y_rad", "aspect"},
    "horizontal field of view": PIXEL | FRAME | {"eye", "fov_x", "aspect"},
    "in pixels": {"x_pixel", "y_pixel", "width", "height"} | CAMERA_PARTS | FRAME,
    "in other words": {"xy01", "forward", "pixel00", "horizontal"},
    "from 0 to 1": {"x01", "y01", "width", "height"} | CAMERA_PARTS | FRAME,
    "from -1 to 1": {"x11", "y11"} | CAMERA_PARTS | FRAME,
}


def asked(words: str):
    """Return a task's cases with all that its words pass; square pixels if an angle is given."""
    symmetric = any("fov" in word for word in TASKS[words])
    rigid = symmetric or "target" in TASKS[words]
    made = []
    for case in made_cases(4, 8, kinds=("orthonormal",) if rigid else ("off-axis", "skewed")):
        camera = case.camera
        if symmetric:
            high = camera.viewport[3]
            wide = high * case.size[0] / case.size[1]
            camera = replace(camera, viewport=(-wide, wide, -high, high))
        target = tuple(np.asarray(camera.eye) - 2.5 * np.asarray(camera.w))
        up = tuple(1.5 * np.asarray(camera.v) + 0.4 * np.asarray(camera.w))
        made.append(replace(case, camera=camera, target=target, up=up))
    return made


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("indexing", Indexing)
def test_the_right_program_is_the_camera_s(projection, indexing):
    for case in made_cases(1, 8, projection):
        right = case.camera.rays(case.size)
        origin, direction = camera_rays(case.camera, case.size, (), indexing)
        assert origin.shape == direction.shape == (case.size[1], case.size[0], 3)
        scale = np.abs(right.origin).max() + np.abs(right.direction).max()
        assert np.abs(origin - right.origin).max() <= 1e-15 * scale
        assert (direction == right.direction).all()


@pytest.mark.parametrize("words", TASKS)
@pytest.mark.parametrize("projection", PROJECTIONS)
def test_the_right_program_in_a_task_s_words(words, projection):
    if projection == "parallel" and any("fov" in word for word in TASKS[words]):
        return
    cases = [
        replace(case, camera=replace(case.camera, projection=projection)) for case in asked(words)
    ]
    right = [case.camera.ray(*case.pixel, case.size) for case in cases]
    wanted = np.array([ray.direction / np.linalg.norm(ray.direction) for ray in right])
    for indexing in Indexing:
        for from_top in (True, False):
            task = RayTask(projection, indexing, from_top, frozenset(TASKS[words]))
            known = known_values(cases, task)
            needed = {"eye", *(WORDS if words == "in other words" else TASKS[words])}
            given = {name: known[name] for name in needed & known.keys()}
            origin, direction = run_rays(ray_program(task), given)
            along = direction / np.linalg.norm(direction, axis=1)[:, None]
            assert np.abs(origin - [ray.origin for ray in right]).max() < 1e-12
            assert np.abs(along - wanted).max() < 1e-12


def test_the_right_program_reads_like_the_camera_contract():
    assert [line.code for line in ray_program(RayTask()).lines] == [
        "x = left + (j + 0.5) / width * (right - left)",
        "y = top - (i + 0.5) / height * (top - bottom)",
        "origin = eye",
        "direction = x*u + y*v - distance*w",
    ]
    lines = [line.code for line in ray_program(RayTask("parallel", Indexing.LECTURE)).lines]
    assert lines[0] == "x = left + (j - 0.5) / width * (right - left)"
    assert lines[2:] == ["origin = eye + x*u + y*v", "direction = -w"]


def test_the_right_basis():
    cases = asked("from a target")
    known = {name: np.array([getattr(c, name) for c in cases]) for name in ("target", "up")}
    known["eye"] = np.array([case.camera.eye for case in cases])
    for made, name in zip(BASIS.run(known)[0], "uvw", strict=True):
        assert np.abs(made - [getattr(case.camera, name) for case in cases]).max() < 1e-14


def test_the_table():
    """Names are unique, lines exist and are wrong, parts are the lecture's; shown lines are run."""
    file = Path(app.lectures.__file__).parent / "images-rays-cameras.toml"
    titles = {step["title"] for step in tomllib.loads(file.read_text("utf-8"))["steps"]}
    tasks = [
        RayTask(projection, indexing, from_top, frozenset(words))
        for projection in PROJECTIONS
        for indexing in Indexing
        for from_top in (True, False)
        for words in TASKS.values()
    ]
    for program in (*map(ray_program, tasks), BASIS):
        names = [mistake.name for mistake in program.mistakes]
        assert len(set(names)) == len(names) >= 14
        keys = {line.key: line.code for line in program.lines}
        assert len(keys) == len(program.lines)
        for mistake in program.mistakes:
            assert mistake.hint.endswith(".") and mistake.part in titles, mistake.name
            assert mistake.keys <= keys.keys(), mistake.name
            assert all(keys[key] != code for key, code in mistake.lines), mistake.name
            shown = program.text((mistake,))
            assert {line.key for line in shown if line.instead is not None} == mistake.keys
            written = [line.code if line.instead is None else line.instead for line in shown]
            assert program.source((mistake,)) == "\n".join(written)
        assert all(line.instead is None for line in program.text())


def one(program: Program, name: str) -> Mistake:
    return next(mistake for mistake in program.mistakes if mistake.name == name)


# Pixel (1, 5), from 0, of 8 x 4, at x = 3/8, y = 1/8 of the viewport.
CAMERA = Camera((1, 2, 3), distance=3.0, viewport=(-1, 1, -0.5, 0.5))
AT_X, AT_Y = 3 / 8, 1 / 8
ACROSS, UP = 0.375 * math.atan(1 / 3), 0.25 * math.atan(1 / 6)
POINTS = {  # on the image plane, of any projection
    "one step too few": (-1 + 10 / 7, 0.5 - 1 / 3),
    "the centre, but one step too few": (-1 + 11 / 7, 0.5 - 1.5 / 3),
    "the image transposed": (-1 + 2 * 1.5 / 4, 0.5 - 5.5 / 8),
    "both divided by the width": (AT_X, 0.5 - 1.5 / 8),
    "both divided by the height": (-1 + 2 * 5.5 / 4, AT_Y),
    "one pixel off: in the columns": (AT_X - 2 / 8, AT_Y),
    "the corner, not the centre: in the rows": (AT_X, 0.5 - 1 / 4),
    "a whole pixel": (0.5, 0.0),
    "one pixel off": (1 / 8, 3 / 8),
    "the simple camera's viewport": (5.5 / 8 - 0.5, 0.5 - 1.5 / 4),
    "the viewport from -1 to 1": (2 * 5.5 / 8 - 1, 1 - 2 * 1.5 / 4),
}
EYE, AT, ALONG = (1, 2, 3), (1 + AT_X, 2 + AT_Y, 3), (AT_X, AT_Y, -3)
PERSPECTIVE = {
    "equal angles, not equal distances": (EYE, (3 * math.tan(ACROSS), 3 * math.tan(UP), -3)),
    "v the wrong way round": (EYE, (AT_X, -AT_Y, -3)),
    "u the wrong way round": (EYE, (-AT_X, AT_Y, -3)),
    "points backwards": (EYE, (-AT_X, -AT_Y, 3)),
    "the eye subtracted": (EYE, (AT_X - 1, AT_Y - 2, -6)),
    "all rays along -w": (EYE, (0, 0, -1)),
    "no w": (EYE, (AT_X, AT_Y, 0)),
    "the direction is the eye's": (EYE, EYE),
    "divided by the distance": (EYE, (AT_X, AT_Y, -1 / 3)),
    "the origin on the viewport": ((1 + AT_X, 2 + AT_Y, 0), ALONG),
    "the origin moves with the pixel": (AT, ALONG),
    "no eye": ((0, 0, 0), ALONG),
}
PARALLEL = {
    "all rays start at the eye": (EYE, (0, 0, -1)),
    "the direction as in perspective": (AT, ALONG),
    "the origin on the plane at d": ((1 + AT_X, 2 + AT_Y, 0), (0, 0, -1)),
    "the eye subtracted": ((AT_X - 1, AT_Y - 2, -3), (0, 0, -1)),
    "u the wrong way round": ((1 - AT_X, 2 + AT_Y, 3), (0, 0, -1)),
    "v the wrong way round": ((1 + AT_X, 2 - AT_Y, 3), (0, 0, -1)),
    "along the world's -z": (AT, (0, 0, -1)),
    "the direction is the eye's": (AT, EYE),
    "from the eye to the viewport": (AT, (AT_X, AT_Y, 0)),
}


def ray(name, camera=CAMERA):
    task = RayTask(camera.projection)
    program = ray_program(task)
    return run_rays(program, ray_values(camera, 1, 5, (8, 4), task), (one(program, name),))


def test_rays_by_hand():
    parallel = replace(CAMERA, projection="parallel")
    for name, (x, y) in POINTS.items():
        assert ray(name) == pytest.approx(np.array([EYE, (x, y, -3)])), name
        wanted = np.array([(1 + x, 2 + y, 3), (0, 0, -1)])
        assert ray(name, parallel) == pytest.approx(wanted), name
    for camera, table in ((CAMERA, PERSPECTIVE), (parallel, PARALLEL)):
        for name, wanted in table.items():
            assert ray(name, camera) == pytest.approx(np.array(wanted)), name


def test_longitude_and_latitude():
    """The direction of a globe's point: both angles in equal steps."""
    globe = [math.sin(ACROSS) * math.cos(UP), math.sin(UP), -math.cos(ACROSS) * math.cos(UP)]
    direction = ray("longitude and latitude")[1]
    assert direction / np.linalg.norm(direction) == pytest.approx(np.array(globe))


def test_bases():
    """With u = (1, 1, 0): rows for columns, and the inverse."""
    camera = replace(CAMERA, u=(1, 1, 0))
    assert ray("basis transposed", camera)[1] == pytest.approx((AT_X + AT_Y, AT_Y, -3))
    inverted = ray("from the world to the camera", camera)[1]
    assert inverted == pytest.approx((AT_X, AT_Y - AT_X, -3))
    assert np.linalg.norm(ray("normalised", camera)[1]) == pytest.approx(1)


@pytest.mark.parametrize(
    ("names", "x", "y"),
    [
        (("rows count upwards", "the corner, not the centre"), 2 / 8, -2 / 8),
        (("columns count leftwards", "one pixel off"), -1 / 8, 3 / 8),
        (("rows count upwards", "width and height exchanged"), 14 / 8, -5 / 16),
        (("rows count upwards", "the simple camera's viewport"), 5.5 / 8 - 0.5, 1.5 / 4 - 0.5),
        (("columns count leftwards", "the viewport from -1 to 1"), 1 - 2 * 5.5 / 8, 0.25),
        (("a whole pixel", "row and column exchanged"), -4 / 8, -1),
    ],
)
def test_two_in_one_line_by_hand(names, x, y):
    program = ray_program(RayTask())
    both = tuple(one(program, name) for name in names)
    known = ray_values(CAMERA, 1, 5, (8, 4))
    for pair in (both, both[::-1]):
        assert program.can_combine(*pair)
        assert run_rays(program, known, pair)[1] == pytest.approx((x, y, -3))


@pytest.mark.parametrize(
    ("names", "direction"),
    [
        (("no distance", "along +w"), "x*u + y*v + w"),
        (("no distance", "a point, not a direction"), "eye + x*u + y*v - w"),
        (("no distance", "the camera's coordinates"), "vector(x, y, -1)"),
        (("along +w", "a point, not a direction"), "eye + x*u + y*v + distance*w"),
        (("v the wrong way round", "along +w"), "x*u - y*v + distance*w"),
        (("u the wrong way round", "no distance"), "-x*u + y*v - w"),
    ],
)
def test_two_in_the_direction(names, direction):
    program = ray_program(RayTask())
    both = tuple(one(program, name) for name in names)
    for pair in (both, both[::-1]):
        assert program.can_combine(*pair)
        assert program.source(pair).splitlines()[-1] == f"direction = {direction}"


def test_mistakes_that_hide_each_other_are_no_pair():
    program = ray_program(RayTask())
    first, second = one(program, "no w"), one(program, "along +w")
    assert not program.can_combine(first, second)
    assert program.text((first, second)) == program.text((first,))
    pairs = set(program.pairs())
    assert (first, second) not in pairs
    for pair in pairs:
        assert program.source(pair) not in {program.source((alone,)) for alone in pair}


# From (10, 0, 3) to (4, 0, 3), up (0, 2, 0): w = (1, 0, 0), u = (0, 0, -1), v = (0, 1, 0).
BASIS_BY_HAND = {
    "w points forwards": ((0, 0, 1), (0, 1, 0), (-1, 0, 0)),
    "the target as a direction": ((-0.6, 0, 0.8), (0, 1, 0), (-0.8, 0, -0.6)),
    "the target as w": ((0.6, 0, -0.8), (0, 1, 0), (0.8, 0, 0.6)),
    "the eye as w": ((0.2873479, 0, -0.9578263), (0, 1, 0), (0.9578263, 0, 0.2873479)),
    "w is not normalised": ((0, 0, -1), (0, 6, 0), (6, 0, 0)),
    "w x up for up x w": ((0, 0, 1), (0, -1, 0), (1, 0, 0)),
    "u is not normalised": ((0, 0, -2), (0, 2, 0), (1, 0, 0)),
    "u x w for w x u": ((0, 0, -1), (0, -1, 0), (1, 0, 0)),
    "up used as v": ((0, 0, -1), (0, 2, 0), (1, 0, 0)),
    "up, normalised, used as v": ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
    "v from up, not from u": ((0, 0, -1), (0, 0, 2), (1, 0, 0)),
    "basis transposed": ((0, 0, 1), (0, 1, 0), (-1, 0, 0)),
    "w in its full length": ((0, 0, -1), (0, 1, 0), (6, 0, 0)),
    "the view direction for w": ((0, 0, -1), (0, 1, 0), (-1, 0, 0)),
    "w, u, v for u, v, w": ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "v, u, w for u, v, w": ((0, 1, 0), (0, 0, -1), (1, 0, 0)),
}


def test_basis_by_hand():
    known = {"eye": np.array([10.0, 0, 3]), "target": np.array([4.0, 0, 3])}
    known["up"] = np.array([0, 2.0, 0])
    for name, wanted in BASIS_BY_HAND.items():
        made = np.array(BASIS.run(known, (one(BASIS, name),))[0])
        assert made == pytest.approx(np.array(wanted), abs=1e-6), name


# 60 degrees high, 3 : 2: the viewport's upper and right edge.
THIRTY = math.radians(30)
TAN = math.tan(THIRTY)
VIEWPORT_BY_HAND = {
    "degrees for radians": (math.tan(30), 1.5 * math.tan(30)),
    "the whole angle, not half of it": (math.tan(2 * THIRTY), 1.5 * math.tan(2 * THIRTY)),
    "a quarter of the angle": (math.tan(THIRTY / 2), 1.5 * math.tan(THIRTY / 2)),
    "the whole viewport for its half": (2 * TAN, 3 * TAN),
    "half of the viewport's half": (0.5 * TAN, 0.75 * TAN),
    "the angle without its tangent": (THIRTY, 1.5 * THIRTY),
    "the sine for the tangent": (0.5, 0.75),
    "the tangent upside down": (1 / TAN, 1.5 / TAN),
    "the angle of the other side": (TAN / 1.5, TAN),
    "the angle scaled, not its tangent": (TAN, math.tan(1.5 * THIRTY)),
    "the aspect ratio upside down": (TAN, TAN / 1.5),
    "no aspect ratio": (TAN, TAN),
}


def test_viewport_by_hand():
    """By the direction of the lower right corner."""
    words = frozenset({"x01", "y01", "eye", "u", "v", "w", "fov_y", "aspect"})
    program = ray_program(RayTask(words=words))
    known = {"eye": np.zeros(3), "fov_y": 60.0, "aspect": 1.5, "x01": np.ones(1), "y01": np.ones(1)}
    known |= dict(zip("uvw", np.eye(3), strict=True))
    for name, (high, wide) in VIEWPORT_BY_HAND.items():
        direction = run_rays(program, known, (one(program, name),))[1]
        assert direction == pytest.approx((wide, -high, -1)), name


def test_a_program_of_any_lines():
    program = Program(
        (CodeLine("a", "a = x + 1"), CodeLine("b", "b = norm(vector(a, 0, 0))")),
        (Mistake("less", (("a", "a = x - 1"),), "More.", "A ray is half a line"),),
        ("b",),
    )
    assert program.run({"x": np.array([1.0])}) == (2.0,)
    assert program.run({"x": np.array([1.0])}, program.mistakes) == (0.0,)
