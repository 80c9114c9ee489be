"""The explanation of wrong answers: the mistakes that reproduce them, or what else is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from app.checking.mistakes.program import Mistakes, Program
from renderer.camera import Camera

Told = dict[str, tuple[Program, tuple[Mistakes, ...]]]  # by projection

NAMED = 3  # candidates named; more would not help


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """The explanation of wrong answers.

    sentences: in the lecture's words, the most helpful first.
    candidates: the mistakes, one or two at once, that all fit the numbers; () if there are none.
    differences: of the fitted camera from the required one, in words.
    camera: the fitted camera of the first wrong case; None if the rays belong to no camera.
    first: the number of that case.
    """

    sentences: tuple[str, ...]
    candidates: tuple[Mistakes, ...] = ()
    differences: tuple[str, ...] = ()
    camera: Camera | None = None
    first: int = 0


def candidate_sentences(program: Program, found: Sequence[Mistakes]) -> list[str]:
    """Return the hints of the first candidate, the lines that it amounts to, the other candidates'
    hints, and what to read again.
    """
    first = found[0]
    sentences = ["Two mistakes at once." if len(first) == 2 else ""]
    sentences += list(dict.fromkeys(mistake.hint for mistake in first))
    for line in program.text(first):
        if line.instead is not None:
            written = " and ".join(f"`{code.strip()}`" for code in line.instead.split("\n"))
            sentences.append(f"As if it read {written}, not `{line.code.strip()}`.")
    told = set(sentences)
    for others in found[1:NAMED]:
        hint = " ".join(mistake.hint for mistake in others)
        if hint not in told:
            told.add(hint)
            sentences.append(f"Or, with the same numbers: {hint}")
    if len(found) > NAMED:
        sentences.append(f"{len(found) - NAMED} more mistakes would give the same numbers.")
    parts = dict.fromkeys(mistake.part for mistake in first)
    sentences.append(f"Read again: {', '.join(parts)}.")
    return [sentence for sentence in sentences if sentence]


def shared(told: Told) -> Told:
    """Keep only the mistakes that explain both projections by the same name, if both are wrong and
    there are such mistakes.
    """
    if len(told) < 2:
        return told
    names = [{_names(one) for one in found} for _, found in told.values()]
    shared = set.intersection(*names)
    if not shared:
        return told
    return {
        kind: (program, tuple(one for one in found if _names(one) in shared))
        for kind, (program, found) in told.items()
    }


def _names(mistakes: Mistakes) -> tuple[str, ...]:
    return tuple(mistake.name for mistake in mistakes)


def told_sentences(told: Told, kinds: int) -> list[str]:
    """Return sentences on each projection's candidates; common ones only once. kinds: the number of
    projections in the task.
    """
    sentences: list[str] = []
    seen: set[tuple[tuple[str, ...], ...]] = set()
    for kind, (program, found) in told.items():
        names = tuple(_names(one) for one in found)
        if not found or names in seen:
            continue
        seen.add(names)
        if kinds > 1 and (len(told) == 1 or any(names != _all_names(t) for t in told.values())):
            place = "In perspective" if kind == "perspective" else "In parallel projection"
            sentences.append(f"{place}:")
        sentences += candidate_sentences(program, found)
    return sentences


def _all_names(told: tuple[Program, tuple[Mistakes, ...]]) -> tuple[tuple[str, ...], ...]:
    return tuple(_names(one) for one in told[1])
