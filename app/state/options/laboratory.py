"""The options of the image laboratory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from lucida.app.state.bounds import OptionPart, Range

from .shared import Part

LONGEST = 4.0  # the largest progress of all drawings


@dataclass(frozen=True)
class LaboratoryOptions(OptionPart):
    """The options of the image laboratory.

    page: the selected drawing.
    progress: the drawing's progress in builds: 0 is its first, 1 its second, 0.5 halfway.
    after_ev: the exposure, in stops, of images that have been stored.
    phase: the moment in the displays' cycles: 0 to 1 in the first, to 2 in the second.
    point: the point at which the light is read, as fractions of the image's width and height.
    """

    page: Literal[
        "function", "shapes", "projectors", "displays", "raster", "kinds", "exposure", "storage",
        "array", "devices", "dimension", "ruler",
    ] = "kinds"  # fmt: skip
    progress: Annotated[float, Range(0, LONGEST)] = 0.0
    after_ev: Annotated[float, Range(-6, 6)] = 0.0
    phase: Annotated[float, Range(0, 2)] = 0.0
    point: tuple[Part, Part] = (0.5, 0.5)
