"""Numbers and vectors as formulas write them: as LaTeX, and as plain text."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

DECIMALS = 4
FRACTION = 1600  # parts of 1 that have at most six decimals: those of 32 or 160 pixels, say


@dataclass(frozen=True)
class Line:
    """One step: in symbols, followed by a pixel's numbers.

    key: the step's id, the same for every pixel.
    name: in words.
    latex, text: `u = ...`.
    latex_numbers, text_numbers: `= ... = 0.125`.
    value: the result, as numbers.
    """

    key: str
    name: str
    latex: str
    latex_numbers: str
    text: str
    text_numbers: str
    value: tuple[float, ...] = ()


@dataclass(frozen=True)
class Slot:
    """A quantity of a formula: its symbol and its value, each as LaTeX and as text."""

    latex: str
    text: str
    latex_value: str
    text_value: str


def scalar_slot(latex: str, value: float, text: str | None = None, factor: bool = False) -> Slot:
    """Return a number for a formula. factor: part of a product, so negative ones get brackets."""
    shown, plain = latex_number(value), number(value)
    if factor and (value < 0 or "e" in plain):
        shown, plain = rf"({shown})", f"({plain})"
    return Slot(latex, latex if text is None else text, shown, plain)


def vector_slot(name: str, value: Iterable[float], text: str | None = None) -> Slot:
    r"""Return a bold vector: `\mathbf{name}`, as text `vec(name)`."""
    value = tuple(value)
    plain = f"vec({name})" if text is None else text
    return Slot(bold(name), plain, latex_tuple(value), text_tuple(value))


def formula(
    key: str,
    name: str,
    left: tuple[str, str],
    right: tuple[str, str],
    slots: Mapping[str, Slot],
    value: float | Iterable[float],
    result: tuple[str, str] | None = None,
) -> Line:
    """Return a line `left = right`.

    left, right: as LaTeX and as text; on the right side, `<name>` is a slot. result: how the value
    is written, if not as a number or a tuple.
    """
    values = (value,) if isinstance(value, int | float) else tuple(value)
    if result is None:
        result = results(values)
    latex, latex_numbers = (_filled(right[0], slots, kind) for kind in ("latex", "latex_value"))
    text, text_numbers = (_filled(right[1], slots, kind) for kind in ("text", "text_value"))
    return Line(
        key,
        name,
        f"{left[0]} = {latex}",
        _equal(latex_numbers if slots else "", result[0]),
        f"{left[1]} = {text}",
        _equal(text_numbers if slots else "", result[1]),
        values,
    )


def results(values: Iterable[float]) -> tuple[str, str]:
    """Return a computed number, or a tuple, as LaTeX and as text.

    It always has four decimals, so that nothing jumps while it changes. Exact numbers are shorter,
    and a pixel's fractions are complete, so that they match calculations by hand.
    """
    values = _rounded(values)
    fixed = not all(_is_exact(value) for value in values)
    if len(values) == 1:
        return latex_number(values[0], fixed), number(values[0], fixed)
    return latex_tuple(values, fixed), text_tuple(values, fixed)


def bold(name: str) -> str:
    """Return `n_1` as a bold n with a plain index."""
    letter, _, index = name.partition("_")
    return rf"\mathbf{{{letter}}}" + (f"_{{{index}}}" if index else "")


def number(value: float, fixed: bool = False) -> str:
    """Return a number with at most four decimals, or six for a fraction; fixed: always four. Very
    small and large ones are written as 1.23e-05.
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
    r"""Return the same as LaTeX: exponents as powers of ten, infinity as \infty."""
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
    """Replace by 0 what is only rounding, relative to the largest value."""
    values = tuple(values)
    least = 1e-12 * max(map(abs, values))
    return tuple(0.0 if abs(value) <= least else value for value in values)


def _is_exact(value: float) -> bool:
    """Return True if four decimals are exact, or six of a fraction that pixels have."""
    least = 1e-9 * abs(value)
    fraction = round(value * FRACTION) / FRACTION if math.isfinite(value) else value
    return abs(value - round(value, DECIMALS)) <= least or abs(value - fraction) <= least


def _filled(template: str, slots: Mapping[str, Slot], kind: str) -> str:
    for name, slot in slots.items():
        template = template.replace(f"<{name}>", getattr(slot, kind))
    return template


def _equal(expression: str, result: str) -> str:
    """Return `= expression = result`, or only the result."""
    return f"= {result}" if expression in ("", result) else f"= {expression} = {result}"
