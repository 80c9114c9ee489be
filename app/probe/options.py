"""What the probe keeps at hand, and shows outside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost
from app.state.options import Pixel


@dataclass(frozen=True)
class ProbeOptions:
    """The pixel probe. pins: pixels that are kept at hand. rays: which viewing rays the outside
    view shows beside the marked pixel's: none, or those of its row or column."""

    pins: Annotated[tuple[Pixel, ...], AtMost(256)] = ()
    rays: Literal["pixel", "row", "column"] = "pixel"


OPTIONS = ProbeOptions
