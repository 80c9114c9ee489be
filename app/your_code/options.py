"""Which file is run, for which of whose tasks, on how many pixels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from app.state.bounds import AtMost, Beside, Range


@dataclass(frozen=True)
class YourCodeOptions:
    """The options of the view "Your code".

    file: an absolute path, as app.storage.paths.stored() writes it, "" for none; in a lecture one
    next to the lecture's file. tasks: that of a course's tasks, "" for the built-in ones. task: the
    name of the shown one; "" for the first whose function the file has. canvas: (width, height) of
    the pictures.
    """

    file: Annotated[str, Beside((".py",))] = ""
    tasks: Annotated[str, Beside((".toml",))] = ""
    task: Annotated[str, AtMost(64)] = ""
    canvas: tuple[Annotated[int, Range(1, 64)], Annotated[int, Range(1, 48)]] = (32, 24)


OPTIONS = YourCodeOptions
