"""The explanation of wrong answers: the mistakes that reproduce them, or other findings."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lucida.app.checking.kinds.kind import Flags
from lucida.app.checking.kinds.viewing_ray import are_right
from lucida.app.checking.own_words import AS_IF, in_the_tasks_words
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.state.app_state import is_orthonormal
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .program import Mistakes, Program
from .programs import program_of
from .trials import candidates, trials_of

Cases = Sequence[CheckCase]

MOST = 1000  # cases to examine; large images have more rays
NAMED = 3  # candidates named; more would not help
READ = "Read again: "  # before the title of a lecture's step


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """The explanation of wrong answers.

    sentences: the explanation in the lecture's words, the most helpful sentence first.
    candidates: the mistakes, one or two at once, that all fit the numbers; () if there are none.
    """

    sentences: tuple[str, ...]
    candidates: tuple[Mistakes, ...] = ()


def diagnosis(task: CheckTask, cases: Cases, given: Any, wrong: Flags) -> Diagnosis:
    """Return the diagnosis of wrong answers, in the task's words.

    given: the answers in the kind's own form.
    wrong: the wrong ones, bool (N,).
    """
    found: tuple[Mistakes, ...] = ()
    with np.errstate(all="ignore"):  # a student's numbers may be anything
        sentences = list(_of_all(task, cases, given))
        if not sentences:
            wrong_first = np.argsort(~wrong, kind="stable")
            chosen = wrong_first[:: -(-len(cases) // MOST)]
            program = program_of(task)
            answers = [given[number] for number in chosen]
            trials = trials_of(task, [cases[number] for number in chosen], answers)
            found = candidates(program, trials)
            if found:
                sentences = _candidate_sentences(program, found)
            elif task.kind == "viewing-ray":
                sentences = list(_correct_parts(task, cases, given, wrong))
    return Diagnosis(in_the_tasks_words(task, sentences), found)


def _of_all(task: CheckTask, cases: Cases, given: Any) -> Iterator[str]:
    """Yield a sentence that describes all answers, if there is one."""
    if task.kind == "viewing-ray":
        if are_right(cases, given, unit=False).all():
            yield "The directions are correct, but not of length 1: normalise them."
        return
    last = np.array([np.ravel(one)[-1] for one in given], float)
    numbers = np.concatenate([np.ravel(np.asarray(one, float)) for one in given])
    if "hit" in task.kind and np.isposinf(last).all():
        yield "You never find a hit."
    elif len(cases) > 2 and (numbers == numbers[0]).all():
        yield f"All your answers are {numbers[0]:.4g}, whatever is asked."


def _candidate_sentences(program: Program, found: Sequence[Mistakes]) -> list[str]:
    """Return the first candidate's hints and wrong lines, the others' hints, and the steps to read
    again.
    """
    first = found[0]
    sentences = ["Two mistakes at once."] if len(first) == 2 else []
    sentences += dict.fromkeys(mistake.hint for mistake in first)
    for line in program.text(first):
        if line.instead is not None:
            written = " and ".join(f"`{code.strip()}`" for code in line.instead.split("\n"))
            sentences.append(f"{AS_IF} {written}, not `{line.code.strip()}`.")
    hints = [" ".join(mistake.hint for mistake in others) for others in found[1:NAMED]]
    for hint in dict.fromkeys(hints):
        if hint not in sentences:
            sentences.append(f"Or, with the same numbers: {hint}")
    if len(found) > NAMED:
        sentences.append(f"{len(found) - NAMED} more mistakes would give the same numbers.")
    parts = dict.fromkeys(mistake.part for mistake in first)
    return [*sentences, *(f"{READ}{title}." for title in parts)]


# The correct parts of wrong rays, reported when no mistake fits.


def is_symmetric(camera: Camera) -> bool:
    """Return True if the viewport has 0 in its middle."""
    left, right, bottom, top = camera.viewport
    return abs(left + right) + abs(bottom + top) <= 1e-9 * (right - left + top - bottom)


PLACES: dict[str, Callable[[Camera, Size], bool]] = {
    "where the basis is orthonormal": lambda camera, _: is_orthonormal(camera),
    "where the viewport is symmetric": lambda camera, _: is_symmetric(camera),
    "where `distance` = 1": lambda camera, _: camera.distance == 1.0,
    "in square images": lambda _, size: size[0] == size[1],
}


def _correct_parts(task: CheckTask, cases: Cases, given: Any, wrong: Flags) -> Iterator[str]:
    """Yield a few sentences, the most helpful first."""
    right, rays = np.array([case.right for case in cases], float), np.asarray(given, float)
    broken = len(cases) - np.count_nonzero(np.isfinite(rays).all(axis=(1, 2)))
    if broken:
        yield f"{broken} of {len(cases)} rays have NaN or inf: look for a division by 0."
        return
    if np.ptp(rays, axis=0).max() == 0:
        yield "All your rays are the same: they do not depend on i and j."
        return

    def are_all_right(origins: Any, directions: Any) -> bool:
        made = np.stack([origins, directions], axis=1)
        return bool(are_right(cases, made, task.conventions.unit).all())

    if are_all_right(rays[:, 0], right[:, 1]):
        yield "Your origins are correct, your directions are not."
    elif are_all_right(right[:, 0], rays[:, 1]):
        yield "Your directions are correct, your origins are not."
    images: dict[Any, bool] = {}  # True if all rays of an image are correct
    for case, is_wrong in zip(cases, wrong, strict=True):
        image = case.camera, case.size
        images[image] = images.get(image, True) and not is_wrong
    found = [
        place
        for place, is_there in PLACES.items()
        if all(is_there(*image) == is_correct for image, is_correct in images.items())
    ]
    if found and any(images.values()):
        yield f"Your rays are correct {' and '.join(found)}, and wrong elsewhere."
