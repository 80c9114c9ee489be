"""The duration of calls, which take turns, so that a slow machine slows all of them alike.

Owns the stopwatch. Knows nothing of what is called, and in which process.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

Call = Callable[[], object]
Stopwatch = Callable[[Call], float]
Turn = Callable[[], tuple[float, ...]]  # the seconds of each of its calls


@dataclass(frozen=True)
class Timing:
    """The seconds that a call took: in each turn, the median of its calls."""

    samples_s: tuple[float, ...]

    @property
    def median_s(self) -> float:
        return float(np.median(self.samples_s))

    @property
    def low_s(self) -> float:
        """The lower quartile."""
        return float(np.quantile(self.samples_s, 0.25))

    @property
    def high_s(self) -> float:
        """The upper quartile."""
        return float(np.quantile(self.samples_s, 0.75))

    def numbers(self) -> dict[str, float | int]:
        """For the JSON file."""
        return {
            "median_s": self.median_s,
            "low_s": self.low_s,
            "high_s": self.high_s,
            "min_s": min(self.samples_s),
            "max_s": max(self.samples_s),
            "samples": len(self.samples_s),
        }


@dataclass(frozen=True)
class Plan:
    """rounds: how often each call has its turn. pause_s: before each turn nothing is called, as
    before a viewer's images; by then the threads of the one before sleep (Mitsuba's wait at work
    for about 10 ms). repeats: calls in a turn, of which the median counts; slow_s: a
    call that takes longer is called once a turn. budget_s: no new round after that long, once
    there were least_rounds."""

    rounds: int = 9
    pause_s: float = 0.02
    repeats: int = 3
    slow_s: float = 0.15
    budget_s: float = 12.0
    least_rounds: int = 3


QUICK = Plan(rounds=3, budget_s=1.5, least_rounds=2)


def seconds(call: Call) -> float:
    """Return the time of one call; its result is freed after the watch has stopped."""
    start = time.perf_counter()
    result = call()
    elapsed = time.perf_counter() - start
    del result
    return elapsed


def processor_seconds(call: Call) -> float:
    """Return the processor time of one call, on all threads of this process."""
    start = time.process_time()
    result = call()
    elapsed = time.process_time() - start
    del result
    return elapsed


def turn(call: Call, plan: Plan, stopwatch: Stopwatch = seconds) -> tuple[float, ...]:
    """One turn of a call: the pause, then the times of its calls."""
    time.sleep(plan.pause_s)
    collecting = gc.isenabled()
    gc.disable()
    try:
        times = [stopwatch(call)]
        while len(times) < plan.repeats and times[0] <= plan.slow_s:
            times.append(stopwatch(call))
    finally:
        if collecting:
            gc.enable()
    return tuple(times)


def interleaved(turns: Mapping[str, Turn], plan: Plan) -> dict[str, Timing]:
    """Times of all calls: round after round, each has one turn. The first round does not count:
    what is called for the first time may compile."""
    taken: dict[str, list[tuple[float, ...]]] = {name: [] for name in turns}
    for own in turns.values():
        own()
    start = time.perf_counter()
    for done in range(plan.rounds):
        if done >= plan.least_rounds and time.perf_counter() - start > plan.budget_s:
            break
        for name, own in turns.items():
            taken[name].append(own())
    return {
        name: Timing(tuple(float(np.median(times)) for times in own)) for name, own in taken.items()
    }
