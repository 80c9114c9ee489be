"""The options of the cost plot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from lucida.app.state.bounds import OptionPart


@dataclass(frozen=True)
class CostOptions(OptionPart):
    """against: the horizontal axis, which is what grows."""

    against: Literal["triangles", "pixels"] = "triangles"
