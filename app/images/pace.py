"""The coarseness of both images while anything moves: one factor for both."""

from __future__ import annotations

import time

from lucida.renderer.images.coarseness import STILL_S, Coarseness

from .request import ImageRequest

BUDGET_S = 1 / 60  # for both images, while anything moves


class Pace:
    """The newest request, and the coarseness that follows from the time of the last images.

    smooth: images in motion may be coarse; otherwise they are always full.
    """

    def __init__(self, smooth: bool) -> None:
        self._smooth = smooth
        self._coarseness = Coarseness(BUDGET_S)
        self._factor = 1
        self._newest: ImageRequest | None = None
        self._changed_s = -STILL_S
        self._measured = 1, 0.0

    @property
    def rests(self) -> bool:
        """True if nothing has changed for a while."""
        return not self._smooth or time.monotonic() - self._changed_s >= STILL_S

    def factor_of(self, request: ImageRequest) -> int:
        """Return the coarseness of the newest request's images, 1 when it rests."""
        before = self._newest
        if request != before:
            self._newest, now_s = request, time.monotonic()
            if before is None or not before.has_scene_of(request):
                self._coarseness.forget()  # a new scene, not motion
            else:
                self._changed_s = now_s
                self._factor = self._coarseness.changed(request.size[0] * request.size[1], now_s)
        return 1 if self.rests else self._factor

    def measured(self, factor: int, pixels: int, time_s: float) -> None:
        """Record the time that images of this many pixels took; each time is recorded once."""
        if time_s > 0 and (factor, time_s) != self._measured:
            self._measured = factor, time_s
            self._coarseness.measured(factor, pixels, time_s)
