"""What the loop stepper runs, and where both runs stand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Range

Step = Annotated[int, Range(0, 1_000_000)]  # of a run


@dataclass(frozen=True)
class StepperOptions:
    """The loop stepper. canvas: (width, height). order: which algorithms are shown. form: how
    object order is done: triangle by triangle, as graphics cards do it, or each object by its rays;
    a scene without triangles always by rays.

    steps: where the run in object order stands, and the one in image order; those that a run does
    not have are its last. speed: steps a second while it plays.
    """

    canvas: tuple[Annotated[int, Range(1, 64)], Annotated[int, Range(1, 48)]] = (16, 12)
    order: Literal["both", "object", "image"] = "both"
    form: Literal["triangles", "rays"] = "triangles"
    steps: tuple[Step, Step] = (0, 0)
    speed: Annotated[float, Range(1, 20_000)] = 8.0


OPTIONS = StepperOptions
