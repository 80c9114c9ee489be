"""The options of the probe: the pins, and the rays in the outside view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost
from app.state.options import Pixel


@dataclass(frozen=True)
class ProbeOptions:
    """The options of the probe.

    pins: pixels to compare.
    rays: viewing rays in the outside view in addition to the marked pixel's: none, or those of its
    row or column.
    section: the part of the reading that is shown.
    """

    pins: Annotated[tuple[Pixel, ...], AtMost(256)] = ()
    rays: Literal["pixel", "row", "column"] = "pixel"
    section: Literal["all", "ray", "objects", "hit", "colour"] = "all"


OPTIONS = ProbeOptions
