"""A pixel's reading for the clipboard, as LaTeX."""

from __future__ import annotations

from lucida.app.ui.explaining.notation import Line
from lucida.renderer.camera.pixels import Indexing

from .color_formulas import color_lines
from .formulas import hit_lines, pixel_text, ray_lines
from .reading import Reading


def section_lines(
    reading: Reading, indexing: Indexing = Indexing.LECTURE
) -> tuple[list[Line], list[Line], list[Line]]:
    """Return a reading's lines for the ray, the hit and the colour."""
    color = [] if reading.is_outside else color_lines(reading)
    return ray_lines(reading, indexing), hit_lines(reading), color


def all_lines(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> list[Line]:
    """Return every line of a reading, from the pixel's index to its bytes."""
    return [line for part in section_lines(reading, indexing) for line in part]


def as_latex(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> str:
    """Return the lines as an `align*` of amsmath."""
    rows = []
    for line in all_lines(reading, indexing):
        left, equal, right = line.latex.partition(" = ")
        rows.append(rf"{left} &= {right} \\" if equal else rf"& {line.latex} \\")
        if line.latex_numbers:
            sign, space, rest = line.latex_numbers.partition(" ")
            rows.append(
                rf"&= {rest} \\" if sign == "=" and space else rf"& {line.latex_numbers} \\"
            )
    rows[-1] = rows[-1].removesuffix(r" \\")
    body = [rf"% Pixel in {pixel_text(reading, indexing)}", r"\begin{align*}"]
    return "\n".join([*body, *(f"  {row}" for row in rows), r"\end{align*}"]) + "\n"
