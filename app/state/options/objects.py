"""The options for editing the scene: the selection and its handles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from lucida.app.state.bounds import AtMost, OptionPart, Range

MOST_CHOSEN = 1000
Key = Annotated[int, Range(0, 2**53)]
Handle = Literal["none", "move"]


@dataclass(frozen=True)
class ObjectsOptions(OptionPart):
    """The options for editing the scene.

    chosen: selected objects and lights by their keys (renderer/editing/), the last one last.
    selects: True if a click in a view selects an object instead of marking a pixel.
    handle: the kind of the selection's handles in the views.
    """

    chosen: Annotated[tuple[Key, ...], AtMost(MOST_CHOSEN)] = ()
    selects: bool = False
    handle: Handle = "move"
