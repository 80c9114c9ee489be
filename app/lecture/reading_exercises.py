"""Read a step's exercise, and check it."""

from __future__ import annotations

from typing import Any

from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files.tables import to_struct
from lucida.renderer.files.views import view_from_table
from lucida.renderer.images.frame import check_size
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.errors import LucidaError, under

from .exercises import ChoiceExercise, RayExercise, VectorExercise
from .hiding import HideExercise
from .inheriting import changed_view
from .model import Exercise
from .schema import AnyExercise, HideTable, RayTable

ANSWERS = 8  # most vectors, or options, of an exercise
MISTAKES = 32  # most known mistakes of an answer
MOST_SEEN = 0.5  # of an object that counts as hidden


def exercise_of(table: Any, scene: Scene, view: View, indexing: Indexing) -> Exercise:
    """Return the exercise in a step's table, checked. Raises LucidaError.

    scene, view: of the step. indexing: how the lecture counts pixels.
    """
    entry: RayTable | VectorExercise | ChoiceExercise | HideTable = to_struct(table, AnyExercise)
    if not entry.question.strip():
        raise LucidaError("question", "is empty", "ask something")
    match entry:
        case RayTable():
            return _ray_exercise(entry, view, indexing)
        case HideTable():
            return _hide_exercise(entry, scene, view)
        case VectorExercise():
            _check_vectors(entry)
        case ChoiceExercise():
            _check_options(entry, view)
    return entry


def pixel_of(
    pixel: tuple[int, int], size: tuple[int, int] | None, indexing: Indexing
) -> tuple[int, int]:
    """Return row and column from 0 of a pixel as the lecture counts them.

    size: (width, height) of the image, if the file has it.
    """
    if min(pixel) < indexing.value:
        remedy = f"give row and column, {indexing.told}"
        raise LucidaError("pixel", f"{list(pixel)} is not a pixel", remedy)
    row, column = indexing.pixel(*pixel)
    if size is not None and (row >= size[1] or column >= size[0]):
        last = indexing.numbers((size[1] - 1, size[0] - 1))
        raise LucidaError(
            "pixel",
            f"{list(pixel)} is not in an image of {size[0]}x{size[1]}",
            f"give a row up to {last[0]} and a column up to {last[1]}",
        )
    return row, column


def _ray_exercise(entry: RayTable, view: View, indexing: Indexing) -> RayExercise:
    size = check_size(entry.size)
    pixel = pixel_of(entry.pixel, size, indexing)
    camera = view.camera if entry.camera is None else view_from_table(entry.camera).camera
    _check_tolerance(entry.tolerance)
    return RayExercise(entry.question, camera, pixel, size, entry.scaled, entry.tolerance, indexing)


def _check_vectors(entry: VectorExercise) -> None:
    if not entry.answers:
        raise LucidaError("answers", "is empty", "give at least one vector")
    _check_answers("answers", len(entry.answers))
    names: set[str] = set()
    for number, answer in enumerate(entry.answers):
        with under(f"answers[{number}]"):
            if answer.name in names:
                raise LucidaError("name", f"{answer.name!r} is there already", "give another name")
            names.add(answer.name)
            _check_answers("wrong", len(answer.wrong), MISTAKES)
    _check_tolerance(entry.tolerance)


def _check_answers(field: str, count: int, most: int = ANSWERS) -> None:
    if count > most:
        raise LucidaError(field, f"holds {count}", f"give at most {most}")


def _check_options(entry: ChoiceExercise, view: View) -> None:
    _check_answers("options", len(entry.options))
    right = sum(option.right for option in entry.options)
    if len(entry.options) < 2:
        raise LucidaError("options", f"holds {len(entry.options)}", "give at least two")
    if right != 1:
        raise LucidaError("options", f"has {right} correct ones", "set right = true in exactly one")
    for number, option in enumerate(entry.options):
        if option.camera is not None:
            with under(f"options[{number}]"):
                changed_view(view, option.camera)


def _hide_exercise(entry: HideTable, scene: Scene, view: View) -> HideExercise:
    if not 0 <= entry.at_most <= MOST_SEEN:
        remedy = f"give 0 to {MOST_SEEN:g}, e.g. 0.02"
        raise LucidaError("at_most", f"{entry.at_most:g} is out of range", remedy)
    return HideExercise(
        entry.question, scene, view, entry.object, entry.hidden, entry.answer, entry.at_most
    )


def _check_tolerance(value: float) -> None:
    if not 0 < value <= 0.1:
        raise LucidaError("tolerance", f"{value:g} is out of range", "give up to 0.1, e.g. 0.002")
