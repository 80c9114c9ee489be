"""Which matrix is looked at, and which of its readings was chosen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost

MOST_CHARACTERS = 8000


@dataclass(frozen=True)
class DetectiveOptions:
    """text: what was pasted, of which printed.py takes the numbers. pixel_origin: where integers
    stand, of a matrix that counts pixels. chosen: the name of the reading that was taken, as
    readings.py names it; "" for none.
    """

    text: Annotated[str, AtMost(MOST_CHARACTERS)] = ""
    pixel_origin: Literal["center", "corner"] = "center"
    chosen: Annotated[str, AtMost(200)] = ""


OPTIONS = DetectiveOptions
