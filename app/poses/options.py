"""Which set of cameras is open, which of them is chosen, how they are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from app.state.bounds import Beside, Range


@dataclass(frozen=True)
class PosesOptions:
    """The view "Poses". file: of the set, an absolute path, as app.storage.paths.stored() writes
    it, "" for none; in a lecture a file or folder beside the lecture's. pose: the number of the
    chosen one, from 0; -1: none. length: of the frusta, in what fits the set. points: whether a
    reconstruction's points are drawn. reprojected: whether they are drawn on the photographs.
    """

    file: Annotated[str, Beside(("",))] = ""
    pose: Annotated[int, Range(-1, 10_000_000)] = -1
    length: Annotated[float, Range(0.05, 20.0)] = 1.0
    points: bool = True
    reprojected: bool = False


OPTIONS = PosesOptions
