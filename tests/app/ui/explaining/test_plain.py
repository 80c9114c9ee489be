"""Formulas as plain text."""

from __future__ import annotations

import pytest

from lucida.app.ui.explaining.plain import plain_math


@pytest.mark.parametrize(
    ("latex", "text"),
    [
        (r"u = \frac{j - 0.5}{W} - 0.5", "u = (j - 0.5) / W - 0.5"),
        (r"v = -\left(\frac{i}{H}\right)", "v = -(i / H)"),
        (r"\mathbf{d} = u\,\mathbf{u} - d\,\mathbf{w}", "vec(d) = u vec(u) - d vec(w)"),
        (r"\frac{\mathbf{e} - \mathbf{a}}{|\mathbf{e}|}", "(vec(e) - vec(a)) / |vec(e)|"),
        (r"I : \mathbb{R}^2 \to x_{12}", "I : R² → x_12"),
        (r"2 \times 3 \cdot 4, \quad \sqrt{2}", "2 \u00d7 3 · 4,  sqrt(2)"),
        (r"\textcolor{#ff0000}{x}^3", "x³"),
        (r"\unknown{a}", "unknowna"),
        (r"\frac{a}{2 + x} \sqrt{x}_1^23", "a / (2 + x) sqrt(x)_1²3"),
        (r"x^2 y^3 z^4 w^{ab}", "x² y³ z^4 w^ab"),
        (r"x_{i + 1}^{-1}", "x_(i + 1)^(-1)"),
        (r"\color{red} x \textcolor{blue}{y}z", " x yz"[1:]),
        (r"x^\textcolor{red}{2}", "x²"),
        (r"\mathbf{ab} \vec{c} \mathrm{sin} \hat{n}", "ab c sin n/|n|"),
        (r"\{a\} \| \!b\\c", "{a} | b; c"),
        ("a  \n  b,   c", "a b,  c"),
        (r"\frac{|a|}{(b)} \frac{2.5x²}{|a|+1}", "|a| / (b) 2.5x² / (|a|+1)"),
        (r"R^\mathsf{T} \frac{1}{\omega}", "R^T 1 / (omega)"),
        ("", ""),
        ("x^", "x^"),
    ],
)
def test_formulas_as_plain_text(latex, text):
    assert plain_math(latex) == text
