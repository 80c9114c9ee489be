"""The options of the detective: the matrix, and the selected reading."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost

MOST_CHARACTERS = 8000


@dataclass(frozen=True)
class DetectiveOptions:
    """The options of the detective.

    text: the pasted text, from which printed.py takes the numbers.
    pixel_origin: the place of integers, if a matrix counts pixels.
    chosen: the name of the selected reading, as in readings.py; "" for none.
    """

    text: Annotated[str, AtMost(MOST_CHARACTERS)] = ""
    pixel_origin: Literal["center", "corner"] = "center"
    chosen: Annotated[str, AtMost(200)] = ""


OPTIONS = DetectiveOptions
