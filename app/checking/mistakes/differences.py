"""Differences between a fitted camera and the required one, parameter by parameter, in words.

The same rays can be described in two ways: by another basis with the required viewport, or by the
same basis with another viewport and distance. The shorter description is used. It must hold for
every camera tried: "your d is 1", not "your d is 0.5 d" if that is true of only one.
"""

from __future__ import annotations

from collections.abc import Sequence

from app.checking.mistakes.as_basis import as_basis
from app.checking.mistakes.as_viewport import as_viewport
from app.checking.mistakes.difference import Difference, Fit, Told

NUMBERS_WEIGH = 3  # weight of a difference in one camera's numbers; one in words weighs 1


def told_differences(fits: Sequence[Fit]) -> tuple[str, ...]:
    """Return the differences that all of these cameras have; empty if there are none."""
    if any(fit.rays.is_parallel != fit.asked.is_parallel for fit in fits):
        kind = "parallel" if fits[0].rays.is_parallel else "in perspective"
        return (f"your rays are {kind}",)
    ways = [_common([_least(list(as_basis(fit))) for fit in fits])]
    viewports = [_least(list(as_viewport(fit))) for fit in fits]
    if all(told is not None for told in viewports):
        ways.append(_common(viewports))
    _, sentences = min(ways, key=lambda way: way[0])
    return sentences


def _common(told: Sequence[Told | None]) -> tuple[int, tuple[str, ...]]:
    """Return the weight of what holds for all cameras, and one sentence for each topic."""
    of_topic: dict[str, list[Difference]] = {}
    for differences in told:
        for difference in differences or ():
            of_topic.setdefault(difference.topic, []).append(difference)
    weight, sentences = 0, []
    for found in of_topic.values():
        shared = [
            saying
            for saying in found[0].sayings
            if all(saying in other.sayings for other in found[1:])
        ]
        weight += 1 if shared else NUMBERS_WEIGH
        sentences.append(shared[0] if shared else found[0].numbers)
    return weight, tuple(sentences)


def _least(ways: Sequence[Told]) -> Told | None:
    """Return the shortest description of one camera, over the possible lengths of its directions.
    Among equally short ones, prefer one with a cause.
    """
    return min(
        ways,
        key=lambda told: (
            sum(1 if one.sayings else NUMBERS_WEIGH for one in told),
            not any("as if" in saying for one in told for saying in one.sayings),
        ),
        default=None,
    )
