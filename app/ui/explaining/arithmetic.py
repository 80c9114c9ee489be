"""Numbers and vectors as people type them: 1/8, -0.125, 1/sqrt(2), (0, 1, -3/4).

Pure. Number fields and exercises accept the same.
"""

from __future__ import annotations

import ast
import contextlib
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

    Raises LucidaError if it is not one.
    """
    tidy = text.strip()
    for sign, plain in _PLAIN.items():
        tidy = tidy.replace(sign, plain)
    value = math.nan
    with contextlib.suppress(SyntaxError, ValueError, ArithmeticError, RecursionError, MemoryError):
        if len(tidy) <= LONGEST:
            value = _value(ast.parse(tidy, mode="eval").body)
    if not math.isfinite(value):
        raise LucidaError(
            "", f"{tidy[:LONGEST]!r} is not a number", "give one such as 0.25, 1/4 or 1/sqrt(2)"
        )
    return value


def vector(text: str) -> NDArray[np.float64]:
    """Parse three numbers, separated by commas, semicolons or blanks, with or without brackets."""
    tidy = text.strip()
    inner = tidy[1:-1] if tidy[:1] in ("(", "[") and tidy[-1:] in (")", "]") else tidy
    for whole in (inner, tidy):  # (1+2)/3, 0, (1-2)/3 has no brackets around it
        separator = next((sign for sign in (";", ",") if sign in whole), None)
        parts = whole.split(separator)
        with contextlib.suppress(LucidaError):
            if len(parts) == 3:
                return np.array([number(part) for part in parts])
    problem = f"{tidy!r} is not three numbers" if tidy else "enter three numbers"
    raise LucidaError("", problem, "give a vector such as (1/8, 0, -1)")


def text_of(value: float) -> str:
    """Return a number as a lecture writes it: as a small fraction if it is one, else with four
    decimals.
    """
    for below in (1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32):
        above = round(value * below)
        if abs(value * below - above) < 1e-9:
            return f"{above}" if below == 1 else f"{above}/{below}"
    return f"{value:.4g}"


def vector_text(values: NDArray[np.float64]) -> str:
    """Return (1/8, 0, -1)."""
    return "(" + ", ".join(text_of(float(value)) for value in values) + ")"


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
