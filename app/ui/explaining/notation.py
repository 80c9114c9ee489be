"""Numbers and vectors as formulas write them, in LaTeX; and numbers as plain text."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

DECIMALS = 4
FRACTION = 1600  # parts of 1 with at most six decimals, such as those of 32 or 160 pixels


@dataclass(frozen=True)
class Line:
    """One step as LaTeX: in symbols, followed by a pixel's numbers.

    key: the step's id, the same for every pixel.
    name: the step in words.
    latex: `u = ...`.
    latex_numbers: `= ... = 0.125`.
    value: the result, as numbers.
    """

    key: str
    name: str
    latex: str
    latex_numbers: str
    value: tuple[float, ...] = ()


@dataclass(frozen=True)
class Slot:
    """A quantity of a formula: its symbol and its value as LaTeX."""

    latex: str
    latex_value: str


def scalar_slot(latex: str, value: float, factor: bool = False) -> Slot:
    """Return a number for a formula. factor: True in a product, to bracket negative numbers."""
    shown = latex_number(value)
    bracketed = factor and (value < 0 or "cdot" in shown)
    return Slot(latex, f"({shown})" if bracketed else shown)


def vector_slot(name: str, value: Iterable[float]) -> Slot:
    r"""Return a bold vector, `\mathbf{name}`."""
    return Slot(bold(name), latex_tuple(value))


def formula(
    key: str,
    name: str,
    left: str,
    right: str,
    slots: Mapping[str, Slot],
    value: float | Iterable[float],
    result: str | None = None,
) -> Line:
    """Return a line `left = right`.

    right: the right side, with slots as `<name>`. result: the value's LaTeX; None: results(value).
    """
    values = (value,) if isinstance(value, int | float) else tuple(value)
    result = results(values) if result is None else result
    symbols = numbers = right
    for slot_name, slot in slots.items():
        symbols = symbols.replace(f"<{slot_name}>", slot.latex)
        numbers = numbers.replace(f"<{slot_name}>", slot.latex_value)
    is_plain = not slots or numbers in ("", result)
    shown = f"= {result}" if is_plain else f"= {numbers} = {result}"
    return Line(key, name, f"{left} = {symbols}", shown, values)


def results(values: Iterable[float]) -> str:
    """Return a computed number or tuple as LaTeX.

    Numbers have four decimals, so that nothing jumps while they change. Exact numbers are shorter,
    and a pixel's fractions are complete, so that they match calculations by hand.
    """
    values = _rounded(values)
    fixed = not all(_is_exact(value) for value in values)
    return latex_number(values[0], fixed) if len(values) == 1 else latex_tuple(values, fixed)


def bold(name: str) -> str:
    """Return `n_1` as a bold n with a plain index."""
    letter, _, index = name.partition("_")
    return rf"\mathbf{{{letter}}}" + (f"_{{{index}}}" if index else "")


def number(value: float, fixed: bool = False) -> str:
    """Return a number with at most four decimals, or six for a pixel's fraction.

    Very small and large numbers are written as 1.23e-05. fixed: always write four decimals.
    """
    if not math.isfinite(value):
        return {math.inf: "inf", -math.inf: "-inf"}.get(value, "none")
    if value != 0 and not 5e-4 <= abs(value) < 1e6:
        return f"{value:.3g}" if not fixed else f"{value:.2e}"
    text = f"{value:.{DECIMALS if fixed or not _is_exact(value) else 6}f}"
    if not fixed:
        text = text.rstrip("0").rstrip(".")
    return text.removeprefix("-") if float(text) == 0 else text


def latex_number(value: float, fixed: bool = False) -> str:
    r"""Return number() as LaTeX, with exponents as powers of ten and infinity as \infty."""
    text = number(value, fixed)
    if text in ("inf", "-inf"):
        return text.replace("inf", r"\infty")
    if text == "none":
        return r"\mathrm{none}"
    digits, _, exponent = text.partition("e")
    return rf"{digits} \cdot 10^{{{int(exponent)}}}" if exponent else digits


def latex_tuple(values: Iterable[float], fixed: bool = False) -> str:
    return "(" + r",\ ".join(latex_number(value, fixed) for value in _rounded(values)) + ")"


def text_tuple(values: Iterable[float], fixed: bool = False) -> str:
    return "(" + ", ".join(number(value, fixed) for value in _rounded(values)) + ")"


def _rounded(values: Iterable[float]) -> tuple[float, ...]:
    """Replace values by 0 if they are only rounding errors relative to the largest value."""
    values = tuple(values)
    least = 1e-12 * max(map(abs, values))
    return tuple(0.0 if abs(value) <= least else value for value in values)


def _is_exact(value: float) -> bool:
    """Return True if four decimals are exact, or six for a pixel's fraction."""
    least = 1e-9 * abs(value)
    fraction = round(value * FRACTION) / FRACTION if math.isfinite(value) else value
    return abs(value - round(value, DECIMALS)) <= least or abs(value - fraction) <= least
