"""The wrong lines: the right program is the camera's, each mistake by hand, what is shown runs."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from asked_rays import made_cases

import lucida.app.lecture.lectures
from lucida.app.checking.mistakes.program import Mistake, Program
from lucida.app.checking.mistakes.programs import program_of
from lucida.app.checking.mistakes.rays import (
    WORDS,
    RayTask,
    camera_rays,
    ray_program,
    ray_values,
    run_rays,
)
from lucida.app.checking.task_file import BUILTIN
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import Indexing

PROJECTIONS = ("perspective", "parallel")
BASIS = program_of(next(task for task in BUILTIN if task.name == "basis"))
CAMERA_PARTS = {"eye", "distance", "left", "right", "bottom", "top"}
FRAME = {"u", "v", "w"}
PIXEL = {"i", "j", "width", "height"}
TASKS = {
    "all": WORDS,
    "from a target": PIXEL | CAMERA_PARTS | {"target", "up"},
    "from a direction": PIXEL | CAMERA_PARTS | {"forward", "up"},
    "camera to world": PIXEL | CAMERA_PARTS - {"eye"} | {"camera_to_world"},
    "world to camera": PIXEL | CAMERA_PARTS - {"eye"} | {"world_to_camera"},
    "field of view": PIXEL | {"eye", "target", "up", "fov_y", "aspect"},
    "field of view in radians": PIXEL | FRAME | {"eye", "fov_y_rad", "aspect"},
    "horizontal field of view": PIXEL | FRAME | {"eye", "fov_x", "aspect"},
    "in pixels": {"x_pixel", "y_pixel", "width", "height"} | CAMERA_PARTS | FRAME,
    "in other words": {"xy01", "forward", "pixel00", "horizontal"},
    "from 0 to 1": {"x01", "y01", "width", "height"} | CAMERA_PARTS | FRAME,
}


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


def test_mistakes_have_one_name_each_and_change_a_line_of_their_program():
    """Names are unique, lines exist and are wrong, parts are the lecture's; shown lines are run."""
    file = Path(lucida.app.lecture.lectures.__file__).parent / "images-rays-cameras.toml"
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
EYE, AT, ALONG = (1, 2, 3), (1 + AT_X, 2 + AT_Y, 3), (AT_X, AT_Y, -3)
PERSPECTIVE = {
    "u the wrong way round": (EYE, (-AT_X, AT_Y, -3)),
    "the eye subtracted": (EYE, (AT_X - 1, AT_Y - 2, -6)),
    "the origin moves with the pixel": (AT, ALONG),
    "no eye": ((0, 0, 0), ALONG),
}


def ray(name):
    program = ray_program(RayTask())
    return run_rays(program, ray_values(CAMERA, 1, 5, (8, 4), RayTask()), (one(program, name),))


@pytest.mark.parametrize("name", [name for name in TASKS if name not in ("all", "in other words")])
def test_the_right_program_uses_the_words_of_its_task(name):
    words = TASKS[name]
    task = RayTask(words=frozenset(words))
    known = ray_values(CAMERA, 1, 5, (8, 4), task) | {"target": (1, 2, 0), "up": (0, 2, 0)}
    origin, direction = run_rays(ray_program(task), {word: known[word] for word in words})
    assert origin == pytest.approx(np.array(EYE))
    assert direction / direction[2] == pytest.approx(np.array(ALONG) / -3)


@pytest.mark.parametrize("name", PERSPECTIVE)
def test_a_mistake_s_rays_are_those_computed_by_hand(name):
    assert ray(name) == pytest.approx(np.array(PERSPECTIVE[name])), name


def test_a_camera_space_with_x_to_the_left():
    """There, x to the right is a mistake, and comes before mistakes in the pixel."""
    words = frozenset(TASKS["camera to world"])
    found = [ray_program(RayTask(words=words, axes=(x, 1, 1))).mistakes for x in (1, -1)]
    name = "the camera's x to the right"
    assert found[1][0].name == name and name not in {mistake.name for mistake in found[0]}


def test_mistakes_that_hide_each_other_are_no_pair():
    program = ray_program(RayTask())
    first, second = one(program, "no w"), one(program, "along +w")
    assert not program.can_combine(first, second)
    assert program.text((first, second)) == program.text((first,))
    pairs = set(program.pairs())
    assert (first, second) not in pairs
    for pair in pairs:
        assert program.source(pair) not in {program.source((alone,)) for alone in pair}


def test_pairs_of_an_image_s_mistakes_have_one_in_its_loops():
    task = next(task for task in BUILTIN if task.kind == "render")
    program, rays = program_of(task), {line.key for line in program_of(BUILTIN[0]).lines}
    assert program.paired and not program.paired & rays
    pairs = list(program.pairs())
    assert len(pairs) > 20
    assert all(program.paired & (first.keys | second.keys) for first, second in pairs)
