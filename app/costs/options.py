"""The options of the cost plot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Range


@dataclass(frozen=True)
class CostOptions:
    """The options of the cost plot.

    against: the horizontal axis of the times.
    triangles, pixels: of the measured image; the one on the horizontal axis grows.
    recorded: show a recorded measurement, of a growing number of triangles.
    """

    against: Literal["frames", "triangles", "pixels"] = "frames"
    triangles: Annotated[int, Range(18, 1_000_000)] = 10_000
    pixels: Annotated[int, Range(64, 1 << 22)] = 76_800
    recorded: bool = False


OPTIONS = CostOptions
