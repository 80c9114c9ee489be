"""The diagnosis of wrong rays: by name, as another camera, or what is right about them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from asked_rays import TASKS, asked_cases, made_cases

from app.checking.mistakes.ray_diagnosis import diagnose_rays
from app.checking.mistakes.ray_trial import RayCase, RayTrial
from app.checking.mistakes.rays import RayTask
from app.explaining.symbols import marked
from renderer.camera import Camera


def diagnosed(make, cases=None, task=None, **more):
    """Return the diagnosis of a function from a ray and its case to origin and direction."""
    cases = cases or made_cases(5, 6)
    right = np.array([case.camera.ray(*case.pixel, case.size) for case in cases])
    given = np.array([make(*ray, case) for ray, case in zip(right, cases, strict=True)], float)
    apart = RayTrial(cases, given, RayTask()).apart(given, right, np.arange(len(cases)))
    return diagnose_rays(cases, given, ~(apart <= 1e-6), task, **more)


def at(down, across):
    """Return the function that takes the ray of a pixel moved by so much."""
    return lambda o, d, case: case.camera.ray(
        case.pixel[0] + down, case.pixel[1] + across, case.size
    )


def by(camera_of):
    return lambda o, d, case: camera_of(case.camera, case).ray(*case.pixel, case.size)


def whole_images(*sizes, viewports=(None,)):
    """Return all pixels of images of these sizes, of a few cameras."""
    return [
        replace(case, camera=replace(case.camera, viewport=viewport or case.camera.viewport),
                size=size, pixel=pixel)
        for case in made_cases(5, 40)[::25]
        for viewport in viewports
        for size in sizes
        for pixel in np.ndindex(size[::-1])
    ]  # fmt: skip


def bent_unless(is_right):
    return lambda o, d, case: (o, d + (not is_right(case)) * np.sin(case.pixel[0] + 1))


def names(said):
    return [{one.name for one in found} for found in said.candidates]


def test_right_rays_have_no_diagnosis():
    assert diagnosed(lambda o, d, case: (o, d)) is None


def test_one_mistake():
    def upside_down(o, d, case):
        return case.camera.ray(case.size[1] - 1 - case.pixel[0], case.pixel[1], case.size)

    said = diagnosed(upside_down)
    assert names(said) == [{"rows count upwards"}] and said.first == 0
    assert said.sentences == (
        "Rows count downwards, `v` points up: `y` needs its minus sign.",
        "As if it read `y = bottom + (i + 0.5) / height * (top - bottom)`, not "
        "`y = top - (i + 0.5) / height * (top - bottom)`.",
        "Read again: From pixel to ray.",
    )


def test_two_mistakes():
    said = diagnosed(
        lambda o, d, c: replace(c.camera, distance=1.0).ray(*np.subtract(c.pixel, 0.5), c.size)
    )
    assert names(said) == [{"no distance", "the corner, not the centre"}]
    assert said.sentences[0] == "Two mistakes at once."


def test_all_mistakes_with_the_same_numbers_are_named():
    """In square images of a square viewport, the image transposed and rows for columns."""
    camera = Camera((1, 2, 3), distance=2.0)
    cases = [RayCase(camera, (5, 5), pixel) for pixel in np.ndindex(5, 5)]
    said = diagnosed(lambda o, d, case: camera.ray(*case.pixel[::-1], case.size), cases)
    assert names(said) == [{"row and column exchanged"}, {"the image transposed"}]
    assert any(sentence.startswith("Or, with the same numbers:") for sentence in said.sentences)
    # One of them explains other images in the other projection.
    cases += made_cases(6, 4, "parallel")
    said = diagnosed(lambda o, d, case: case.camera.ray(*case.pixel[::-1], case.size), cases)
    assert names(said) == [{"row and column exchanged"}]


def test_both_projections_share_a_mistake_or_one_has_it():
    cases = made_cases(5, 4) + made_cases(6, 4, "parallel")
    said = diagnosed(at(-1, -1), cases)
    assert names(said) == [{"one pixel off"}]
    assert sum("do not subtract" in sentence for sentence in said.sentences) == 1
    said = diagnosed(lambda o, d, c: (c.camera.eye if c.camera.is_parallel else o, d), cases)
    assert said.sentences[0] == "In parallel projection:"
    assert said.candidates[0][0].name == "all rays start at the eye"


def test_each_projection_has_its_own_mistake():
    cases = made_cases(5, 4) + made_cases(6, 4, "parallel")

    def ray(o, d, case):
        down = case.size[1] - 1 - case.pixel[0]
        perspective = case.camera.ray(down, case.pixel[1], case.size)
        return (case.camera.eye, d) if case.camera.is_parallel else perspective

    said = diagnosed(ray, cases)
    assert [{*one} for one in names(said)] == [
        {"rows count upwards"}, {"all rays start at the eye"}
    ]  # fmt: skip
    places = [sentence for sentence in said.sentences if sentence.startswith("In ")]
    assert places == ["In perspective:", "In parallel projection:"]


def around(camera, factor):
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    wide, high = factor * (right - left) / 2, factor * (top - bottom) / 2
    return x - wide, x + wide, y - high, y + high


CAMERAS = {
    "your d is 2 d": lambda c, case: replace(c, distance=2 * c.distance),
    "your eye is e + (0.5, 0, 0)": lambda c, case: replace(c, eye=np.add(c.eye, (0.5, 0, 0))),
    "your viewport is shifted by 2 pixels to the right":
        lambda c, case: c.shifted(0, 2, case.size),
    "your viewport is 0.5 times as large": lambda c, case: replace(c, viewport=around(c, 0.5)),
    "your v is 2 v": lambda c, case: replace(c, v=np.multiply(c.v, 2)),
    "your u is w; your w is u": lambda c, case: replace(c, u=c.w, w=c.u),
}  # fmt: skip


@pytest.mark.parametrize("told", CAMERAS)
def test_a_camera_without_a_known_mistake(told):
    make = CAMERAS[told]
    said = diagnosed(by(make))
    assert said.candidates == ()
    assert said.sentences[0] == f"What you wrote is a camera, only another one: {marked(told)}."
    case = made_cases(5, 6)[0]
    rays, fitted = make(case.camera, case).rays(case.size), said.camera.rays(case.size)
    assert np.abs(fitted.origin - rays.origin).max() < 1e-9
    assert np.abs(np.cross(fitted.direction, rays.direction)).max() < 1e-9


def test_the_tangent_of_degrees():
    """From the viewport's top: where the tangent is below 0, both axes are turned round."""

    def tangent(camera):
        return math.tan(math.degrees(math.atan2(camera.viewport[3], camera.distance)))

    def made(o, d, case):
        left, right, bottom, top = case.camera.viewport
        half, (i, j) = tangent(case.camera), case.pixel
        x = (2 * (j + 0.5) / case.size[0] - 1) * half * (right - left) / (top - bottom)
        return o, case.camera.basis @ (x, (1 - 2 * (i + 0.5) / case.size[1]) * half, -1)

    said = diagnosed(made)
    assert said.differences[0] == (
        "your viewport is as large as if an angle in degrees were in radians"
    )
    assert not any("u points" in one or "v points" in one for one in said.differences)
    tangents = [tangent(case.camera) for case in made_cases(5, 6)]
    assert min(tangents) < 0 < max(tangents)


def test_the_eye_at_the_target():
    task = TASKS["from a target"]
    said = diagnosed(lambda o, d, case: (case.target, d), asked_cases(task, 5), task)
    assert said.differences == ("your eye is the target",)


FACTS = {
    "Your directions point backwards: t > 0 must lead into the scene.":
        lambda o, d, case: (o, -d * (1 + case.pixel[0])),
    "Your origins are correct, your directions are not.": lambda o, d, case: (o, np.sin(d + 1)),
    "Your directions are correct, your origins are not.":
        lambda o, d, case: (np.sin(sum(case.pixel) + o), d),
    "All your rays of an image are the same: they do not depend on i and j.":
        lambda o, d, case: ((1, 2, 3), (4, 5, 6)),
    "Your rays are the same in all rows: they do not depend on i.":
        lambda o, d, case: ((1, 2, 3), (1, case.pixel[1] ** 2, 2)),
    "The directions' part along v is correct, that along u is not: look at the column j.":
        lambda o, d, case: (o, d + case.camera.basis[:, 0] * case.pixel[1] ** 2),
}  # fmt: skip


@pytest.mark.parametrize("told", FACTS)
def test_facts(told):
    said = diagnosed(FACTS[told])
    assert told in said.sentences or said.candidates


SQUARE = {"viewports": ((-1.0, 3.0, -1.0, 2.0), (-1.0, 2.0, -1.0, 3.0))}


@pytest.mark.parametrize(
    ("told", "cases", "make"),
    [
        ("Your rays are correct in square images, and wrong elsewhere.",
         whole_images((3, 3), (3, 4)), bent_unless(lambda case: case.size == (3, 3))),
        ("Your rays are correct where pixels are square, and wrong elsewhere.",
         whole_images((4, 3), (3, 4), **SQUARE),
         bent_unless(lambda c: c.camera.viewport[1] - c.camera.viewport[0] == c.size[0])),
        ("Only rays of the last row or column are wrong.", whole_images((4, 4)),
         lambda o, d, case: case.camera.ray(*np.minimum(case.pixel, 2), case.size)),
    ],
)  # fmt: skip
def test_where_rays_are_right(told, cases, make):
    assert told in diagnosed(make, cases).sentences


def test_a_place_by_chance_is_not_reported():
    """One ray of every image of 3 x 4 pixels is right: not "elsewhere"."""
    bent = bent_unless(lambda case: case.size != (3, 4) or case.pixel == (0, 0))
    said = diagnosed(bent, whole_images((3, 3), (3, 4), (4, 3)))
    assert not any("right where" in one or "right in" in one for one in said.sentences)


def test_the_first_camera_for_all():
    cases = whole_images((4, 4))

    def first(camera, case):
        own = {k: getattr(camera, k) for k in ("projection", "viewport", "distance")}
        return replace(cases[0].camera, **own)

    said = diagnosed(by(first), cases)
    assert "does it keep its eye and basis from one call" in " ".join(said.sentences)


def test_rays_of_no_camera():
    said = diagnosed(lambda o, d, c: (np.sin(o + c.pixel[0]), np.sin(d + c.pixel[1] ** 2)))
    assert said.camera is None and said.candidates == ()
    assert "not those of a camera" in said.sentences[0]


def test_no_numbers():
    said = diagnosed(lambda o, d, case: ((np.nan, 0, 0), (0, 0, 0)))
    assert "have NaN or inf" in said.sentences[0]
    assert "directions are zero" in said.sentences[1]


def test_lengths_where_they_count():
    cases = made_cases(5, 4)
    rays = np.array([case.camera.ray(*case.pixel, case.size) for case in cases])
    rays[:, 1] /= np.linalg.norm(rays[:, 1], axis=1, keepdims=True)
    said = diagnose_rays(cases, rays, np.ones(len(cases), bool), lengths="exact")
    assert said.candidates[0][0].name == "normalised"


def test_any_point_of_the_ray():
    """An origin further on is no mistake where any is allowed; another mistake is reported."""

    def moved(o, d, case):
        origin, direction = case.camera.ray(*case.pixel[::-1], case.size)
        return origin + 0.7 * direction, direction

    said = diagnosed(moved, any_origin=True)
    assert said.candidates[0][0].name == "row and column exchanged"
