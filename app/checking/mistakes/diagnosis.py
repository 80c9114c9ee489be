"""The explanation of wrong answers: the mistakes that reproduce them, or what else is known."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.mistakes.candidates import Trial, candidates
from lucida.app.checking.mistakes.program import Mistakes, Program

# By projection: the program, and the mistakes that explain the answers.
Told = dict[str, tuple[Program, tuple[Mistakes, ...]]]

AS_IF = "As if it read"
NAMED = 3  # candidates named; more would not help


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """The explanation of wrong answers.

    sentences: in the lecture's words, the most helpful first.
    candidates: the mistakes, one or two at once, that all fit the numbers; () if there are none.
    """

    sentences: tuple[str, ...]
    candidates: tuple[Mistakes, ...] = ()


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
            sentences.append(f"{AS_IF} {written}, not `{line.code.strip()}`.")
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


def named(
    kinds: Sequence[str],
    wrong: NDArray[np.bool_],
    program_and_trial: Callable[[str, list[int]], tuple[Program, Trial]],
) -> tuple[list[str], tuple[Mistakes, ...], bool]:
    """Return sentences on the mistakes of each kind of cases that has wrong ones, the mistakes, and
    True if they explain every such kind.

    kinds: of each case.
    wrong: the wrong ones.
    program_and_trial: of a kind and the numbers of its cases.
    """
    told: Told = {}
    for kind in dict.fromkeys(kinds):
        chosen = [number for number, its in enumerate(kinds) if its == kind]
        if wrong[chosen].any():
            program, trial = program_and_trial(kind, chosen)
            told[kind] = program, candidates(program, trial, wrong[chosen])
    told = _shared(told)
    found = tuple(dict.fromkeys(one for _, its in told.values() for one in its))
    explained = all(its for _, its in told.values())
    return _sentences(told, len(set(kinds))), found, explained


def _shared(told: Told) -> Told:
    """Keep only the mistakes that explain both projections by the same name, if both are wrong and
    there are such mistakes.
    """
    if len(told) < 2:
        return told
    shared = set.intersection(*(set(_all_names(its)) for its in told.values()))
    if not shared:
        return told
    return {
        kind: (program, tuple(one for one in found if _names(one) in shared))
        for kind, (program, found) in told.items()
    }


def _names(mistakes: Mistakes) -> tuple[str, ...]:
    return tuple(mistake.name for mistake in mistakes)


def _sentences(told: Told, kinds: int) -> list[str]:
    """Return sentences on each projection's candidates; common ones only once. kinds: the number of
    projections in the task.
    """
    sentences: list[str] = []
    every = {kind: _all_names(its) for kind, its in told.items()}
    seen: list[Any] = [()]
    for kind, (program, found) in told.items():
        if every[kind] in seen:
            continue
        seen.append(every[kind])
        if kinds > 1 and (len(told) == 1 or len(set(every.values())) > 1):
            place = "In perspective" if kind == "perspective" else "In parallel projection"
            sentences.append(f"{place}:")
        sentences += candidate_sentences(program, found)
    return sentences


def _all_names(told: tuple[Program, tuple[Mistakes, ...]]) -> tuple[tuple[str, ...], ...]:
    return tuple(_names(one) for one in told[1])
