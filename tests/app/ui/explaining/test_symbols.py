"""The table of symbols: programs that are written with words, shown with letters."""

from __future__ import annotations

import pytest

from lucida.app.ui.explaining import symbols


def test_code_as_a_formula():
    assert symbols.formula("x*u + y*v - distance*w") == (
        r"u\,\mathbf{u} + v\,\mathbf{v} - d\,\mathbf{w}"
    )


@pytest.mark.parametrize(
    ("words", "letters"),
    [
        ("direction = x*u + y*v - distance*w", "d = u*cam.u + v*cam.v - cam.d*cam.w"),
        (
            "x = left + (j - 0.5) / width * (right - left)",
            "u = left + (j - 0.5) / W * (right - left)",
        ),
        ("origin = cam.eye", "p = cam.e"),
        ("t = 1e-3 * dot(direction, point - origin)", "t = 1e-3 * dot(d, x - p)"),
        ("left, right = camera.viewport", "left, right = camera.viewport"),
    ],
)
def test_a_program_in_letters(words, letters):
    assert (symbols.program(words), symbols.program(words, "code")) == (letters, words)


def test_each_symbol_has_one_meaning():
    for spelling in ("letter", "code"):
        names = [getattr(one, spelling) for one in symbols.TABLE]
        assert len(set(names)) == len(names)
