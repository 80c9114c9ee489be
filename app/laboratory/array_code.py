"""The image as an array, as a program: declared, a pixel set, its offset in memory.

Python counts from 0 and stores rows, Julia counts from 1 and stores columns. Another order or
first index is written out.
"""

from __future__ import annotations

from app.laboratory.memory import PIXEL_BYTES, Order, Size, place
from app.state.options import Language

ONE_AFTER_ANOTHER: dict[Order, str] = {"row": "row after row", "column": "column after column"}
_ARRAYS: dict[tuple[Language, Order], tuple[str, ...]] = {
    ("python", "row"): ("canvas = np.zeros((H, W, 3), np.float32)",),
    ("python", "column"): (
        "memory = np.zeros((W, H, 3), np.float32)",
        "canvas = memory.transpose(1, 0, 2)",
    ),
    ("julia", "row"): (
        "memory = zeros(RGB{Float32}, W, H)",
        "canvas = PermutedDimsArray(memory, (2, 1))",
    ),
    ("julia", "column"): ("canvas = zeros(RGB{Float32}, H, W)",),
}


def lines(
    language: Language,
    order: Order,
    one_based: bool,
    size: Size,
    pixel: tuple[int, int],
    values: tuple[float, ...],
) -> list[str]:
    """Return the lines that matter.

    size: (width, height).
    pixel: (row, column), 0-based.
    values: its red, green and blue.
    """
    first = int(one_based)
    i, j = (part + first for part in pixel)
    red, green, blue = (f"{value:.2f}" for value in values)
    row, column = (_index(name, language, first) for name in "ij")
    array = _ARRAYS[language, order]
    offset = f"{place(order, one_based)} * {PIXEL_BYTES}"
    color = f"RGB({red}, {green}, {blue})" if language == "julia" else f"{red}, {green}, {blue}"
    return [
        "using Colors" if language == "julia" else "import numpy as np",
        f"H, W = {size[1]}, {size[0]}",
        f"# {ONE_AFTER_ANOTHER[order]}",
        *array,
        f"i, j = {i}, {j}  # from {first}",
        f"canvas[{row}, {column}] = {color}",
        f"offset = {offset}",
    ]


def program(language: Language, listed: list[str]) -> str:
    """Return the lines as a program that prints the offset."""
    last = "println(offset)" if language == "julia" else "print(offset)"
    return "\n".join([*listed, last]) + "\n"


def _index(name: str, language: Language, first: int) -> str:
    """Return a row or column counted from `first`, as the language counts it."""
    ahead = int(language == "julia") - first
    return f"{name} {'+' if ahead > 0 else '-'} 1" if ahead else name
