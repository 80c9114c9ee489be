"""The options of the view "Your code": the file and the size of the pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from lucida.app.state.bounds import Beside, OptionPart, Range


@dataclass(frozen=True)
class YourCodeOptions(OptionPart):
    """The options of the view "Your code".

    file: an absolute path, as stored() of state/paths.py writes it, "" for none; in a lecture, a
    file next to the lecture's own.
    canvas: (width, height) of the pictures.
    """

    file: Annotated[str, Beside((".py",))] = ""
    canvas: tuple[Annotated[int, Range(1, 64)], Annotated[int, Range(1, 48)]] = (32, 24)
