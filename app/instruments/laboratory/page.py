"""The data that a page of the laboratory draws."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.state.options.laboratory import LaboratoryOptions
from lucida.renderer.camera.image_plane import Size

from .sheet import Look, Point, Sheet

Image = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Page:
    """The input of a drawing.

    size: the sheet's size in pixels. color: the image, (height, width, 3), linear; empty if the
    drawing shows none. taken_ev: its exposure in stops. place: the position that is read, as
    fractions of the image's width and height.
    """

    size: Size
    look: Look
    options: LaboratoryOptions
    color: Image
    taken_ev: float
    place: Point

    @property
    def progress(self) -> float:
        return self.options.progress

    def sheet(self, extent: Point, low: ArrayLike = (0.0, 0.0)) -> Sheet:
        return Sheet(self.size, self.look, extent, low)

    @property
    def is_wide(self) -> bool:
        return is_wide(self.size)


def is_wide(size: Size) -> bool:
    """Return True if two pictures are larger side by side than one above the other."""
    return size[0] >= 1.15 * size[1]
