"""Check that formulas can be typeset: find commands unknown to MicroTeX, and its errors.

The check works without a window, on any thread. MicroTeX raises an error for an invalid formula,
and
draws an unknown command as typed, in red.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np
from imgui_bundle import ImVec4, imgui_microtex

from lucida.app.ui.formula import available
from lucida.renderer.system.errors import LucidaError, one_line

from .model import Written

_SIZE_PX = 24.0
_WHITE = ImVec4(1, 1, 1, 1)
_COMMAND = re.compile(r"\\(?:[A-Za-z]+|.)", re.DOTALL)
_COLORED = re.compile(
    r"\\(?:textcolor|color|fgcolor|bgcolor|colorbox|fcolorbox)\s*(?:\[[^\]]*\])?\s*\{[^{}]*\}"
)
_IN_PAIRS = (r"\left", r"\right", r"\begin", r"\end")  # unknown when they are alone


def first_mistake(formulas: Iterable[Written]) -> LucidaError | None:
    """Return an error for the first formula that cannot be typeset.

    Return None if there is none, or if formulas are shown as text here.
    """
    for written in formulas:
        told = mistake(written.latex)
        if told is not None:
            at, problem = told
            where = f"{written.source}:{written.line + written.latex.count(chr(10), 0, at)}"
            return LucidaError(written.field, problem, "correct the formula", where)
    return None


def mistake(latex: str) -> tuple[int, str] | None:
    """Return the error in a formula and the character at which it begins; None if it can be
    typeset.
    """
    if not available():
        return None
    try:
        if not _has_red(_COLORED.sub("", latex)):
            return None
    except RuntimeError as error:
        reason = one_line(str(error)).split("caused by:")[-1].strip().rstrip("!.")
        return 0, f"{_short(latex)} cannot be set: {reason}"
    commands = list(_COMMAND.finditer(latex))
    commands.sort(key=lambda command: command[0] in _IN_PAIRS)  # pairs last
    for command in commands:
        if _is_unknown(command[0]):
            if command[0] in _IN_PAIRS:
                problem = (
                    f"{command[0]} in {_short(latex)} has no partner, or is of an unknown kind"
                )
                return command.start(), problem
            return command.start(), f"{command[0]} is no command that formulas know"
    return 0, f"{_short(latex)} holds what formulas do not know"


def _is_unknown(command: str) -> bool:
    try:
        return _has_red(command)
    except RuntimeError:  # it needs an argument
        return False


def _has_red(latex: str) -> bool:
    made = imgui_microtex.render(latex, _SIZE_PX, _WHITE)
    if not made.width or not made.height:
        return False
    pixels = np.asarray(made.pixels_as_array())
    red = (pixels[..., 0] > 0) & (pixels[..., 1] == 0) & (pixels[..., 2] == 0)
    return bool((red & (pixels[..., 3] > 0)).any())


def _short(latex: str) -> str:
    """Return the beginning of a formula in quotes, without repr()'s doubled backslashes."""
    return f"'{one_line(latex[:40])}'"
