"""renderer/system/memo.py: what is kept of a function, and when it is called again."""

import math
from collections import deque

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida.renderer.system.memo import Memo, same

_ARRAYS = np.zeros(2), np.zeros(2)
KEYS = st.sampled_from(
    (
        0,
        0.0,
        False,
        1,
        True,
        "",
        "0",
        None,
        (0, 1),
        (False, 1),
        (0, 1, 2),
        *_ARRAYS,
        (0, _ARRAYS[0]),
    )
)
CALLS = []


def recorded(*key):
    CALLS.append(key)
    return key


def refused(*_):
    raise ValueError("refused")


def _as_told(key):
    """Return what same() compares a key by: types and values, and arrays by what they are."""
    if isinstance(key, tuple):
        return tuple(map(_as_told, key))
    return (type(key), id(key) if isinstance(key, np.ndarray) else key)


@given(st.lists(st.tuples(KEYS, KEYS)), st.integers(1, 3))
def test_a_function_is_called_once_for_each_of_its_last_keys(keys, most):
    CALLS.clear()
    memo, last, wanted = Memo(recorded, most), deque(maxlen=most), []
    for key in keys:
        value = memo(*key)
        assert all(map(same, value, key))
        if _as_told(key) in last:
            last.remove(_as_told(key))
        else:
            wanted.append(_as_told(key))
        last.append(_as_told(key))
    assert [_as_told(key) for key in CALLS] == wanted
    assert memo.count == len(wanted)


def test_equal_arrays_are_two_and_nan_never_equals_another():
    assert not same(*_ARRAYS)
    assert not same((1, _ARRAYS[0]), (1, _ARRAYS[1]))
    assert not same(math.nan, float("nan"))


def test_a_call_that_fails_leaves_nothing_behind():
    """An upload that has failed may have overwritten the texture of the value before."""
    CALLS.clear()
    memo = Memo(lambda work, key: work(key))
    memo(recorded, 1)
    with pytest.raises(ValueError, match="refused"):
        memo(refused, 1)
    memo(recorded, 1)
    memo.forget()
    memo(recorded, 1)
    assert len(CALLS) == 3


def test_what_may_read_more_than_its_arguments_is_refused():
    outer = []
    for function in (lambda _: outer, outer.append, recorded.__call__):
        with pytest.raises(TypeError, match="may read more than its arguments"):
            Memo(function)
