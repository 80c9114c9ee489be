"""The quiz: a mistake and three others whose pictures differ, drawn for a scene and a camera.

Pure. What is drawn depends on the seed alone, on what the camera can tell apart, and on the table
of mistakes.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.program import Mistake, Program
from app.images.ray_pictures import RayPainter
from app.instruments.mistakes.model import Bytes, Light, Situation, rays_of, shown
from app.state.options.mistakes import MistakesOptions, Mode

CHOICES = 4
LETTERS = "ABCD"
ACROSS = 20  # places in a row of a picture, whose means are compared: edges alone are no difference
CLEAR, PART = 20, 0.1  # of 255, and of the places: pictures that differ so much look different
LONGEST = 62  # letters: longer lines are not asked for
TRIED = 24  # mistakes whose pictures are made to find four


@dataclass(frozen=True, eq=False)
class QuizQuestion:
    """names: of the four mistakes, in the order of the letters. right_at: which of them it is.
    right, pictures: linear light (H, W, 3), without a mistake and of each. problem: why there is no
    question, or empty."""

    names: tuple[str, ...]
    right_at: int
    right: Light
    pictures: tuple[Light, ...]
    problem: str = ""


def right_at(options: MistakesOptions) -> int:
    """Return the position of the correct answer among the four."""
    return random.Random(options.seed).randrange(CHOICES)


def question(
    painter: RayPainter, now: Situation, options: MistakesOptions, names: tuple[str, ...] = ()
) -> QuizQuestion:
    """Return the question of these options. Runs on a thread.

    names: of a question that stays; otherwise it is drawn by the seed.
    """
    program = now.program
    by_name = {mistake.name: mistake for mistake in program.mistakes}
    right = painter.picture(*rays_of(now, ()), now.camera.t_range)

    def picture(mistake: Mistake) -> Light:
        return painter.picture(*rays_of(now, (mistake,)), now.camera.t_range)

    if len(names) == CHOICES and all(name in by_name for name in names):
        pictures = tuple(picture(by_name[name]) for name in names)
        return QuizQuestion(names, right_at(options), right, pictures)
    return _drawn(program, options, right, picture)


def _drawn(
    program: Program, options: MistakesOptions, right: Light, picture: Callable[[Mistake], Light]
) -> QuizQuestion:
    asked = [mistake for mistake in program.mistakes if mistake.name == options.asked]
    usual = [one for one in program.mistakes if one.is_common and _is_short(one)]
    others = [one for one in usual if one.name != options.asked]
    # The seed has drawn the place of the right one already: another one for the order.
    random.Random(f"{options.seed}").shuffle(others)
    kept: list[tuple[Mistake, Light]] = []
    seen = [shown(right, 0.0)]
    for number, mistake in enumerate([*asked, *others][:TRIED]):
        light = picture(mistake)
        look = shown(light, 0.0)
        is_asked = bool(asked) and number == 0
        if all(are_apart(look, other) for other in seen) and (is_asked or not is_blank(look)):
            kept.append((mistake, light))
            seen.append(look)
        elif is_asked:
            problem = f'With this camera, "{options.asked}" makes the correct picture: move it.'
            return QuizQuestion((), 0, right, (), problem)
        if len(kept) == CHOICES:
            break
    else:
        problem = (
            "With this camera too few wrong lines make pictures that differ: move it, or take "
            "another scene."
        )
        return QuizQuestion((), 0, right, (), problem)
    at = right_at(options)
    kept.insert(at, kept.pop(0))
    names, pictures = zip(*((mistake.name, light) for mistake, light in kept), strict=True)
    return QuizQuestion(names, at, right, pictures)


def _is_short(mistake: Mistake) -> bool:
    return all(len(code) <= LONGEST for _, code in mistake.lines)


def are_apart(one: Bytes, other: Bytes) -> bool:
    """Return True if two displayed pictures of one size look different."""
    steps = np.abs(_places(one) - _places(other)).max(axis=2)
    return bool((steps > CLEAR).mean() >= PART)


def is_blank(picture: Bytes) -> bool:
    """Return True if nothing is visible in the picture."""
    return bool(np.ptp(_places(picture), axis=(0, 1)).max() <= CLEAR)


def _places(picture: Bytes) -> NDArray[np.float64]:
    """Return the means of the picture's squares; those that its edges cut are left out."""
    height, width = picture.shape[:2]
    side = max(1, min(height, width // ACROSS))
    rows, columns = height // side, width // side
    whole = picture[: rows * side, : columns * side].reshape(rows, side, columns, side, 3)
    return np.asarray(whole.mean(axis=(1, 3)))


def reason(program: Program, names: tuple[str, ...], at: int, answer: str) -> str:
    """Return the words after the answer. answer: the name that was given, or empty."""
    truth = next(mistake for mistake in program.mistakes if mistake.name == names[at])
    told = f"{LETTERS[at]}, {truth.name}. {truth.hint}"
    if answer == truth.name:
        return f"Correct: {told}"
    if answer in names:
        return f"Not {LETTERS[names.index(answer)]}, {answer}. It is {told}"
    return f"It is {told}"


def answered(options: MistakesOptions, names: tuple[str, ...], number: int) -> MistakesOptions:
    """Return the options after an answer; the same if the question is answered already."""
    if options.answer or options.revealed or not 0 <= number < len(names):
        return options
    right, count = options.score
    score = (right + (number == right_at(options)), count + 1)
    return replace(options, names=names, answer=names[number], revealed=True, score=score)


def revealed(options: MistakesOptions, names: tuple[str, ...]) -> MistakesOptions:
    """Reveal the correct answer, or hide it again if nobody has answered."""
    if options.answer or not names:
        return options
    return replace(options, names=names, revealed=not options.revealed)


def next_question(options: MistakesOptions, step: int = 1) -> MistakesOptions:
    """Ask another question. After a step's own question, any mistake may be asked for."""
    seed = (options.seed + step) % 1_000_000
    return replace(options, seed=seed, asked="", names=(), answer="", revealed=False)


def switched_to(options: MistakesOptions, mode: Mode) -> MistakesOptions:
    """Return the options in another mode. A quiz that was seen is followed by a new question,
    because each page of the quiz shows what the other one asks for.
    """
    if options.mode not in ("laboratory", mode):
        options = next_question(options)
    return replace(options, names=(), answer="", revealed=False, mode=mode)
