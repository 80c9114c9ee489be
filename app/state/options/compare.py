"""The options of the compare view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from lucida.app.state.bounds import OptionPart, Range
from lucida.renderer.images.difference import LARGEST_GAIN

from .shared import Part

CompareMode = Literal["absolute", "wipe"]


@dataclass(frozen=True)
class CompareOptions(OptionPart):
    """The compare view.

    gain: the factor of the difference before it is coloured.
    divider: the wipe's place, as a fraction of the image's width.
    rise: the fraction of its side of the wipe on which the ray image covers the raster image.
    causes: mark differing pixels in the colours of their causes.
    """

    mode: CompareMode = "absolute"
    gain: Annotated[float, Range(1, LARGEST_GAIN)] = 1.0
    divider: Part = 0.5
    rise: Part = 1.0
    causes: bool = True
