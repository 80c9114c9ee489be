"""The options of the mistakes laboratory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from lucida.app.state.bounds import AtMost, OneOf, OptionPart


@dataclass(frozen=True)
class MistakesOptions(OptionPart):
    """The options of the mistakes laboratory.

    chosen: the names of the mistakes that are on, as in app/checking/mistakes/. A mistake that the
    camera's projection does not have is skipped.
    difference: show a picture of the pixels that the mistakes change.
    columns: the width of each picture, in pixels.
    """

    chosen: Annotated[tuple[str, ...], AtMost(2)] = ("rows count upwards",)
    difference: bool = True
    columns: Annotated[int, OneOf((8, 16, 32, 64, 160, 320))] = 160
