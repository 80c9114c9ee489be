"""The options of the cost plot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class CostOptions:
    """against: the horizontal axis, which is what grows."""

    against: Literal["triangles", "pixels"] = "triangles"
