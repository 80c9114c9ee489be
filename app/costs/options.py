"""The options of the cost plot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Range


@dataclass(frozen=True)
class CostOptions:
    """The cost plot. against: what the times are plotted against. triangles, pixels: of the image
    that is measured; the one that they are plotted against grows."""

    against: Literal["frames", "triangles", "pixels"] = "frames"
    triangles: Annotated[int, Range(18, 1_000_000)] = 10_000
    pixels: Annotated[int, Range(64, 1 << 22)] = 76_800


OPTIONS = CostOptions
