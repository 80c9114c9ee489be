"""A picture that is drawn in steps: all at once, or one a frame while things move and it is slow.

Owns how far it is, and what it has taken. Knows nothing of what is drawn. A GPU does all steps in a
part of a frame; where OpenGL runs on the CPU they take the time of several, and what the user has
in hand would follow as slowly.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator

SLOW_S = 0.004  # all steps, in a motion: what takes longer is divided among frames
STILL_S = 0.25  # a change later than this after the last one begins another motion
AT_ONCE = 2  # changes of a motion that are drawn at once: often there are no more


class Portions:
    """Used once a frame. clock: in seconds. behind: whether the picture is not of now."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._steps: Iterator[None] | None = None
        self._fixed: Hashable = None  # what they draw, or have drawn
        self._moving: Hashable = None
        self._shown: Hashable = None  # the `fixed` of the picture that is there
        self._seen: Hashable = None  # the `moving` of the frame before
        self._changed_s = -STILL_S
        self._changes = 0  # of this motion, after the first
        self._took_s = self._taking_s = 0.0
        self._taken = 0
        self.behind = False

    def go_on(
        self,
        fixed: Hashable,
        moving: Hashable,
        begin: Callable[[], Iterator[None]],
        at_once: bool = False,
    ) -> None:
        """Draw everything, or the next step.

        fixed, moving: what the picture depends on; a picture with a new `fixed` is never divided.
        begin: returns the steps for the present state, none if there is nothing to draw. at_once:
        do not divide.
        """
        now_s = self._clock()
        if moving != self._seen:
            self._changes = self._changes + 1 if now_s - self._changed_s < STILL_S else 0
            self._seen, self._changed_s = moving, now_s
        moves = self._changes >= AT_ONCE and now_s - self._changed_s < STILL_S
        is_slow = moves and self._took_s > SLOW_S
        divided = is_slow and not at_once and fixed == self._shown
        steps, self._steps = self._steps, None  # a failure ends them
        if steps is None or not divided or fixed != self._fixed:
            steps, self._taking_s, self._taken = begin(), 0.0, 0
            self._fixed, self._moving = fixed, moving
        is_over = True
        for _ in steps:
            self._taken += 1
            if divided:
                self._steps, is_over = steps, False
                break
        self._taking_s += self._clock() - now_s
        if is_over:
            self._shown = fixed
            if self._taken:
                self._measured(self._taking_s)
        self.behind = not is_over or self._moving != moving

    def _measured(self, time_s: float) -> None:
        # Something else may have had the processor: the least counts.
        slower = self._took_s > 0 and time_s > self._took_s
        self._took_s = (self._took_s + time_s) / 2 if slower else time_s

    def forget(self) -> None:
        """Forget the picture: it is gone."""
        self._steps = self._fixed = self._shown = None
        self.behind = False
