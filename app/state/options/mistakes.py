"""Which wrong lines are shown, and which question is asked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost, OneOf, OptionPart, Range

Mode = Literal["laboratory", "which-line", "which-picture"]
Count = Annotated[int, Range(0, 1_000_000)]


@dataclass(frozen=True)
class MistakesOptions(OptionPart):
    """mode: wrong lines to switch on; or the quiz: which of four lines made a picture, or which of
    four pictures a line makes. Names of mistakes are those of app/checking/mistakes/; those that
    the camera's projection does not have are skipped.

    chosen: the mistakes that are on. difference: show a picture of what they change. columns: of
    each picture, in pixels.

    asked: the mistake in question; empty for one that seed draws, as it draws the other three.
    names: all four once they were answered, so that the question stays whatever the camera does.
    answer: the name that was answered, or empty. revealed: show the correct one. score: the numbers
    of correct answers and of all.
    """

    mode: Mode = "laboratory"
    chosen: Annotated[tuple[str, ...], AtMost(2)] = ("rows count upwards",)
    difference: bool = True
    columns: Annotated[int, OneOf((8, 16, 32, 64, 160, 320))] = 160
    asked: str = ""
    seed: Count = 1
    names: Annotated[tuple[str, ...], AtMost(4)] = ()
    answer: str = ""
    revealed: bool = False
    score: tuple[Count, Count] = (0, 0)
