"""What is told of wrong rays: by name, as another camera, or what of them is right."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from asked_rays import TASKS, asked_cases, made_cases

from app.checking.mistakes.ray_diagnosis import diagnose_rays
from app.checking.mistakes.ray_trial import RayCase, RayTrial
from app.checking.mistakes.rays import RayTask
from renderer.camera import Camera


class TestWhatIsSaid:
    def diagnosed(self, make, cases=None, task=None, **more):
        """Of a function of a case that gives origin and direction."""
        cases = cases or made_cases(5, 6)
        given = np.array([make(case) for case in cases], float)
        right = np.array([case.camera.ray(*case.pixel, case.size) for case in cases])
        apart = RayTrial(cases, given, RayTask()).apart(given, right, np.arange(len(cases)))
        return diagnose_rays(cases, given, ~(apart <= 1e-6), task, **more)

    def test_nothing_of_right_rays(self):
        assert self.diagnosed(lambda case: case.camera.ray(*case.pixel, case.size)) is None

    def test_one_mistake(self):
        def upside_down(case):
            i, j = case.pixel
            return case.camera.ray(case.size[1] - 1 - i, j, case.size)

        said = self.diagnosed(upside_down)
        assert [[one.name for one in found] for found in said.candidates] == [
            ["rows count upwards"]
        ]
        assert said.sentences == (
            "Rows count downwards, v points up: v needs its minus sign.",
            "As if it read `y = bottom + (i + 0.5) / height * (top - bottom)`, not "
            "`y = top - (i + 0.5) / height * (top - bottom)`.",
            "Read again: From pixel to ray.",
        )
        assert said.first == 0

    def test_two_mistakes(self):
        def made(case):
            camera = replace(case.camera, distance=1.0)
            i, j = case.pixel
            return camera.ray(i - 0.5, j - 0.5, case.size)

        said = self.diagnosed(made)
        assert [{one.name for one in found} for found in said.candidates] == [
            {"no distance", "the corner, not the centre"}
        ]
        assert said.sentences[0] == "Two mistakes at once."

    def test_what_numbers_cannot_tell_apart_is_all_named(self):
        """In square images of a square viewport, the image transposed and rows for columns."""
        camera = Camera((1, 2, 3), distance=2.0)
        cases = [RayCase(camera, (5, 5), (i, j)) for i in range(5) for j in range(5)]
        said = self.diagnosed(lambda case: camera.ray(*case.pixel[::-1], case.size), cases)
        names = {found[0].name for found in said.candidates}
        assert names == {"row and column exchanged", "the image transposed"}
        assert any(sentence.startswith("Or, with the same numbers:") for sentence in said.sentences)

    def test_both_projections_share_a_mistake(self):
        cases = made_cases(5, 4) + made_cases(6, 4, "parallel")

        def off(case):
            i, j = case.pixel
            return case.camera.ray(i - 1, j - 1, case.size)

        said = self.diagnosed(off, cases)
        assert {found[0].name for found in said.candidates} == {"one pixel off"}
        assert sum("do not subtract" in sentence for sentence in said.sentences) == 1

    def test_a_mistake_in_one_projection_alone(self):
        cases = made_cases(5, 4) + made_cases(6, 4, "parallel")

        def made(case):
            ray = case.camera.ray(*case.pixel, case.size)
            return (case.camera.eye, ray.direction) if case.camera.is_parallel else ray

        said = self.diagnosed(made, cases)
        assert said.sentences[0] == "In parallel projection:"
        assert said.candidates[0][0].name == "all rays start at the eye"

    @pytest.mark.parametrize(
        ("told", "make"),
        [
            ("your d is 2 d",
             lambda case: replace(case.camera, distance=2 * case.camera.distance)),
            ("your eye is e + (0.5, 0, 0)",
             lambda case: replace(case.camera, eye=np.add(case.camera.eye, (0.5, 0, 0)))),
            ("your viewport is shifted by 2 pixels to the right",
             lambda case: case.camera.shifted(0, 2, case.size)),
            ("your viewport is 0.5 times as large",
             lambda case: replace(case.camera, viewport=around(case.camera, 0.5))),
            ("your v is 2 v", lambda case: replace(case.camera, v=np.multiply(case.camera.v, 2))),
            ("your u is w; your w is u",
             lambda case: replace(case.camera, u=case.camera.w, w=case.camera.u)),
        ],
    )  # fmt: skip
    def test_a_camera_of_no_known_mistake_is_told(self, told, make):
        said = self.diagnosed(lambda case: make(case).ray(*case.pixel, case.size))
        assert said.candidates == ()
        assert said.sentences[0] == f"What you wrote is a camera, only another one: {told}."
        case = made_cases(5, 6)[0]
        rays, fitted = make(case).rays(case.size), said.camera.rays(case.size)
        assert np.abs(fitted.origin - rays.origin).max() < 1e-9
        turned = np.cross(fitted.direction, rays.direction)
        assert np.abs(turned).max() < 1e-9

    def test_the_tangent_of_degrees(self):
        """From the viewport's top: where the tangent is below 0, both axes are turned round."""

        def made(case):
            camera = case.camera
            left, right, bottom, top = camera.viewport
            half = math.tan(math.degrees(math.atan2(top, camera.distance)))
            wide = half * (right - left) / (top - bottom)
            i, j = case.pixel
            x = (2 * (j + 0.5) / case.size[0] - 1) * wide
            y = (1 - 2 * (i + 0.5) / case.size[1]) * half
            return camera.eye, camera.basis @ (x, y, -1)

        said = self.diagnosed(made)
        assert said.differences[0] == (
            "your viewport is as large as if an angle in degrees were in radians"
        )
        assert not any("u points" in one or "v points" in one for one in said.differences)
        tangents = [
            math.tan(math.degrees(math.atan2(case.camera.viewport[3], case.camera.distance)))
            for case in made_cases(5, 6)
        ]
        assert min(tangents) < 0 < max(tangents)

    def test_the_eye_at_the_target(self):
        task = TASKS["from a target"]
        cases = asked_cases(task, 5)
        said = self.diagnosed(
            lambda case: (case.target, case.camera.ray(*case.pixel, case.size).direction),
            cases,
            task,
        )
        assert said.differences == ("your eye is the target",)

    @pytest.mark.parametrize(
        ("told", "make"),
        [
            ("Your directions point backwards: t > 0 must lead into the scene.",
             lambda ray, case: (ray.origin, -ray.direction * (1 + case.pixel[0]))),
            ("Your origins are right, your directions are not.",
             lambda ray, case: (ray.origin, np.sin(ray.direction + 1))),
            ("Your directions are right, your origins are not.",
             lambda ray, case: (np.sin(np.asarray(case.pixel).sum() + ray.origin), ray.direction)),
            ("All your rays of an image are the same: they do not depend on i and j.",
             lambda ray, case: ((1, 2, 3), (4, 5, 6))),
            ("Your rays are the same in all rows: they do not depend on i.",
             lambda ray, case: ((1, 2, 3), (1, case.pixel[1] ** 2, 2))),
        ],
    )  # fmt: skip
    def test_what_is_right_of_the_rest(self, told, make):
        said = self.diagnosed(lambda case: make(case.camera.ray(*case.pixel, case.size), case))
        assert told in said.sentences or said.candidates

    def test_which_part_of_the_direction(self):
        def bent(case):
            camera = case.camera
            x, y = camera.image_point(*case.pixel, case.size)
            return camera.eye, camera.basis @ (x + 0.1 * x**2, y, -camera.distance)

        said = self.diagnosed(bent)
        assert "look at the column j" in " ".join(said.sentences)

    def test_where_rays_are_right(self):
        cases = [
            replace(case, size=size, pixel=(i, j))
            for case in made_cases(5, 40)[::25]
            for size in ((3, 3), (3, 4))
            for i in range(3)
            for j in range(3)
        ]

        def bent(case):
            ray = case.camera.ray(*case.pixel, case.size)
            square = case.size[0] == case.size[1]
            return (ray.origin, ray.direction + (0 if square else np.sin(case.pixel[0] + 1)))

        said = self.diagnosed(bent, cases)
        assert "Your rays are right in square images, and wrong elsewhere." in said.sentences

    def test_where_pixels_are_square_in_images_that_are_not(self):
        cases = [
            replace(case, camera=replace(case.camera, viewport=viewport), size=size, pixel=(i, j))
            for case in made_cases(5, 40)[::25]
            for viewport in ((-1.0, 3.0, -1.0, 2.0), (-1.0, 2.0, -1.0, 3.0))
            for size in ((4, 3), (3, 4))
            for i in range(3)
            for j in range(3)
        ]

        def bent(case):
            ray = case.camera.ray(*case.pixel, case.size)
            left, right, _, _ = case.camera.viewport
            square = right - left == case.size[0]
            return (ray.origin, ray.direction + (0 if square else np.sin(case.pixel[0] + 1)))

        said = self.diagnosed(bent, cases)
        assert "Your rays are right where pixels are square, and wrong elsewhere." in said.sentences

    def test_where_they_are_right_by_chance_nothing_is_said(self):
        """Half of the rays of every image of 3 x 4 pixels are wrong: not "elsewhere"."""
        cases = [
            replace(case, size=size, pixel=(i, j))
            for case in made_cases(5, 40)[::25]
            for size in ((3, 3), (3, 4), (4, 3))
            for i in range(3)
            for j in range(3)
        ]

        def bent(case):
            ray = case.camera.ray(*case.pixel, case.size)
            wrong = case.size == (3, 4) and case.pixel != (0, 0)
            return ray.origin, ray.direction + wrong * np.sin(case.pixel[0] + 1)

        said = self.diagnosed(bent, cases)
        assert not any("right where" in one or "right in" in one for one in said.sentences)

    def test_only_the_last_row_or_column(self):
        cases = [
            replace(case, size=(4, 4), pixel=(i, j))
            for case in made_cases(5, 40)[::25]
            for i in range(4)
            for j in range(4)
        ]

        def bent(case):
            i, j = case.pixel
            ray = case.camera.ray(min(i, 2), min(j, 2), case.size)
            return ray.origin, ray.direction

        said = self.diagnosed(bent, cases)
        assert "Only rays of the last row or column are wrong." in said.sentences

    def test_the_first_camera_for_all(self):
        cases = [
            replace(case, size=(4, 4), pixel=(i, j))
            for case in made_cases(5, 40)[::25]
            for i in range(4)
            for j in range(4)
        ]

        def first(case):
            camera = cases[0].camera
            if case.camera.is_parallel != camera.is_parallel:
                camera = replace(camera, projection=case.camera.projection)
            camera = replace(camera, viewport=case.camera.viewport, distance=case.camera.distance)
            return camera.ray(*case.pixel, case.size)

        said = self.diagnosed(first, cases)
        assert "does it keep its eye and basis from one call" in " ".join(said.sentences)

    def test_rays_of_no_camera(self):
        def bent(case):
            ray = case.camera.ray(*case.pixel, case.size)
            return np.sin(ray.origin + case.pixel[0]), np.sin(ray.direction + case.pixel[1] ** 2)

        said = self.diagnosed(bent)
        assert said.camera is None and said.candidates == ()
        assert "not those of a camera" in said.sentences[0]

    def test_no_numbers(self):
        said = self.diagnosed(lambda case: ((np.nan, 0, 0), (0, 0, 0)))
        assert "have NaN or inf" in said.sentences[0]
        assert "directions are zero" in said.sentences[1]

    def test_lengths_where_they_count(self):
        def unit(case):
            ray = case.camera.ray(*case.pixel, case.size)
            return ray.origin, ray.direction / np.linalg.norm(ray.direction)

        cases = made_cases(5, 4)
        given = np.array([unit(case) for case in cases])
        said = diagnose_rays(cases, given, np.ones(len(cases), bool), lengths="exact")
        assert said.candidates[0][0].name == "normalised"

    def test_any_point_of_the_ray(self):
        """Where it may begin anywhere, that is no mistake; what is wrong beside it is told."""

        def moved(case):
            ray = case.camera.ray(*case.pixel[::-1], case.size)
            return ray.origin + 0.7 * ray.direction, ray.direction

        said = self.diagnosed(moved, any_origin=True)
        assert said.candidates[0][0].name == "row and column exchanged"


def around(camera, factor):
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    wide, high = factor * (right - left) / 2, factor * (top - bottom) / 2
    return x - wide, x + wide, y - high, y + high
