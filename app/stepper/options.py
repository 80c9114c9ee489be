"""The options of the loop stepper: the runs, and the step of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Range

Step = Annotated[int, Range(0, 1_000_000)]  # of a run


@dataclass(frozen=True)
class StepperOptions:
    """The options of the loop stepper.

    canvas: (width, height).
    order: the visible algorithms.
    steps: of the run in object order, and of the one in image order; a step past the end is the
    last.
    speed: steps per second while it plays.
    """

    canvas: tuple[Annotated[int, Range(1, 64)], Annotated[int, Range(1, 48)]] = (16, 12)
    order: Literal["both", "object", "image"] = "both"
    steps: tuple[Step, Step] = (0, 0)
    speed: Annotated[float, Range(1, 20_000)] = 8.0


OPTIONS = StepperOptions
