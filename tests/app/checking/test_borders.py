"""Zeros, infinities and signs, where answers are judged and explained."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from lucida.app.checking.kinds import KINDS
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import CheckCase

borders = st.sampled_from([0.0, -0.0, 1.0, -1.0, 1e300, math.inf, -math.inf, math.nan])
parameters = st.floats(1e-3, 1e3) | st.just(math.inf)
HITS = [task for task in BUILTIN if task.kind in ("hit-sphere", "hit-triangle")]
CLOSEST = [task for task in BUILTIN if task.kind == "closest-hit"]


@given(parameters, borders | st.floats(), st.sampled_from([0.0, 1e-6]))
def test_a_hit_is_right_near_the_right_one_and_a_miss_where_there_is_one(right, answer, near):
    is_right = answer == right or abs(answer - right) <= near
    for task in HITS:
        case = CheckCase((), right, near, {})
        assert KINDS[task.kind].wrong(task, [case], np.array([answer])).tolist() == [not is_right]
    for task in CLOSEST:
        for number in (0.0, 1.0):
            case = CheckCase((), (number, right), near, {})
            for given_number in (0.0, 1.0, -1.0):
                wrong = KINDS[task.kind].wrong(task, [case], np.array([[given_number, answer]]))
                assert wrong.tolist() == [not is_right or given_number != number]
