"""The options of the view "Poses": the open set, the selected camera, and the set's display."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from lucida.app.state.bounds import Beside, OptionPart, Range


@dataclass(frozen=True)
class PosesOptions(OptionPart):
    """The options of the view "Poses".

    file: the set's absolute path, as stored() of state/paths.py writes it, "" for none; in a
    lecture, a file or folder next to the lecture's.
    pose: the number of the selected camera, from 0; -1 for none.
    points: draw a reconstruction's points.
    reprojected: draw them on the photographs.
    """

    file: Annotated[str, Beside(("",))] = ""
    pose: Annotated[int, Range(-1, 10_000_000)] = -1
    points: bool = True
    reprojected: bool = False
