"""Bases, hits, images and offsets: right by hand, each mistake by name, two at once."""

from __future__ import annotations

import math

import numpy as np
import pytest
from asked_rays import made_camera

from lucida.app.checking.mistakes.hits import SHAPES
from lucida.app.checking.mistakes.rays import RayTask, ray_program
from lucida.app.checking.mistakes.render import render_program, render_values
from lucida.app.checking.mistakes.value_diagnosis import ValueCase, diagnose_values
from lucida.app.checking.mistakes.value_programs import value_program

SPHERE, TRIANGLE = value_program("hit-sphere"), value_program("hit-triangle")


def direction(random):
    made = random.normal(size=3)
    return made / np.linalg.norm(made) * random.uniform(0.4, 3)


def around(random):
    """Return a ray that leads near a point: away from it, to it, or from inside; and the point."""
    along, centre = direction(random), random.uniform(-2, 2, 3)
    origin = centre + random.uniform(-4, 2) * along + random.normal(size=3) * 0.5
    return {"origin": origin, "direction": along}, centre


def basis_case(random, number):
    eye, target = random.normal(size=(2, 3))
    return {"eye": 4 * eye, "target": target, "up": direction(random)}


def sphere_case(random, number):
    ray, centre = around(random)
    return {**ray, "center": centre, "radius": random.uniform(0.5, 2)}


def triangle_case(random, number):
    ray, centre = around(random)
    return {**ray, **{name: centre + random.normal(size=3) for name in "abc"}}


def objects_near(random, ray, count):
    made = []
    for number in range(count):
        at = ray["origin"] + random.uniform(-4, 6) * ray["direction"] + random.normal(size=3) * 0.2
        color = random.uniform(0.2, 1, 3).tolist()
        if number % 2:
            corners = {name: (at + random.normal(size=3) * 2).tolist() for name in "abc"}
            made.append({"type": "triangle", **corners, "color": color})
        else:
            made.append({"type": "sphere", "center": at.tolist(), "radius": 0.9, "color": color})
    return made


def closest_case(random, number):
    ray, _ = around(random)
    return {**ray, "objects": objects_near(random, ray, number % 7), **SHAPES}


def gray_case(random, number):
    image = random.uniform(0, 1, (3, 4, 5)) if number else np.ones((3, 2, 3))
    return dict(zip(("red", "green", "blue"), image, strict=True))


def bitmap_case(random, number):
    image = np.round(random.uniform(0, 1, (5, 4)), 2) * (255 if number % 2 else 1)
    return {"gray": image, "threshold": float(random.choice(image.ravel()))}


def offset_case(random, number):
    numbers = random.integers(2, 50, 4).tolist()
    return dict(zip(("i", "j", "width", "height"), numbers, strict=True))


def lens_case(random, number):
    names = ("k1", "k2", "k3", "k4", "p1", "p2", "X", "Y", "Z", "column", "row")
    least = np.array([0.4, 0.02, 0.01, 0.01, 0.01, 0.01, 0.3, 0.3, 1, 5, 5])
    values = dict(zip(names, (least * random.uniform(1, 2, 11)).tolist(), strict=True))
    values["Z"] *= -1 if number % 3 == 2 else 1
    return values | {"fx": 300.0, "fy": 330.0, "cx": 160.0, "cy": 120.0}


PROGRAMS = {  # with the number of cases
    "basis": (value_program("basis"), basis_case, 10),
    "sphere": (SPHERE, sphere_case, 40),
    "triangle": (TRIANGLE, triangle_case, 80),
    "closest": (value_program("closest-hit"), closest_case, 30),
    "gray": (value_program("to-gray"), gray_case, 6),
    "bitmap": (value_program("to-bitmap"), bitmap_case, 12),
    "offset": (value_program("memory-offset", stride=12), offset_case, 20),
    "project": (value_program("project"), lens_case, 10),
    "fisheye": (value_program("project-fisheye"), lens_case, 10),
    "undistort": (value_program("undistort"), lens_case, 10),
}  # fmt: skip


def program_and_cases(name, seed):
    program, make, count = PROGRAMS[name]
    random = np.random.default_rng(seed)
    return program, [make(random, number) for number in range(count)]


def answers(program, cases, mistakes=()):
    made = []
    for known in cases:
        (answer,) = program.run(known, mistakes)
        if isinstance(answer, tuple):
            answer = np.array([np.ravel(part) for part in answer], float)
            answer = answer[:, 0] if answer.shape[1] == 1 else answer
        made.append(np.squeeze(np.asarray(answer, float)))
    return made


def diagnosed(program, cases, given, tolerance=0.0):
    right = answers(program, cases)
    asked = [
        ValueCase(known, wanted, found, tolerance)
        for known, wanted, found in zip(cases, right, given, strict=True)
    ]
    near = [
        np.allclose(wanted, found, rtol=1e-5, atol=1e-7, equal_nan=True)
        for wanted, found in zip(right, given, strict=True)
    ]
    return diagnose_values(program, asked, ~np.array(near))


def alike(given, others, rtol=1e-5):
    return all(np.allclose(*both, rtol, equal_nan=True) for both in zip(given, others, strict=True))


def is_constant(given):
    """One number for all that is asked: that has no name."""
    return len(np.unique(np.concatenate([np.ravel(one) for one in given]))) == 1


def names(said):
    return [{one.name for one in found} for found in said.candidates]


@pytest.mark.parametrize("name", PROGRAMS)
def test_each_mistake_is_named(name):
    program, cases = program_and_cases(name, 8)
    right = answers(program, cases)
    assert len({mistake.name for mistake in program.mistakes}) == len(program.mistakes)
    for mistake in program.mistakes:
        given = answers(program, cases, (mistake,))
        assert any(not np.array_equal(a, b) for a, b in zip(given, right, strict=True)), mistake
        tolerance = None if "offset" in name or "bitmap" in name else 0.0
        if is_constant(given):
            continue
        for form in (np.float64, np.float32) if name == "basis" else (np.float64,):
            said = diagnosed(program, cases, [one.astype(form) for one in given], tolerance)
            found = names(said)
            assert {mistake.name} in found, (mistake.name, found)
            for others in said.candidates:
                assert alike(given, answers(program, cases, others)), (mistake.name, found)
        assert said.sentences[0] == said.candidates[0][0].hint


@pytest.mark.parametrize("name", ["basis", "sphere", "offset"])
def test_two_at_once(name):
    program, cases = program_and_cases(name, 9)
    right, pairs = answers(program, cases), list(program.pairs())
    random = np.random.default_rng(1)
    for number in random.choice(len(pairs), 8, replace=False):
        given = answers(program, cases, pairs[number])
        if alike(given, right) or is_constant(given) or any(np.isnan(one).any() for one in given):
            continue
        said = diagnosed(program, cases, given, None if name == "offset" else 0.0)
        for others in said.candidates:
            assert alike(given, answers(program, cases, others), 1e-9)
        assert said.candidates


class TestRender:
    def cases(self, projection, from_top=True):
        random = np.random.default_rng(6)
        task = RayTask(projection, from_top=from_top)
        made = []
        for number in range(3):
            camera = made_camera(random, ("off-axis", "skewed")[number % 2], projection)
            size = ((7, 5), (4, 6))[number % 2]
            ray = camera.ray(2, 2, size)._asdict()
            objects = objects_near(random, ray, 6)
            made.append((camera, size, objects, [0.1, 0.0, 0.2]))
        return task, made, [
            render_values(camera, size, task, *scene) for camera, size, *scene in made
        ]  # fmt: skip

    @pytest.mark.parametrize("projection", ["perspective", "parallel"])
    def test_each_mistake_is_named(self, projection):
        task, _, known = self.cases(projection)
        program = render_program(task)
        right = answers(program, known)
        missed = []
        loops = len(program.mistakes) - len(ray_program(task).mistakes) + 1
        for mistake in program.mistakes[:loops] + program.mistakes[-40::10]:
            given = answers(program, known, (mistake,))
            if all(np.array_equal(a, b) for a, b in zip(given, right, strict=True)):
                missed.append(mistake.name)
                continue
            wrong = [not np.array_equal(a, b) for a, b in zip(given, right, strict=True)]
            asked = [ValueCase(*one, 0.5 / 255) for one in zip(known, right, given, strict=True)]
            said = diagnose_values(program, asked, wrong)
            assert {mistake.name} in names(said)
            for others in said.candidates:
                same = answers(program, known, others)
                assert all(np.array_equal(a, b) for a, b in zip(given, same, strict=True))
        assert len(missed) <= 2  # what does not show in these few images


def test_facts():
    program, known = program_and_cases("sphere", 4)

    def said(right, given):
        asked = [ValueCase(*one) for one in zip(known, right, given, strict=False)]
        return diagnose_values(program, asked, np.array(right) != np.array(given)).sentences

    inf = math.inf
    assert said([1.0, inf, 2.0], [inf] * 3) == ("You never find a hit.",)
    assert said([1.0, inf, 2.0], [2.5] * 3) == ("All your answers are 2.5, whatever is asked.",)
