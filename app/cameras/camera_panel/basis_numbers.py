"""The basis in numbers: lengths, angles, determinant, handedness.

They are in fixed columns, with unusual values highlighted. app/cameras/basis.py measures them.
"""

from __future__ import annotations

import math

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.cameras.basis import Measures
from lucida.app.ui import rows, theme

USUAL = 1e-6  # the largest deviation of a length, a determinant, or an angle in radians
SINGULAR = 1e-9

LENGTHS = "Lengths of u, v and w. Orthonormal: 1."
ANGLES = "Angles between u and v, v and w, w and u. Orthonormal: 90 degrees."
DETERMINANT = """\
The volume that u, v and w span. 0: they are no basis. Negative: left-handed, the image is mirrored;
positive: right-handed. Orthonormal: 1 or -1."""


def basis_readout(found: Measures, mono: imgui.ImFont | None) -> None:
    """Draw three lines into the current window, in the columns of the fields above."""
    thirds = rows.Thirds()

    def row(name: str, tooltip: str) -> None:
        imgui.text_colored(theme.DIM, name)
        rows.tip(tooltip)

    def cell(column: int, text: str, usual: bool, tooltip: str, wrong: bool = False) -> None:
        thirds.go(column)
        imgui.push_font(mono, 0.0)
        _value(text, usual, wrong, thirds.field_px)
        imgui.pop_font()
        rows.tip(tooltip)

    narrow = thirds.narrow
    row("||" if narrow else "length", LENGTHS)
    for column, length in enumerate(found.lengths):
        exact = f"|{'uvw'[column]}| = {length:.9g}\n{LENGTHS}"
        cell(column, _number(length, narrow), abs(length - 1) <= USUAL, exact, not length > 0)
    row("deg" if narrow else "angle", ANGLES)
    for column, (pair, angle) in enumerate(zip(("uv", "vw", "wu"), found.angles_deg, strict=True)):
        usual = abs(math.radians(angle - 90)) <= USUAL
        exact = f"between {pair[0]} and {pair[1]}: {angle:.9g} degrees\n{ANGLES}"
        text = f"{pair}{angle:5.1f}\N{DEGREE SIGN}" if math.isfinite(angle) else f"{pair}   - "
        if narrow:
            text = f"{angle:.0f}\N{DEGREE SIGN}" if math.isfinite(angle) else "-"
        cell(column, text, usual, exact, not math.isfinite(angle))
    determinant = found.determinant
    row("det", DETERMINANT)
    exact = f"det = {determinant:.9g}\n{DETERMINANT}"
    wrong = not abs(determinant) > SINGULAR * math.prod(found.lengths)
    cell(0, _number(determinant, narrow), abs(abs(determinant) - 1) <= USUAL, exact, wrong)
    side = "no basis" if wrong else "right-handed" if determinant > 0 else "left-handed"
    cell(1, side, determinant > 0, exact, wrong)


def _value(text: str, usual: bool, wrong: bool, width_px: float) -> None:
    """Draw a text; an unusual one is bright, with a highlighted background."""
    color: ImVec4 = theme.ERROR if wrong else theme.DIM if usual else theme.TEXT
    if not usual or wrong:
        at, em = imgui.get_cursor_screen_pos(), imgui.get_font_size()
        width = max(width_px, imgui.calc_text_size(text).x + 0.15 * em)
        imgui.get_window_draw_list().add_rect_filled(
            ImVec2(at.x - 0.15 * em, at.y),
            ImVec2(at.x + width, at.y + imgui.get_text_line_height()),
            theme.u32(theme.FRAME_ACTIVE),
            0.2 * em,
        )
    imgui.text_colored(color, text)


def _number(value: float, narrow: bool = False) -> str:
    """Return eight characters (narrow: as few as possible) for all but extreme values."""
    width, digits = (0, 2) if narrow else (8, 4)
    if not math.isfinite(value):
        return f"{'-':>{width or 1}}"
    return f"{value:{width or ''}.{digits}f}" if abs(value) < 100 else f"{value:{width or ''}.0e}"
