"""The array page's program in Python and Julia: they say the same of memory."""

from __future__ import annotations

import itertools
import re
from typing import Any

import numpy as np
import pytest
from compilers import needs_julia, run_julia

from app.laboratory import array_code, memory
from app.state.options import Language

ARRAYS = list(itertools.product(("row", "column"), (True, False)))
PIXEL, VALUES = (11, 20), (0.25, 0.5, 0.75)


def listed(language: Language, order: memory.Order, one_based: bool) -> list[str]:
    return array_code.lines(language, order, one_based, (37, 23), PIXEL, VALUES)


@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_python(order, one_based, capsys):
    names: dict[str, Any] = {}
    program = array_code.program("python", listed("python", order, one_based))
    exec(compile(program, "array", "exec"), names)
    canvas, offset = names["canvas"], int(capsys.readouterr().out)
    assert canvas.shape == (23, 37, 3) and canvas.dtype == np.float32
    assert canvas[PIXEL].tolist() == list(VALUES)
    assert offset == 12 * memory.pixel_number(*PIXEL, (37, 23), order)
    assert offset == int(np.dot((*PIXEL, 0), canvas.strides))
    assert f"from {int(one_based)}" in program


RGB = """struct RGB{T}; r::T; g::T; b::T; end
RGB(r, g, b) = RGB{Float32}(r, g, b)
Base.zero(::Type{RGB{T}}) where T = RGB{T}(0, 0, 0)
"""


@needs_julia
@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_julia_runs(order, one_based, tmp_path):
    program = array_code.program("julia", listed("julia", order, one_based))
    row, column = (part + 1 for part in PIXEL)
    place = (
        f"println(Int(pointer(parent(canvas), LinearIndices(parent(canvas))[{column}, {row}])"
        if order == "row"
        else f"println(Int(pointer(canvas, LinearIndices(canvas)[{row}, {column}])"
    )
    base = "parent(canvas)" if order == "row" else "canvas"
    program = program.replace("using Colors\n", RGB) + f"{place} - pointer({base})))\n"
    offset, found = map(int, run_julia(program, tmp_path).split())
    assert offset == found == 12 * memory.pixel_number(*PIXEL, (37, 23), order)


@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_julia_by_construction(order, one_based):
    python, text = (listed(language, order, one_based) for language in ("python", "julia"))
    assert text[-1] == python[-1]  # the offset's formula, and i, j, W, H
    assert [line for line in text if line.startswith(("i, j", "H, W"))] == [
        line for line in python if line.startswith(("i, j", "H, W"))
    ]
    index = next(re.findall(r"canvas\[(.*)\]", line) for line in text if "canvas[" in line)[0]
    i, j = (part + one_based for part in PIXEL)
    assert eval(index, {"i": i, "j": j}) == (PIXEL[0] + 1, PIXEL[1] + 1)  # Julia's own
    made = next(line for line in text if "zeros" in line)
    # Columns one after another: the first number of a Julia array's shape grows fastest.
    assert made.endswith("zeros(RGB{Float32}, H, W)" if order == "column" else "W, H)")
    assert any("PermutedDimsArray(memory, (2, 1))" in line for line in text) == (order == "row")
