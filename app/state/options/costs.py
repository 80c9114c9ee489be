"""The options of the cost plot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from lucida.app.state.bounds import OptionPart


@dataclass(frozen=True)
class CostOptions(OptionPart):
    """against: the quantity on the horizontal axis."""

    against: Literal["triangles", "pixels"] = "triangles"
