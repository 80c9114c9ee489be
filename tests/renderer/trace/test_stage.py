"""A kernel's stage that is compiled on its own: what it always needs, and what each call gives."""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba.core.errors import TypingError

from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.stage import ROOM_BYTES, call_stage, new_room, prepared
from lucida.renderer.trace.vector.memory import pointer


class Always(NamedTuple):
    factor: object
    is_negative: object
    nothing: object
    out: object


@inlined
def scale(always, row, column, floats, ints):
    sign = -1.0 if always.is_negative else 1.0
    always.out[ints[0]] = sign * always.factor * floats[0] + 10 * row + column


@inlined
def ignore(always, row, column, floats, ints):
    floats[0] = 0


@numba.njit
def prepare(factor, is_negative, out, room):
    return prepared(scale, Always(factor, is_negative, None, pointer(out)), pointer(room))


@numba.njit
def prepare_too_much(always, room):
    return prepared(ignore, always, pointer(room))


@numba.njit
def call(code, room, row, column, floats, ints):
    call_stage(code, pointer(room), row, column, pointer(floats), pointer(ints))


def test_a_stage_is_called_with_what_it_always_needs():
    out = np.zeros(4)
    rooms = [new_room(), new_room()]
    codes = [prepare(2.5, False, out, rooms[0]), prepare(4.0, True, out, rooms[1])]
    assert codes[0] == codes[1]  # types are alike
    for number, room in enumerate(rooms):
        floats, ints = np.array([3.0], np.float32), np.array([1 + number], np.int32)
        call(codes[number], room, 7, 5, floats, ints)
    assert out.tolist() == [0.0, 7.5 + 75, -12.0 + 75, 0.0]


def test_a_stage_that_always_needs_too_much_is_not_compiled():
    too_much = tuple(np.arange(ROOM_BYTES // 8 + 1, dtype=np.float64))
    with pytest.raises(TypingError, match="has no room"):
        prepare_too_much(too_much, new_room())
