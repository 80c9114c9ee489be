"""The options of the photograph: the file, and its display over the images."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from lucida.app.state.bounds import Beside, OptionPart, Range


@dataclass(frozen=True)
class PhotographOptions(OptionPart):
    """The options of the photograph.

    file: the photograph's absolute path, as stored() of state/paths.py writes it, "" for none; in a
    lecture, a file next to the lecture's.
    shown: draw it in the images.
    opacity: from 0 to 1, applied to display values.
    follows: show the photograph of the current pose.
    """

    file: Annotated[str, Beside(("",))] = ""
    shown: bool = True
    opacity: Annotated[float, Range(0, 1)] = 0.5
    follows: bool = False
