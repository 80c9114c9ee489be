"""Functions that emit a kernel's instructions: they compute what Python would."""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba.core.errors import TypingError

from lucida.renderer.trace.compile.emit import choose, emitted, f32, i64
from lucida.renderer.trace.vector.memory import pointer


class Pair(NamedTuple):
    first: object
    second: object


@emitted
def numbers(x, n):
    return Pair((x + 1, 2 - x, x * x, x / 4), (n // 3, n % 3, -n, ~n, n << 2, 1 ^ n, abs(x)))


@numba.njit
def kernel_numbers(x, n):
    pair = numbers(x, n)
    return pair.first, pair.second


@emitted
def chosen(is_first, pair, extra):
    def first():
        return pair.first, (f32(1), i64(pair.second))

    return choose(is_first, first, lambda: (pair.second, (f32(2.5), 7))) if extra is None else extra


@numba.njit
def kernel_chosen(is_first, a, b, extra):
    return chosen(is_first, Pair(a, b), extra)


@emitted
def set_if(is_set, array, at, value):
    def assign():
        array[at] = value

    choose(is_set, assign, lambda: None)


@numba.njit
def kernel_set(is_set, array):
    set_if(is_set, pointer(array), 1, array[0])


@emitted
def branching(x):
    return 1 if x > 0 else 2


@numba.njit
def kernel_branching(x):
    return branching(x)


def test_numbers_are_what_python_computes():
    assert kernel_numbers(-2.5, 7) == tuple(numbers(-2.5, 7))


def test_a_choice_joins_tuples():
    assert kernel_chosen(True, 3, 4, None) == (3, (1.0, 4))
    assert kernel_chosen(False, 3, 4, None) == (4, (2.5, 7))


def test_an_argument_that_is_not_none_is_known_when_compiling():
    assert kernel_chosen(True, 3, 4, 2.5) == 2.5


def test_a_choice_may_do_nothing():
    array = np.array([5.0, 1.0])
    kernel_set(False, array)
    assert array.tolist() == [5.0, 1.0]
    kernel_set(True, array)
    assert array.tolist() == [5.0, 5.0]


def test_a_branch_on_a_value_is_an_error_that_says_what_to_use():
    with pytest.raises(TypingError, match="use choose"):
        kernel_branching(1.0)
