"""The diagnosis of wrong rays: by name, or what is right about them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from asked_rays import made_cases

from lucida.app.checking.mistakes.ray_diagnosis import diagnose_rays
from lucida.app.checking.mistakes.ray_trial import RayCase, RayTrial
from lucida.app.checking.mistakes.rays import RayTask
from lucida.renderer.camera.camera import Camera


def diagnosed(make, cases=None, task=None, **more):
    """Return the diagnosis of a function from a ray and its case to origin and direction."""
    cases = cases or made_cases(5, 6)
    right = np.array([case.camera.ray(*case.pixel, case.size) for case in cases])
    given = np.array([make(*ray, case) for ray, case in zip(right, cases, strict=True)], float)
    apart = RayTrial(cases, given, RayTask()).apart(given, right, np.arange(len(cases)))
    return diagnose_rays(cases, given, ~(apart <= 1e-6), task, **more)


def whole_images(*sizes):
    """Return all pixels of images of these sizes, of a few cameras."""
    return [
        replace(case, size=size, pixel=pixel)
        for case in made_cases(5, 40)[::25]
        for size in sizes
        for pixel in np.ndindex(size[::-1])
    ]


def bent_unless(is_right):
    return lambda o, d, case: (o, d + (not is_right(case)) * np.sin(case.pixel[0] + 1))


def names(said):
    return [{one.name for one in found} for found in said.candidates]


def test_one_mistake():
    def upside_down(o, d, case):
        return case.camera.ray(case.size[1] - 1 - case.pixel[0], case.pixel[1], case.size)

    said = diagnosed(upside_down)
    assert names(said) == [{"rows count upwards"}]
    assert said.sentences == (
        "Rows count downwards, `v` points up: `y` needs its minus sign.",
        "As if it read `y = bottom + (i + 0.5) / height * (top - bottom)`, not "
        "`y = top - (i + 0.5) / height * (top - bottom)`.",
        "Read again: From pixel to (u, v).",
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


def test_each_projection_has_its_own_mistake():
    cases = made_cases(5, 4) + made_cases(6, 4, "parallel")

    def ray(o, d, case):
        down = case.size[1] - 1 - case.pixel[0]
        perspective = case.camera.ray(down, case.pixel[1], case.size)
        return (case.camera.eye, d) if case.camera.is_parallel else perspective

    said = diagnosed(ray, cases)
    assert names(said) == [{"rows count upwards"}, {"all rays start at the eye"}]
    places = [sentence for sentence in said.sentences if sentence.startswith("In ")]
    assert places == ["In perspective:", "In parallel projection:"]


FACTS = {
    "All your rays are the same: they do not depend on i and j.":
        lambda o, d, case: ((1, 2, 3), (4, 5, 6)),
    "162 of 162 rays have NaN or inf: look for a division by 0.":
        lambda o, d, case: ((np.nan, 0, 0), (0, 0, 0)),
}  # fmt: skip


@pytest.mark.parametrize("told", FACTS)
def test_facts(told):
    said = diagnosed(FACTS[told])
    assert told in said.sentences and not said.candidates


def test_where_rays_are_right():
    bent = bent_unless(lambda case: case.size == (3, 3))
    told = "Your rays are correct in square images, and wrong elsewhere."
    assert told in diagnosed(bent, whole_images((3, 3), (3, 4))).sentences
    # One ray of every image of 3 x 4 pixels is right: not "elsewhere".
    bent = bent_unless(lambda case: case.size != (3, 4) or case.pixel == (0, 0))
    said = diagnosed(bent, whole_images((3, 3), (3, 4), (4, 3)))
    assert not any("wrong elsewhere" in sentence for sentence in said.sentences)


def test_any_point_of_the_ray():
    """An origin further on is no mistake where any is allowed; another mistake is reported."""

    def moved(o, d, case):
        origin, direction = case.camera.ray(*case.pixel[::-1], case.size)
        return origin + 0.7 * direction, direction

    said = diagnosed(moved, any_origin=True)
    assert said.candidates[0][0].name == "row and column exchanged"
