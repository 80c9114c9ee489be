"""Which photograph is laid over the images, and how."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Beside, Range

Lay = Literal["over", "behind"]


@dataclass(frozen=True)
class PhotographOptions:
    """file: of the photograph, an absolute path, as app.storage.paths.stored() writes it, "" for
    none; in a lecture a file beside the lecture's. shown: whether the images have it. lay: over
    all of an image, or behind it, which is where nothing is hit. opacity: from 0 to 1, of display
    values. follows: it is the one of the pose that is taken, whichever that will be.
    """

    file: Annotated[str, Beside(("",))] = ""
    shown: bool = True
    lay: Lay = "over"
    opacity: Annotated[float, Range(0, 1)] = 0.5
    follows: bool = False


OPTIONS = PhotographOptions
