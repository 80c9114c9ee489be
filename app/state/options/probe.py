"""The options of the probe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from lucida.app.state.bounds import AtMost, OptionPart

from .shared import Pixel


@dataclass(frozen=True)
class ProbeOptions(OptionPart):
    """The options of the probe.

    pins: pixels to compare.
    """

    pins: Annotated[tuple[Pixel, ...], AtMost(256)] = ()
