"""Numbers and vectors as people type them: 1/8, -0.125, 1/sqrt(2), (0, 1, -3/4).

Pure. Number fields and exercises accept the same syntax.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.system.errors import LucidaError

LONGEST = 80  # characters of one number
FUNCTIONS: dict[str, Callable[[float], float]] = {"sqrt": math.sqrt}
CONSTANTS = {"pi": math.pi}
_PLAIN = {"\u2212": "-", "\u00b7": "*", "\u221a": "sqrt", "\u03c0": "pi"}

_OPERATIONS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
}


def number(text: str) -> float:
    """Return the value of a number: decimals, fractions, sums, products, brackets, sqrt() and pi.

    Raises LucidaError if the text is not a number.
    """
    tidy = text.strip()
    for sign, plain in _PLAIN.items():
        tidy = tidy.replace(sign, plain)
    if not tidy:
        raise LucidaError("", "is empty", "give a number such as 0.25 or 1/4")
    if len(tidy) > LONGEST:
        raise LucidaError("", "is too long", "give a number such as 0.25 or 1/4")
    try:
        value = _value(ast.parse(tidy, mode="eval").body)
    except ZeroDivisionError:
        raise LucidaError("", f"{text.strip()!r} divides by zero", "correct it") from None
    except (SyntaxError, ValueError, OverflowError, RecursionError, MemoryError):
        raise LucidaError(
            "", f"{text.strip()!r} is not a number", "give one such as 0.25, 1/4 or 1/sqrt(2)"
        ) from None
    if not math.isfinite(value):
        raise LucidaError("", f"{text.strip()!r} is not finite", "give a finite number")
    return value


def vector(text: str) -> NDArray[np.float64]:
    """Parse three numbers, separated by commas, semicolons or blanks, with or without brackets."""
    tidy = text.strip()
    if tidy[:1] in ("(", "[") and tidy[-1:] in (")", "]") and _is_enclosed(tidy):
        tidy = tidy[1:-1]
    separator = next((sign for sign in (";", ",") if sign in tidy), None)
    parts = tidy.split(separator)
    if len(parts) != 3:
        problem = f"{text.strip()!r} is not three numbers" if tidy else "enter three numbers"
        raise LucidaError("", problem, "give a vector such as (1/8, 0, -1)")
    if not all(part.strip() for part in parts):
        raise LucidaError("", "one of the three numbers is missing", "give all three")
    return np.array([number(part) for part in parts])


def text_of(value: float) -> str:
    """Return a number as a lecture writes it: as a small fraction if it is one, or with four
    decimals.
    """
    for below in (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32):
        above = round(value * below)
        if abs(value * below - above) < 1e-9:
            return f"{above}" if below == 1 else f"{above}/{below}"
    return f"{value:.4g}"


def vector_text(values: NDArray[np.float64]) -> str:
    """Return a vector as text, such as (1/8, 0, -1)."""
    return "(" + ", ".join(text_of(float(value)) for value in values) + ")"


def _is_enclosed(text: str) -> bool:
    """Return True if the last character closes the first bracket, and none closes it earlier."""
    depth = 0
    for at, sign in enumerate(text):
        depth += (sign in "([") - (sign in ")]")
        if depth == 0:
            return at == len(text) - 1
    return False


def _value(node: ast.expr) -> float:
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return float(value)
        case ast.Name(id=name) if name in CONSTANTS:
            return CONSTANTS[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_value(operand)
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return _value(operand)
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in _OPERATIONS:
            return _OPERATIONS[type(operator)](_value(left), _value(right))
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
            return FUNCTIONS[name](_value(argument))
    raise ValueError("not a number")
