"""The options of the camera's panel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from lucida.app.state.bounds import AtMost, OptionPart

CameraPart = Literal[
    "projection", "eye", "basis", "d", "viewport", "More", "Lens", "K, R and t", "Look at"
]


@dataclass(frozen=True)
class CameraOptions(OptionPart):
    """The options of the camera's panel.

    shown: the parts that the panel shows, which a lecture's step can set; empty for all.
    """

    shown: Annotated[tuple[CameraPart, ...], AtMost(9)] = ()

    def shows(self, part: CameraPart) -> bool:
        return not self.shown or part in self.shown
