"""The measures of a basis."""

from __future__ import annotations

import math

import pytest
from hypothesis import strategies as st

from lucida.app.cameras.basis import measures

numbers = st.floats(-3, 3)
vectors = st.tuples(numbers, numbers, numbers)


def test_an_orthonormal_basis_measures_one_and_ninety() -> None:
    found = measures((0, 0, -1), (0, 1, 0), (1, 0, 0))
    assert found.lengths == (1, 1, 1)
    assert found.angles_deg == pytest.approx((90, 90, 90))
    assert found.determinant == 1


def test_a_skewed_left_handed_one() -> None:
    found = measures((-2, 0, 0), (0, 3, 0), (0, 1, 1))
    assert found.lengths == pytest.approx((2, 3, math.sqrt(2)))
    assert found.angles_deg == pytest.approx((90, 45, 90))
    assert found.determinant == -6


def test_what_is_no_basis() -> None:
    found = measures((1, 0, 0), (0, 1, 0), (0, 0, 0))
    assert found.lengths[2] == 0
    assert found.angles_deg[0] == 90
    assert math.isnan(found.angles_deg[1])
    assert math.isnan(found.angles_deg[2])
    assert found.determinant == 0
    assert math.isnan(measures((math.inf, 0, 0), (0, 1, 0), (0, 0, 1)).determinant)
