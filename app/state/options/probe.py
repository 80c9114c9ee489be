"""The options of the probe: the pins, and the part that is shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import AtMost, OptionPart
from app.state.options.shared import Pixel

Section = Literal["all", "ray", "objects", "hit", "colour"]


@dataclass(frozen=True)
class ProbeOptions(OptionPart):
    """The options of the probe.

    pins: pixels to compare.
    section: the part of the reading that is shown.
    """

    pins: Annotated[tuple[Pixel, ...], AtMost(256)] = ()
    section: Section = "all"
