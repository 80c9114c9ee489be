"""A student's result is read generously, and nothing else is taken for it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida.app.checking.kinds import KINDS
from lucida.app.checking.kinds import kind as values
from lucida.app.checking.kinds.hits import MISS, parameter
from lucida.app.checking.task_file import BUILTIN

numbers = st.floats(allow_nan=False) | st.integers(-(10**6), 10**6)
triples = st.tuples(numbers, numbers, numbers).map(list)
json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=7) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=12,
)
RAY = ("origin", "direction")


@given(triples)
def test_forms_of_a_vector(made):
    wanted = tuple(map(float, made))
    x, y, z = made
    forms = ([x, y, z], [[x, y, z]], [[x], [y], [z]], [x, y, z, 0], [x, y, z, 1.0])
    for form in (*forms, {"x": x, "y": y, "z": z}):
        assert values.vector(form) == wanted
    for form in ([x, y], [x, y, z, 2], [x, y, None], [x, y, "1"], [x, y, True], {"x": x}, None):
        assert values.vector(form) is None


@given(triples, triples)
def test_forms_of_a_ray(origin, direction):
    wanted = [tuple(map(float, origin)), tuple(map(float, direction))]
    forms = ([origin, direction], [*origin, *direction])
    for form in (*forms, {"origin": origin, "direction": direction, "t": 1}):
        assert values.vectors(form, RAY) == wanted
    for form in ([origin], [origin, direction, origin], origin, {"origin": origin}, 3, None):
        assert values.vectors(form, RAY) is None
    assert values.vectors(direction, ("direction",)) == wanted[1:]
    assert values.vectors([direction], ("direction",)) == wanted[1:]
    assert values.vectors({"direction": direction}, ("direction",)) == wanted[1:]


@given(json_values)
def test_nothing_that_json_has_is_too_strange(value):
    read = values.vectors(value, RAY)
    assert read is None or np.shape(read) == (2, 3)
    t = parameter(value)
    assert t is None or isinstance(t, float)
    image = values.array(value)
    assert image is None or image.dtype == np.float64
    assert len(values.shown(value)) <= values.SHOWN


@pytest.mark.parametrize(
    "value", [None, False, math.inf, math.nan, [], [None], [False, 0.0], [False, None],
              {"t": None}, [None, math.inf]]
)  # fmt: skip
def test_no_hit_is_read_in_every_form(value):
    assert parameter(value) == math.inf


@pytest.mark.parametrize("value", [2, 2.0, [2.0], [[2]], [True, 2.0], {"t": 2}])
def test_a_hit_is_read_in_every_form(value):
    assert parameter(value) == 2.0


@pytest.mark.parametrize("value", [True, "2", [1, 2, 3], {"x": 1}, [True, "2"]])
def test_what_is_neither_hit_nor_miss_is_refused(value):
    assert parameter(value) is None


def test_values_are_short_in_messages():
    told = values.text_of({"a": [1, -0.0, 0.1 + 0.2], "b": None, "c": True, "d": "x"})
    assert told == "{a: (1, 0, 0.3), b: None, c: True, d: 'x'}"


@pytest.mark.parametrize("value", [None, [-1, math.inf], [0, None], [2, math.nan], [False, None]])
def test_no_nearest_hit_is_read_in_every_form(value):
    kind, task = KINDS["closest-hit"], next(one for one in BUILTIN if one.name == "closest-hit")
    assert kind.read(task, kind.cases(replace(task, count=1))[0], value) == MISS
