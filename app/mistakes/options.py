"""Which wrong lines are shown, and which question is asked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost, OneOf, Range

Mode = Literal["laboratory", "which-line", "which-picture"]
Count = Annotated[int, Range(0, 1_000_000)]

COLUMNS = (8, 16, 32, 64, 160, 320)


@dataclass(frozen=True)
class MistakesOptions:
    """mode: wrong lines to switch on; or the quiz: which of four lines made a picture, or which of
    four pictures a line makes. Mistakes have their names in app/checking/mistakes/; those that the
    camera's projection does not have are passed over.

    chosen: those that are on. difference: whether a picture of what they change is shown. columns:
    of each picture, in pixels.

    asked: the mistake that the question is about; empty: one that seed draws, as it draws the other
    three. names: all four, once they were answered: the question then stays, whatever the camera.
    answer: the name that was answered, or empty. revealed: whether the right one is told. score:
    how many answers were right, and how many there were.
    """

    mode: Mode = "laboratory"
    chosen: Annotated[tuple[str, ...], AtMost(2)] = ("rows count upwards",)
    difference: bool = True
    columns: Annotated[int, OneOf(COLUMNS)] = 160
    asked: str = ""
    seed: Count = 1
    names: Annotated[tuple[str, ...], AtMost(4)] = ()
    answer: str = ""
    revealed: bool = False
    score: tuple[Count, Count] = (0, 0)


OPTIONS = MistakesOptions
