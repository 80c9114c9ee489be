"""The coarseness of images in motion, chosen from the times of the last ones.

The factor rarely changes within a motion, because an image that alternates between sharp and
blurred is worse than one that is a little coarser than necessary. It becomes coarser only if it
proves too slow, and finer if it proves quick enough. Once it has been too slow, it does not become
finer again.
"""

from __future__ import annotations

FACTORS = (1, 2, 4, 8)  # image pixels along a side of a coarse pixel
STILL_S = 0.2  # after the last change, images are full, and the next change begins a new motion
TOO_SLOW = 2.0  # times the budget; slower images are misses
MOST_MISSES = 4  # in a row, before images become coarser
MOST_HITS = 8  # in a row that finer images would have met, before images become finer


def reduced(size: tuple[int, int], factor: int) -> tuple[int, int]:
    """Return the size of an image that is `factor` times coarser, at least 1 x 1."""
    return max(1, -(-size[0] // factor)), max(1, -(-size[1] // factor))


class Coarseness:
    """The choice of the factor.

    budget_s: the time for an image in motion. unknown: the factor before any measurement.
    """

    def __init__(self, budget_s: float, unknown: int = 1) -> None:
        self._budget_s, self._unknown = budget_s, unknown
        self._pixel_s: dict[int, float] = {}  # by factor
        self._changed_s = -STILL_S
        self._misses = self._hits = 0  # in a row
        self._was_slow = False  # in this motion
        self._factor = unknown

    def changed(self, pixels: int, now_s: float) -> int:
        """Return the factor for an image after a change.

        pixels: of the full image.
        """
        if now_s - self._changed_s >= STILL_S:
            self._factor, self._was_slow = self._finest(pixels), False
            self._misses = self._hits = 0
        elif self._misses >= MOST_MISSES:
            self._step(1)
            self._was_slow = True
        elif self._hits >= MOST_HITS and not self._was_slow:
            self._step(-1)
        self._changed_s = now_s
        return self._factor

    def measured(self, factor: int, pixels: int, time_s: float) -> None:
        """Record that an image of this many pixels, at a factor, took this long."""
        pixel_s = time_s / max(pixels, 1)
        last_s = self._pixel_s.get(factor, pixel_s)
        # A longer time counts half, because another process may have had the processor.
        self._pixel_s[factor] = min(pixel_s, (last_s + pixel_s) / 2)
        if factor == self._factor:
            self._misses = self._misses + 1 if time_s > TOO_SLOW * self._budget_s else 0
            self._hits = self._hits + 1 if 4 * time_s <= self._budget_s else 0

    def forget(self) -> None:
        """Drop all measurements, because the content will change."""
        self._pixel_s.clear()

    def _finest(self, pixels: int) -> int:
        """Return the finest factor expected to meet the budget."""
        if not self._pixel_s:
            return self._unknown
        within = (one for one in FACTORS if self._expected_s(one, pixels) <= self._budget_s)
        return next(within, FACTORS[-1])

    def _expected_s(self, factor: int, pixels: int) -> float:
        """Return the expected time, from the nearest factor that was measured.

        Of two equally near factors, use the finer one, whose time depends more on its pixels.
        """
        place = FACTORS.index(factor)
        nearest = min(sorted(self._pixel_s), key=lambda known: abs(FACTORS.index(known) - place))
        return self._pixel_s[nearest] * pixels / factor**2

    def _step(self, step: int) -> None:
        place = FACTORS.index(self._factor) + step
        self._factor = FACTORS[min(max(place, 0), len(FACTORS) - 1)]
        self._misses = self._hits = 0
