"""The table of symbols: formulas and programs in the book's notation and in code's."""

from __future__ import annotations

import re

import pytest

from lucida.app.ui.explaining import symbols
from lucida.app.ui.explaining.plain import plain_math

FORMULAS = (
    r"\mathbf{d} = u\,\mathbf{u} + v\,\mathbf{v} - d\,\mathbf{w}",
    r"u = \frac{j - 0.5}{W} - 0.5",
    r"\mathbf{r}(t) = \mathbf{p} + t\,\mathbf{d}, \quad t > 0",
    r"f = W\,d / (right - left), \mathbf{L}_{d1} = k_d, \mathbf{d}_{uvw} = (u,\ v,\ -d)",
    r"\mathbf{e} = -R^\mathsf{T}\,\mathbf{t}",
)


@pytest.mark.parametrize("formula", FORMULAS)
def test_a_formula_reads_the_same_typeset_and_as_text(formula):
    """Translated before it is made plain, or after."""
    typeset = plain_math(symbols.latex(formula, "code").replace(r"\mathbf", r"\mathrm"))
    text = symbols.plain(plain_math(formula), "code")
    assert re.sub(r"vec\((\w+)\)", r"\1", text) == typeset
    assert symbols.latex(formula, "book") == formula


def test_code_as_a_formula():
    assert symbols.formula("x*u + y*v - distance*w") == FORMULAS[0].partition(" = ")[2]


def test_the_lecture_s_formula_in_code():
    assert symbols.latex(FORMULAS[0], "code") == (
        r"\mathbf{direction} = x\,\mathbf{u} + y\,\mathbf{v} - \mathit{distance}\,\mathbf{w}"
    )
    assert symbols.latex(r"\mathbf{L}_{d1} = k_d", "code") == r"\mathbf{L}_{d1} = k_d"


@pytest.mark.parametrize(
    ("letters", "words"),
    [
        ("d = u*cam.u + v*cam.v - cam.d*cam.w", "direction = x*u + y*v - distance*w"),
        (
            "u = left + (j - 0.5) / W * (right - left)",
            "x = left + (j - 0.5) / width * (right - left)",
        ),
        ("p = cam.e", "origin = eye"),
        ("t = 1e-3 * dot(d, x - p)", "t = 1e-3 * dot(direction, point - origin)"),
        (
            "left, right, bottom, top = camera.viewport",
            "left, right, bottom, top = camera.viewport",
        ),
    ],
)
def test_a_program_goes_there_and_back(letters, words):
    assert symbols.program(words, "book") == letters
    assert symbols.lettered(letters, "code") == words
    assert (symbols.program(words, "code"), symbols.lettered(letters, "book")) == (words, letters)


def test_each_symbol_has_one_meaning():
    for spelling in ("letter", "code"):
        names = [getattr(one, spelling) for one in symbols.TABLE]
        assert len(set(names)) == len(names)
