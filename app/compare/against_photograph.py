"""The comparison of an image with the photograph: the photograph's side, the difference in numbers,
and the reason if there is none.

Both are compared as displayed: a photograph's exposure is unknown, and the image's can be adjusted
to it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.images.placement import Placement
from app.images.renderers import Renderers
from app.images.shown import Held, Picture
from app.photograph.layer import PhotographLayer
from app.state.app_state import AppState

ROWS = 64  # of the pictures, that are subtracted at a time


@dataclass(frozen=True)
class Against:
    """Two pictures of one size."""

    image: Picture
    photograph: Picture

    @property
    def held(self) -> tuple[Held, Held]:
        return self.image.held, self.photograph.held


class AgainstPhotograph:
    """An image against the photograph in a layer."""

    def __init__(self, layer: PhotographLayer) -> None:
        self._layer = layer
        self._numbers: tuple[tuple[Held, Held], tuple[float, int]] | None = None
        self._seen: Against | None = None

    def pictures(
        self, both: Renderers, state: AppState, image: Picture, placement: Placement
    ) -> Against | None:
        """Return an image's picture and the photograph's in its place; None while there is none.
        placement: all of the image.
        """
        self._seen = None
        if not self._layer.follow(both, state):
            return None
        photograph = self._layer.instead(both, state, image, placement)
        if photograph is image:
            return None
        self._seen = Against(image, photograph)
        return self._seen

    def headline(self, names: tuple[str, str], at_rest: bool) -> tuple[str, bool]:
        """Return the difference of the two in a line, and whether that is an error.

        at_rest: nothing is moved; only then is it measured again.
        """
        if self._layer.problem:
            return self._layer.problem, True
        seen = self._seen
        if seen is None:
            return "The photograph is being read: no difference yet", False
        if at_rest and (self._numbers is None or self._numbers[0] != seen.held):
            self._numbers = seen.held, differing(*seen.held)
        told = f"{names[0].capitalize()} image against photograph, as shown"
        if self._numbers is not None and self._numbers[0] == seen.held:
            rms, largest = self._numbers[1]
            told = f"{told}: RMS {rms:.2f}/255, max {largest}/255"
        return f"{told}. {self._layer.note}" if self._layer.note else told, False


def differing(first: Held, second: Held) -> tuple[float, int]:
    """Return the RMS and the largest difference of two pictures of one size, in 255ths, over the
    three colours.
    """
    width, height = first[0].size
    a, b = (
        np.frombuffer(texture.read(), np.uint8).reshape(height, width, 4)
        for texture, _ in (first, second)
    )
    squares, largest = 0.0, 0
    for top in range(0, height, ROWS):
        rows = slice(top, top + ROWS)
        difference = a[rows, :, :3].astype(np.int32) - b[rows, :, :3]
        squares += float(np.square(difference).sum())
        largest = max(largest, int(np.abs(difference).max()))
    return float(np.sqrt(squares / (3 * width * height))), largest
