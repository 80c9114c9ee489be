"""The built-in lectures hold what they should, and each step can be shown."""

import re
from dataclasses import replace

import numpy as np
from both_lectures import both_lectures, read_once
from PIL import Image
from plain_text import plain_text

from lucida.app.lecture.exercises import ChoiceExercise, RayExercise, VectorExercise
from lucida.app.lecture.hiding import HideExercise
from lucida.app.lecture.reading import BUILTINS
from lucida.app.lecture.text import DisplayedFormula
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.trace import Tracer


class TestTheBuiltInLecture:
    @property
    def lecture(self):
        return both_lectures()

    def test_it_covers_the_lecture_in_its_order(self):
        parts = [part for part, _ in self.lecture.outline()]
        assert parts[:5] == [
            "Where were we?",
            "What is an image?",
            "Cameras",
            "Ray tracing",
            "Viewing rays",
        ]
        titles = [step.title for step in self.lecture.steps]
        order = [
            "Two rendering algorithms", "An image is a function", "2D arrays of numbers",
            "The camera conundrum", "Perspective projection", "Parallel projection",
            "Ray tracing", "A ray is half a line", "A simple camera", "From pixel to (u, v)",
            "Any camera", "The program", "One camera, two renderers",
        ]  # fmt: skip
        assert [title for title in titles if title in order] == order
        assert len(titles) == len(set(titles))

    def test_their_names_in_menus_are_their_titles(self):
        lectures = [read_once(path) for path in BUILTINS.values()]
        assert [lecture.title for lecture in lectures] == list(BUILTINS)
        assert [len(lecture.steps) for lecture in lectures] == [35, 10]

    def test_a_build_can_be_read_while_somebody_speaks(self):
        last = {build.title: build for build in self.lecture.builds}
        for build in self.lecture.builds:
            prose = [block for block in build.blocks if not isinstance(block, DisplayedFormula)]
            words = re.findall(r"[^\W\d_]{2,}", plain_text(tuple(prose)))
            assert len(words) <= 40, (build.title, build.build + 1, len(words))
        for title, build in last.items():
            assert build.blocks or "stepper" in build.views, title  # which shows a program

    def test_every_kind_of_exercise_is_in_it(self):
        kinds = {type(step.exercise) for step in self.lecture.steps} - {type(None)}
        assert kinds == {RayExercise, VectorExercise, ChoiceExercise, HideExercise}

    def test_the_photograph_is_what_the_correct_lens_draws(self):
        step = next(step for step in self.lecture.steps if step.title == "Exercise: which lens?")
        with Image.open(step.changes["photograph"]["file"]) as image:
            photograph = np.asarray(image.convert("RGB").reduce(4), float)
        assert isinstance(step.exercise, ChoiceExercise)
        off, right = {}, None
        with Tracer(step.scene) as tracer:
            for option in step.exercise.options:
                k1 = float(option.text.strip("$"))
                camera = replace(step.view.camera, lens=Lens("brown", {"k1": k1}))
                frame = tracer.render(camera, (120, 80), ("color",), samples=16)
                off[k1] = np.abs(to_srgb8(frame.channel("color")) - photograph).mean()
                right = k1 if option.right else right
        assert min(off, key=off.__getitem__) == right
        assert off[right] < 2

    def test_u_and_v_exchanged_are_told_as_such(self):
        for step in self.lecture.steps:
            if isinstance(step.exercise, RayExercise):
                camera, pixel, size = step.exercise.camera, step.pixel, step.exercise.size
                assert pixel == step.exercise.pixel
                x, y = camera.image_point(*pixel, size)
                way = y * np.array(camera.u) + x * np.array(camera.v)
                way -= camera.distance * np.array(camera.w)
                given = {"origin": str(camera.eye), "direction": " ".join(map(str, way))}
                assert "exchanged" in step.exercise.check(given).text, step.title
