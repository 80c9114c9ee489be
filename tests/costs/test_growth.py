"""The words for the lines of the cost plot: by points whose growth is known."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import pytest

from app.costs.growth import count_growth, is_proportional, per_doubling
from app.costs.model import steps

DECADES = (1.0, 10.0, 100.0, 1000.0)


def line(count: Callable[[float], float], at: tuple[float, ...] = DECADES) -> list:
    return [(n, count(n)) for n in at]


def test_nothing_is_said_of_too_few_counts() -> None:
    points = [(100.0, 1.0), (1000.0, 10.0), (10_000.0, 100.0)]
    assert count_growth([], "n") == count_growth(points, "n") == ""
    assert count_growth([(n, n) for n in (100, 110, 120, 130, 140)], "n") == ""
    assert count_growth([(100.0, 1.0)] * 9, "n") == ""
    assert count_growth([*points, (1e5, 1000.0)], "n") == "~ n"
    assert count_growth([(n, n * n) for n in (1, 10, 100, 1000)], "n") == "~ n^2.0"
    assert math.isnan(per_doubling(points[:1]))


COUNTS = tuple(float(n) for n in steps(100, 1_000_000, 6))


def test_a_busy_machine_is_not_believed() -> None:
    """Whatever is added to times that do not climb, nothing is said of them."""
    rng = random.Random(7)
    for _ in range(300):
        noisy = [(n, 1e-3 * (1 + rng.random() * rng.choice((0, 1, 20)))) for n in COUNTS]
        assert not is_proportional(noisy)
    # The lines of the plot that said n^0.4 on a busy machine.
    assert not is_proportional(zip(COUNTS, (13, 16, 8, 16, 75, 230), strict=True))
    assert not is_proportional(zip(COUNTS, (1.2, 1, 1.5, 2.3, 22, 26), strict=True))


def test_times_that_a_clock_could_not_tell() -> None:
    assert not is_proportional([(n, bad) for n in COUNTS for bad in (0.0, math.nan, math.inf)])


def test_little_is_said_of_lines_that_are_short() -> None:
    assert count_growth(line(float, (1, 2, 3, 30)), "n") == "~ n"
    assert count_growth(line(float, (1, 2, 3, 29.9)), "n") == ""
    assert count_growth(line(float, (2, 3, 5, 60)), "n") == "~ n"
    assert count_growth(line(float, (2, 3, 5, 59)), "n") == ""


@pytest.mark.parametrize(
    ("count", "said"),
    [
        (lambda n: 100 + 25 * (n == 10), "the same"),
        (lambda n: 100 - 20 * (n == 10), "the same"),
        (lambda n: 100 + 0.026 * n, "~ log n"),
        (lambda n: 7 * n**1.04, "~ n"),
        (lambda n: 7 * n**0.96, "~ n"),
        (lambda n: n**1.06, "~ n^1.1"),
        (lambda n: n**0.94, "~ n^0.9"),
        (lambda n: 10 + 5 * math.log(n), "~ log n"),
        (lambda n: 1 + 0.5 * math.log(n), "~ log n"),
        (lambda n: (10 + 5 * math.log(n)) * (1 + 0.14 * (n == 10)), "~ log n"),
        (lambda n: (10 + 5 * math.log(n)) * (1 - 0.19 * (n == 10)), "~ n^0.2"),
        (lambda n: (10 + 5 * math.log(n)) * (1 + 0.19 * (n == 10)), "~ n^0.2"),
        (lambda n: 100 - 5 * math.log(n), "~ n^-0.1"),
    ],
)
def test_what_counts_grow_with(count: Callable[[float], float], said: str) -> None:
    assert count_growth(line(count), "n") == said


def test_what_is_added_when_n_doubles() -> None:
    assert per_doubling(line(lambda n: 5 + 3 * math.log2(n))) == pytest.approx(3)
    assert per_doubling([(4, 7.0), (2, 5.0)]) == pytest.approx(2)
    assert per_doubling([(1, 0.5), (2, 1.0), (4, 3.0)]) == pytest.approx(1.25)


def test_of_several_counts_of_one_n_the_least_counts() -> None:
    times = [(n, value) for n, low in line(float) for value in (3 * low, low, 9 * low)]
    noise = [(0, 5.0), (-1, 5.0), (5000, 0.0), (5000, -1.0), (5000, math.inf), (5000, math.nan)]
    assert count_growth([*reversed(times), *noise], "n") == "~ n"
    assert is_proportional([*reversed(times), *noise])


def test_times_climb_like_n_where_the_exponent_is_nearly_1() -> None:
    for exponent, is_one in ((0.84, False), (0.86, True), (1.14, True), (1.16, False)):
        assert is_proportional(line(lambda n, k=exponent: 1e-3 * n**k)) == is_one


def test_times_climb_like_n_on_a_line_that_is_straight() -> None:
    for factor, is_straight in ((1.3, True), (1.4, False), (1 / 1.3, True), (1 / 1.4, False)):
        bent = [(n, n * (factor if n == 100 else 1)) for n in (1, 10, 100, 1000, 10_000)]
        assert is_proportional(bent) == is_straight


def test_times_climb_like_n_from_where_they_are_steep() -> None:
    assert is_proportional(zip(DECADES, (1, 1, 10, 100), strict=True))
    assert not is_proportional(zip(DECADES, (1, 1, 1, 10), strict=True))
    assert is_proportional(line(float))
    assert not is_proportional([*line(float), (1100.0, 1000.0)]), "flat at its end"
    for exponent, is_left_out in ((0.45, True), (0.55, False)):  # part of the line, bent there
        first = 10**exponent
        times = (1, first, 10 * first, 100 * first)
        assert is_proportional(zip(DECADES, times, strict=True)) == is_left_out
