"""Questions with checked answers: a pixel's ray, vectors, a choice.

An answer is a typed text, or the number of an option. The reply explains the mistake.
VectorExercise and ChoiceExercise are also tables of a lecture file: [steps.exercise].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import msgspec
import numpy as np

from lucida.app.checking.mistakes.program import Mistake
from lucida.app.checking.mistakes.rays import RayTask, ray_program, ray_values, run_rays
from lucida.app.state.kept_lecture import Judgement
from lucida.app.ui.explaining import symbols
from lucida.app.ui.explaining.arithmetic import text_of, vector, vector_text
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Ray
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files.schema import Numbers3, StrictTable
from lucida.renderer.system.errors import LucidaError

from .text import escaped

TOLERANCE = 2e-3  # an answer may be rounded to three digits
CORRECT = "Correct."


@dataclass(frozen=True)
class RayExercise:
    """An exercise to find the viewing ray of a pixel, given the camera.

    pixel: (row, column), 0-based. size: (width, height) of the image. scaled: any positive
    multiple of the direction counts. tolerance: the largest error, relative to the vector.
    indexing: how the texts count pixels.
    """

    question: str
    camera: Camera
    pixel: tuple[int, int]
    size: tuple[int, int]
    scaled: bool = True
    tolerance: float = TOLERANCE
    indexing: Indexing = Indexing.LECTURE

    @property
    def fields(self) -> tuple[str, ...]:
        return "origin", "direction"

    def check(self, answers: Mapping[str, str]) -> Judgement:
        """Return the verdict on the texts in the two fields."""
        given = vectors(answers, self.fields)
        if isinstance(given, Judgement):
            return given
        ray = self.camera.ray(*self.pixel, self.size)
        wrong_origin = not self._is_origin(given["origin"], ray.origin)
        wrong_direction = not self._is_direction(given["direction"], ray.direction)
        if not wrong_origin and not wrong_direction:
            return Judgement(True, CORRECT)
        for mistake, wrong in self.wrong_rays():
            if self._is_origin(given["origin"], wrong.origin) and self._is_direction(
                given["direction"], wrong.direction
            ):
                return _made(mistake, "origin" if wrong_origin else "direction")
        return self._one_part(given, wrong_origin)

    def solution(self) -> str:
        """Return the correct ray, step by step, as a lecture's text.

        Source: the lecture, "any camera".
        """
        x, y = (float(value) for value in self.camera.image_point(*self.pixel, self.size))
        ray = self.camera.ray(*self.pixel, self.size)
        if self.camera.is_parallel:
            rule = (
                r"$\mathbf{p} = \mathbf{e} + u\,\mathbf{u} + v\,\mathbf{v}$, "
                r"$\mathbf{d} = -\mathbf{w}$"
            )
        else:
            rule = (
                r"$\mathbf{p} = \mathbf{e}$, "
                r"$\mathbf{d} = u\,\mathbf{u} + v\,\mathbf{v} - d\,\mathbf{w}$"
            )
        pixel = self.indexing.text(self.pixel)
        return (
            f"Pixel {pixel} lies at $u = {text_of(x)}$, $v = {text_of(y)}$.\n\n{rule}\n\n"
            rf"$\mathbf{{p}}$ = `{vector_text(ray.origin)}`, "
            rf"$\mathbf{{d}}$ = `{vector_text(ray.direction)}`"
        )

    @property
    def replies(self) -> dict[str, str]:
        """The replies to a wrong ray that is not a classic mistake."""
        where = "on the image plane" if self.camera.is_parallel else "at the eye"
        return {
            "origin": f"Not yet: the ray begins {where}.",
            "length": "The direction is correct, but its length is not: do not normalise it.",
            "backwards": "The direction points backwards: t > 0 must lead into the scene.",
            "direction": "Not yet: the origin is correct, but the direction is not.",
        }

    def wrong_rays(self) -> Iterator[tuple[Mistake, Ray]]:
        """Return the ray of each wrong line for the pixel; it may be the correct ray."""
        task = RayTask(self.camera.projection, self.indexing)
        program, known = ray_program(task), ray_values(self.camera, *self.pixel, self.size, task)
        for mistake in program.mistakes:
            yield mistake, Ray(*run_rays(program, known, (mistake,)))

    def _one_part(self, given: dict[str, Floats], wrong_origin: bool) -> Judgement:
        """Return the reply to the first wrong part. The ray as a whole is not a classic mistake."""
        for mistake, wrong in self.wrong_rays():
            if wrong_origin and self._is_origin(given["origin"], wrong.origin):
                return _made(mistake, "origin")
            if not wrong_origin and self._is_direction(given["direction"], wrong.direction):
                return _made(mistake, "direction")
        replies = self.replies
        if wrong_origin:
            return Judgement(False, replies["origin"], "origin")
        ray = self.camera.ray(*self.pixel, self.size)
        if is_multiple(given["direction"], ray.direction, self.tolerance):
            return _recognised(replies["length"], "direction")
        if is_multiple(-given["direction"], ray.direction, self.tolerance):
            return _recognised(replies["backwards"], "direction")
        return Judgement(False, replies["direction"], "direction")

    def _is_origin(self, given: Floats, exact: Floats) -> bool:
        return is_close(given, exact, self.tolerance)

    def _is_direction(self, given: Floats, exact: Floats) -> bool:
        compare = is_multiple if self.scaled else is_close
        return compare(given, exact, self.tolerance)


# A vector is drawn as an arrow at the eye, a point, or the corner of a viewport (left, top, d).
Drawn = Literal["arrow", "point", "corner"]
DRAWN: dict[str, Drawn] = {
    **dict.fromkeys(("e", "eye", "p", "origin", "a", "target"), "point"),
    "left, top, d": "corner",
}


def hint(mistake: Mistake) -> str:
    """Return the explanation as a lecture's text, with the book's formulas in place of code."""
    parts = mistake.hint.split("`")
    parts[1::2] = [f"${symbols.formula(code)}$" for code in parts[1::2]]
    return "".join(parts)


class WrongVector(StrictTable):
    """An answer that is known to be wrong, and the reply."""

    value: Numbers3
    feedback: str


class Wanted(StrictTable):
    """A vector to find. scaled: any positive multiple counts. draw: the form of a wrong one in the
    outside view; None to choose by its name.
    """

    name: str
    value: Numbers3
    scaled: bool = False
    wrong: list[WrongVector] = msgspec.field(default_factory=list)
    draw: Drawn | None = None

    @property
    def replies(self) -> dict[str, str]:
        """The replies to a wrong vector that is not among the known ones."""
        name = escaped(self.name)
        return {
            "length": f"The direction of {name} is correct, but its length is not.",
            "opposite": f"{name} points the other way.",
            "not yet": f"Not yet: {name} is not correct.",
        }

    @property
    def drawn(self) -> Drawn:
        return self.draw or DRAWN.get(self.name, "arrow")


class VectorExercise(StrictTable, tag_field="kind", tag="vector"):
    """An exercise to find one vector or several, such as u, v, w of an eye, a target and an up."""

    question: str
    answers: list[Wanted]
    tolerance: float = TOLERANCE

    @property
    def fields(self) -> tuple[str, ...]:
        return tuple(wanted.name for wanted in self.answers)

    def check(self, answers: Mapping[str, str]) -> Judgement:
        """Return the verdict on the texts in the fields: the first wrong one is reported."""
        given = vectors(answers, self.fields)
        if isinstance(given, Judgement):
            return given
        for wanted in self.answers:
            value, exact = given[wanted.name], np.asarray(wanted.value)
            compare = is_multiple if wanted.scaled else is_close
            if compare(value, exact, self.tolerance):
                continue
            for wrong in wanted.wrong:
                if compare(value, np.asarray(wrong.value), self.tolerance):
                    return _recognised(wrong.feedback, wanted.name)
            replies = wanted.replies
            if is_multiple(value, exact, self.tolerance):
                return _recognised(replies["length"], wanted.name)
            if is_multiple(-value, exact, self.tolerance):
                return _recognised(replies["opposite"], wanted.name)
            return Judgement(False, replies["not yet"], wanted.name)
        return Judgement(True, CORRECT)

    def solution(self) -> str:
        return "\n\n".join(
            f"{escaped(wanted.name)} = `{vector_text(np.asarray(wanted.value))}`"
            for wanted in self.answers
        )


class Option(StrictTable):
    """One answer to select. feedback: the reply to it. camera: the fields of the step's camera that
    change when it is selected.
    """

    text: str
    feedback: str
    right: bool = False
    camera: dict[str, Any] | None = None


class ChoiceExercise(StrictTable, tag_field="kind", tag="choice"):
    """An exercise to select one of several answers, of which exactly one is correct."""

    question: str
    options: list[Option]

    def check(self, chosen: int) -> Judgement:
        """Return the verdict on an option, by its number from 0."""
        option = self.options[chosen]
        if option.right:
            return Judgement(True, option.feedback)
        return _recognised(option.feedback)

    def solution(self) -> str:
        right = next(option for option in self.options if option.right)
        return f"{right.text}\n\n{right.feedback}"


TypedExercise = RayExercise | VectorExercise
AskedExercise = TypedExercise | ChoiceExercise


def vectors(answers: Mapping[str, str], names: tuple[str, ...]) -> dict[str, Floats] | Judgement:
    """Return the answers as vectors, or the reply to the first that is not a vector."""
    given = {}
    for name in names:
        try:
            given[name] = vector(answers.get(name, ""))
        except LucidaError as error:
            return Judgement(False, escaped(f"{name}: {error}"), name, is_answer=False)
    return given


def _made(mistake: Mistake, field: str) -> Judgement:
    return Judgement(False, hint(mistake), field, mistake.name, mistake.part)


def _recognised(reply: str, field: str = "") -> Judgement:
    """Return the verdict on a mistake that is named by its reply."""
    return Judgement(False, reply, field, reply)


def is_close(given: Floats, exact: Floats, tolerance: float) -> bool:
    return bool(np.linalg.norm(given - exact) <= tolerance * max(1.0, float(np.linalg.norm(exact))))


def is_multiple(given: Floats, exact: Floats, tolerance: float) -> bool:
    """Return True if two vectors have the same direction; False for a zero vector."""
    lengths = np.linalg.norm(given), np.linalg.norm(exact)
    if min(lengths) < 1e-12:
        return False
    return bool(np.linalg.norm(given / lengths[0] - exact / lengths[1]) <= tolerance)
