"""The options of the loop stepper: a lecture's picture, the runs, and the step of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from lucida.app.state.bounds import OptionPart, Range

Step = Annotated[int, Range(0, 1_000_000)]  # of a run

Runs = Annotated[float, Range(0, 8)]


@dataclass(frozen=True)
class StepperOptions(OptionPart):
    """The options of the loop stepper.

    picture: the picture in a lecture: the two loops in words; ray tracing in three lines, first at
    the marked pixel; the whole program; or its questions: an image, a frame, a ray.
    parts: the progress of the runs, in object order and in image order. A run begins after
    each whole number and is complete at the next. Ray tracing's lines are executed at the marked
    pixel up to 1, 2 and 3, and at the other pixels up to 4. The questions appear up to 1, 2 and 3.
    canvas: (width, height).
    steps: the step of the run in object order, and of the one in image order; a step past the end
    is the last.
    """

    picture: Literal["loops", "rays", "program", "questions"] = "loops"
    parts: tuple[Runs, Runs] = (0.0, 0.0)
    canvas: tuple[Annotated[int, Range(1, 64)], Annotated[int, Range(1, 48)]] = (16, 12)
    steps: tuple[Step, Step] = (0, 0)
