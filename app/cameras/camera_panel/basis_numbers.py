"""The basis in numbers: lengths, angles, determinant, handedness.

Unusual values are brighter. app/cameras/basis.py measures them.
"""

from __future__ import annotations

import math

from imgui_bundle import imgui

from lucida.app.cameras.basis import Measures
from lucida.app.ui import rows, theme

USUAL = 1e-4  # the largest deviation of a length, a determinant, or an angle in degrees
SINGULAR = 1e-9

LENGTHS = "Lengths of u, v and w. Orthonormal: 1."
ANGLES = "Angles between u and v, v and w, w and u. Orthonormal: 90 degrees."
DETERMINANT = """\
The volume that u, v and w span. 0: they are not a basis. Negative: they are left-handed, and the
image is mirrored. Positive: they are right-handed. Orthonormal: 1 or -1."""


def basis_readout(found: Measures, mono: imgui.ImFont | None) -> None:
    """Draw three lines into the current window, in the columns of the fields above."""
    thirds = rows.Thirds()
    digits = 2 if thirds.narrow else 4
    determinant = found.determinant
    no_basis = not abs(determinant) > SINGULAR * math.prod(found.lengths)
    side = "no basis" if no_basis else "right-handed" if determinant > 0 else "left-handed"
    lengths = [(_number(x, digits), abs(x - 1) <= USUAL, not x > 0) for x in found.lengths]
    angles = [
        (f"{_number(x, digits - 2)}\N{DEGREE SIGN}", abs(x - 90) <= USUAL, not math.isfinite(x))
        for x in found.angles_deg
    ]
    volume = [
        (_number(determinant, digits), abs(abs(determinant) - 1) <= USUAL, no_basis),
        (side, determinant > 0, no_basis),
    ]
    for name, short, tooltip, values in (
        ("length", "||", LENGTHS, lengths),
        ("angle", "deg", ANGLES, angles),
        ("det", "det", DETERMINANT, volume),
    ):
        imgui.text_colored(theme.DIM, short if thirds.narrow else name)
        rows.tip(tooltip)
        for column, (text, is_usual, is_wrong) in enumerate(values):
            thirds.go(column)
            imgui.push_font(mono, 0.0)
            color = theme.ERROR if is_wrong else theme.DIM if is_usual else theme.TEXT
            imgui.text_colored(color, text)
            imgui.pop_font()
            rows.tip(tooltip)


def _number(value: float, digits: int) -> str:
    """Return a few characters for all but extreme values."""
    if not math.isfinite(value):
        return "-"
    return f"{value:.{digits}f}" if abs(value) < 1000 else f"{value:.0e}"
