"""The notation of numbers, vectors and lines of formulas."""

from __future__ import annotations

import math

import pytest

from lucida.app.ui.explaining.notation import (
    Line,
    Slot,
    bold,
    formula,
    latex_number,
    number,
    results,
    scalar_slot,
    text_tuple,
    vector_slot,
)


@pytest.mark.parametrize(
    ("value", "shown", "fixed"),
    [
        (0.0, "0", "0.0000"),
        (-0.0, "0", "0.0000"),
        (3.0, "3", "3.0000"),
        (-0.25, "-0.25", "-0.2500"),
        (1 / 3, "0.3333", "0.3333"),
        (-2 / 3, "-0.6667", "-0.6667"),
        (100.0, "100", "100.0000"),
        (1 / 32, "0.03125", "0.0312"),
        (1 / 1600, "0.000625", "0.0006"),
        (1 / 3200, "0.000313", "3.13e-04"),
        (0.123456, "0.1235", "0.1235"),
        (5e-4, "0.0005", "0.0005"),
        (-4.9876e-4, "-0.000499", "-4.99e-04"),
        (999_999.0, "999999", "999999.0000"),
        (1e6, "1e+06", "1.00e+06"),
        (math.inf, "inf", "inf"),
        (-math.inf, "-inf", "-inf"),
        (math.nan, "none", "none"),
    ],
)
def test_a_number_has_four_decimals_or_six_of_a_pixels_fraction(value, shown, fixed):
    assert (number(value), number(value, fixed=True)) == (shown, fixed)


def test_what_latex_writes_in_its_own_way():
    values = (0.5, -1.5e-7, 2e9, math.inf, -math.inf, math.nan)
    wanted = (
        "0.5",
        r"-1.5 \cdot 10^{-7}",
        r"2 \cdot 10^{9}",
        r"\infty",
        r"-\infty",
        r"\mathrm{none}",
    )
    assert tuple(map(latex_number, values)) == wanted
    assert latex_number(0.5, fixed=True) == "0.5000"
    assert bold("d") == r"\mathbf{d}"
    assert bold("n_12") == r"\mathbf{n}_{12}"


def test_results_have_as_many_decimals_as_one_of_them_needs():
    assert results([0.25]) == results([0.25 + 1e-11]) == "0.25"
    assert results([0.123]) == "0.123"
    assert results([0.25 + 1e-8]) == "0.2500"
    assert results([1 / 32 + 1e-12]) == "0.03125"
    assert results([1e5 / 3]) == "33333.3333"
    assert results([0.5, 3.0]) == r"(0.5,\ 3)"
    assert results([0.5, 1 / 3]) == r"(0.5000,\ 0.3333)"


def test_what_is_only_rounding_beside_the_largest_is_0():
    assert text_tuple((-1.0, 1e-12, -1e-13)) == "(-1, 0, 0)"
    assert text_tuple((1.0, 1.1e-12)) == "(1, 1.1e-12)"
    assert text_tuple((1e-12, 1e-13)) == "(1e-12, 1e-13)"
    assert text_tuple((0.0, 0.0)) == "(0, 0)"
    assert results((2.0, 1e-13)) == r"(2,\ 0)"


def test_factors_stand_in_brackets_where_a_sign_or_a_power_would_be_misread():
    assert scalar_slot("a", -2.0) == Slot("a", "-2")
    assert scalar_slot(r"\alpha", -2.0, factor=True) == Slot(r"\alpha", "(-2)")
    assert scalar_slot("a", 0.0, factor=True) == Slot("a", "0")
    assert scalar_slot("a", 2.0, factor=True) == Slot("a", "2")
    assert scalar_slot("a", 1e-5, factor=True) == Slot("a", r"(1 \cdot 10^{-5})")
    assert vector_slot("d", iter((1, 0.5))) == Slot(r"\mathbf{d}", r"(1,\ 0.5)")


def test_a_line_says_symbols_numbers_and_the_result():
    slots = {"a": scalar_slot(r"\alpha", -2.0, factor=True), "b": scalar_slot("b", 0.5)}
    sides = r"\sigma", r"<b> \cdot <a>"
    assert formula("sum", "the sum", *sides, slots, -1) == Line(
        "sum", "the sum", r"\sigma = b \cdot \alpha", r"= 0.5 \cdot (-2) = -1", (-1,)
    )
    told = formula("k", "n", *sides, slots, iter((1.0, 2.0)), r"\text{some}")
    assert told.value == (1.0, 2.0)
    assert told.latex_numbers == r"= 0.5 \cdot (-2) = \text{some}"


def test_a_line_does_not_say_its_result_twice():
    same = formula("k", "n", "x", "<b>", {"b": scalar_slot("b", 0.5)}, 0.5)
    assert (same.latex, same.latex_numbers) == ("x = b", "= 0.5")
    plain = formula("k", "n", "x", "1/2", {}, 0.25)
    assert (plain.latex, plain.latex_numbers) == ("x = 1/2", "= 0.25")
