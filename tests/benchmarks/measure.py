"""How long calls take: taken in turns, so that whatever slows the machine slows them all alike.

Owns the stopwatch. Knows nothing of what is called.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

Call = Callable[[], object]


@dataclass(frozen=True)
class Timing:
    """The seconds that a call took, each time."""

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
    """rounds: how often each call has its turn. quiet_s: before each turn nothing is called:
    the threads of Embree, TBB, OpenBLAS and the like wait for more work for a while, at work
    themselves, and would keep a processor from the next (after trimesh's turn, 10 ms were too
    few: the next took 1.7 times as long). warm_s: how long a turn is not timed at first. repeats:
    timed calls in a turn, of fast calls; slow_s: a call that takes longer is timed once a turn.
    budget_s: no new round after that long, once there were least_rounds."""

    rounds: int = 9
    quiet_s: float = 0.08
    warm_s: float = 0.04
    repeats: int = 5
    slow_s: float = 0.15
    budget_s: float = 20.0
    least_rounds: int = 3


QUICK = Plan(rounds=3, repeats=2, budget_s=4.0, least_rounds=2)


def seconds(call: Call) -> float:
    """How long one call takes; what it gives is freed after the watch has stopped."""
    start = time.perf_counter()
    result = call()
    elapsed = time.perf_counter() - start
    del result
    return elapsed


def processor_seconds(call: Call) -> float:
    """How long processors work for one call, on any thread of this process."""
    start = time.process_time()
    result = call()
    elapsed = time.process_time() - start
    del result
    return elapsed


def interleaved(
    calls: Mapping[str, Call], plan: Plan, seconds: Callable[[Call], float] = seconds
) -> dict[str, Timing]:
    """Times of all calls: round after round, each has one turn. seconds: the stopwatch.

    A turn is a pause; untimed calls, which find the caches full of another's data and a processor
    that has slept; and then timed ones. The first round is preceded by an untimed call of each,
    which may compile.
    """
    samples: dict[str, list[float]] = {name: [] for name in calls}
    for call in calls.values():
        call()
    start = time.perf_counter()
    gc.collect()
    gc.disable()
    try:
        for done in range(plan.rounds):
            if done >= plan.least_rounds and time.perf_counter() - start > plan.budget_s:
                break
            for name, call in calls.items():
                samples[name] += _turn(call, plan, seconds)
    finally:
        gc.enable()
    return {name: Timing(tuple(own)) for name, own in samples.items()}


def _turn(call: Call, plan: Plan, seconds: Callable[[Call], float]) -> list[float]:
    time.sleep(plan.quiet_s)
    start = time.perf_counter()
    while True:
        last_s = seconds(call)
        if last_s > plan.slow_s:
            return [last_s]
        if time.perf_counter() - start > plan.warm_s:
            break
    return [seconds(call) for _ in range(plan.repeats)]
