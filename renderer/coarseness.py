"""The coarseness of images in motion: as fine as a frame has time for, and the same in all frames.

A device that is quick enough never draws a coarse image.

Within a motion the factor stays: an image that alternates between sharp and blurred is worse than
one that is a little coarser than necessary. It becomes coarser only if it proves too slow, and
finer if it proves quick enough. Once it has been too slow, it does not become finer again.
"""

from __future__ import annotations

FACTORS = (1, 2, 3, 4, 6, 8)  # image pixels a side that one coarse pixel stands for
STILL_S = 0.25  # a change later than this after the last one begins another motion
TOO_SLOW = 2.0  # times the budget ...
MOST_MISSES = 5  # ... so many times in a row: coarser
MOST_HITS = 8  # finer ones would have met the budget so many times in a row: finer
FRAMES = 2.5  # of the motion, without a change, before a full image


def reduced(size: tuple[int, int], factor: int) -> tuple[int, int]:
    """Return the size of an image that is `factor` times coarser, at least 1 x 1."""
    return max(1, -(-size[0] // factor)), max(1, -(-size[1] // factor))


class Coarseness:
    """The choice of the factor, from measured times.

    budget_s: the time for an image of a motion. once_s: the time for the first one, which is often
    the only one: nothing else had to be drawn before it. coarsest, unknown: the largest factor, and
    the one before anything was measured.
    """

    def __init__(
        self, budget_s: float, once_s: float, coarsest: int = FACTORS[-1], unknown: int = 1
    ) -> None:
        self._budget_s, self._once_s = budget_s, once_s
        self._factors = tuple(factor for factor in FACTORS if factor <= coarsest)
        self._unknown = unknown
        self._pixel_s: dict[int, float] = {}  # by factor
        self._changed_s = -STILL_S
        self._interval_s = STILL_S
        self._changes = 0  # of this motion
        self._pixels = 0
        self._misses = self._hits = 0  # in a row
        self._was_slow = False  # in this motion
        self._factor = unknown

    def changed(self, pixels: int, now_s: float) -> int:
        """Return the factor for an image of something that has changed now.

        pixels: of the full image; another number begins another motion.
        """
        self._interval_s = now_s - self._changed_s
        self._changed_s = now_s
        goes_on = self._interval_s < STILL_S and pixels == self._pixels
        self._changes, self._pixels = self._changes + 1 if goes_on else 0, pixels
        if self._changes < 2:
            budget_s = self._budget_s if self._changes else self._once_s
            self._factor, self._was_slow = self._finest(pixels, budget_s), False
            self._misses = self._hits = 0
        elif self._misses >= MOST_MISSES:
            self._step(1)
            self._was_slow = True
        elif self._hits >= MOST_HITS and not self._was_slow:
            self._step(-1)
        return self._factor

    def measured(self, factor: int, pixels: int, time_s: float) -> None:
        """Record that an image of this many pixels, at a factor, took this long."""
        pixel_s = time_s / max(pixels, 1)
        last_s = self._pixel_s.get(factor)
        # Something else may have had the processor, or a driver has compiled: the least counts.
        if last_s is not None and pixel_s > last_s:
            pixel_s = (last_s + pixel_s) / 2
        self._pixel_s[factor] = pixel_s
        if factor != self._factor:
            return
        self._misses = self._misses + 1 if time_s > TOO_SLOW * self._budget_s else 0
        finer = self._factors[max(self._factors.index(factor) - 1, 0)]
        within = finer < factor and time_s * (factor / finer) ** 2 <= self._budget_s
        self._hits = self._hits + 1 if within else 0

    def forget(self) -> None:
        """Drop all measurements, because something else will be drawn."""
        self._pixel_s.clear()

    @property
    def rest_s(self) -> float:
        """Return how long to wait for another change before a full image: a few frames of the
        motion.

        Zero after a single change.
        """
        return min(FRAMES * self._interval_s, STILL_S) if self._changes else 0.0

    def full_s(self, pixels: int) -> float:
        """Return the expected time of a full image; 0 if unknown."""
        return self._expected_s(1, pixels)

    def _finest(self, pixels: int, budget_s: float) -> int:
        if not self._pixel_s:
            return self._unknown
        for factor in self._factors:
            if self._expected_s(factor, pixels) <= budget_s:
                return factor
        return self._factors[-1]

    def _expected_s(self, factor: int, pixels: int) -> float:
        """Return the expected time, from the nearest factor that was measured; 0 if there is none.

        Of two equally near factors, use the finer one, whose time depends more on its pixels.
        """
        if not self._pixel_s:
            return 0.0
        place = FACTORS.index(factor)
        nearest = min(sorted(self._pixel_s), key=lambda known: abs(FACTORS.index(known) - place))
        return self._pixel_s[nearest] * pixels / factor**2

    def _step(self, step: int) -> None:
        place = self._factors.index(self._factor) + step
        self._factor = self._factors[min(max(place, 0), len(self._factors) - 1)]
        self._misses = self._hits = 0
