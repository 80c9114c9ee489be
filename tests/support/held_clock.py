"""The passages' clock, held by a drive."""

from __future__ import annotations

from window_driver import Driver


class Clock:
    """s: what it says. It stands still, and passages take their time by it."""

    def __init__(self, d: Driver) -> None:
        self.s = 10.0
        d.window.motions.transition.now_s = lambda: self.s
        d.window.motions.transition.instant = False
