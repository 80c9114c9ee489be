"""The image as an array, as a program: declared, a pixel set, its offset in memory.

Owns the programs in Python, Julia and C, for either order and either first index. Each is what
its language makes of it: Python and C count from 0 and lay rows, Julia counts from 1 and lays
columns; the other order and the other first index are written out.
"""

from __future__ import annotations

from app.laboratory.memory import Order, Size
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
    ("c", "row"): ("static float canvas[H][W][3];",),
    ("c", "column"): ("static float canvas[W][H][3];",),
}


def lines(
    language: Language,
    order: Order,
    one_based: bool,
    size: Size,
    pixel: tuple[int, int],
    values: tuple[float, ...],
) -> list[str]:
    """The lines that matter. size: (width, height). pixel: (row, column), 0-based. values: its
    red, green and blue."""
    first = int(one_based)
    i, j = (part + first for part in pixel)
    red, green, blue = (f"{value:.2f}" for value in values)
    row, column = (_index(name, language, first) for name in "ij")
    offset, array = _offset(order, one_based), _ARRAYS[language, order]
    laid, counted = f"# {ONE_AFTER_ANOTHER[order]}", f"# from {first}"
    if language == "c":
        place = f"[{row}][{column}]" if order == "row" else f"[{column}][{row}]"
        return [
            f"enum {{ H = {size[1]}, W = {size[0]} }};",
            laid.replace("#", "//"),
            *array,
            f"int i = {i}, j = {j};  {counted.replace('#', '//')}",
            f"float *pixel = canvas{place};",
            *(f"pixel[{k}] = {value}f;" for k, value in enumerate((red, green, blue))),
            f"long offset = {offset} * 12L;",
        ]
    color = f"RGB({red}, {green}, {blue})" if language == "julia" else f"{red}, {green}, {blue}"
    return [
        "using Colors" if language == "julia" else "import numpy as np",
        f"H, W = {size[1]}, {size[0]}",
        laid,
        *array,
        f"i, j = {i}, {j}  {counted}",
        f"canvas[{row}, {column}] = {color}",
        f"offset = {offset} * 12",
    ]


def program(language: Language, listed: list[str]) -> str:
    """The lines as a program that prints the offset."""
    if language == "c":
        body = "".join(f"    {line}\n" for line in listed)
        return (
            "#include <stdio.h>\n\nint main(void)\n{\n"
            f'{body}    printf("%ld\\n", offset);\n    return 0;\n}}\n'
        )
    last = "println(offset)" if language == "julia" else "print(offset)"
    return "\n".join([*listed, last]) + "\n"


def _index(name: str, language: Language, first: int) -> str:
    """A row or column that is counted from `first`, as the language counts it."""
    ahead = int(language == "julia") - first
    return f"{name} {'+' if ahead > 0 else '-'} 1" if ahead else name


def _offset(order: Order, one_based: bool) -> str:
    i, j = ("(i - 1)", "(j - 1)") if one_based else ("i", "j")
    return f"({i} * W + {j})" if order == "row" else f"({j} * H + {i})"
