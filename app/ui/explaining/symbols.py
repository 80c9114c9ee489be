"""The table of symbols: the letter of each quantity of the lecture, and its word in tables of code.

Formulas and displayed programs use letters: u and v on the viewport, W and H, d and e. Vectors are
bold in formulas. Programs have neither bold nor italic type, so they write `cam.u` and `cam.d`:
there, `d` is the direction, and `u` is on the viewport. The checker's tables of mistakes, the
stepper's loops and the panel's tooltips are written with words; program() and spoken() translate
them. Tasks of courses whose programs use words keep them (`notation = "code"`).
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from typing import Literal

Notation = Literal["book", "code"]  # letters, or words


@dataclass(frozen=True)
class Symbol:
    """A quantity. of_camera: a program that uses letters writes `cam.` before it."""

    book: str
    code: str
    is_vector: bool = False
    of_camera: bool = False

    @property
    def letter(self) -> str:
        """The symbol in a program that uses letters."""
        return f"cam.{self.book}" if self.of_camera else self.book


TABLE = (
    Symbol("u", "x"),
    Symbol("v", "y"),
    Symbol("W", "width"),
    Symbol("H", "height"),
    Symbol("d", "distance", of_camera=True),
    Symbol("e", "eye", is_vector=True, of_camera=True),
    Symbol("u", "u", is_vector=True, of_camera=True),
    Symbol("v", "v", is_vector=True, of_camera=True),
    Symbol("w", "w", is_vector=True, of_camera=True),
    Symbol("p", "origin", is_vector=True),
    Symbol("d", "direction", is_vector=True),
    Symbol("x", "point", is_vector=True),
)

_LETTERS = {one.code: one.letter for one in TABLE} | {
    f"{camera}.{one.code}": f"{camera}.{one.book}"
    for camera in ("cam", "camera")
    for one in TABLE
    if one.of_camera
}
_ARGUMENTS = {one.code: one.book for one in TABLE if one.code not in ("x", "y", "point")}
_VECTORS = {one.letter for one in TABLE if one.is_vector}
_NAME = re.compile(r"(?<![\w.])(?:cam(?:era)?\.)?[A-Za-z_]\w*")


def answer(name: str) -> str:
    """Return the name of an exercise's answer: a vector, a part of a ray, or numbers such as
    `left, top, d`.
    """
    return f"{name} {_ARGUMENTS[name]}" if name in ("origin", "direction") else name


def program(code: str, notation: Notation = "book") -> str:
    """Return a program that is written with words, in a notation."""
    return code if notation == "code" else _renamed(code, _LETTERS)


def formula(code: str) -> str:
    """Return code that is written with words as a formula."""
    names = {one.code: rf"\mathbf{{{one.book}}}" if one.is_vector else one.book for one in TABLE}
    return _NAME.sub(lambda found: names.get(found[0], found[0]), code).replace("*", r"\,")


def vectors(code: str) -> list[tuple[int, str, str]]:
    """Return the vectors in a line of a shown program: the column, the text, the vector's name."""
    return [
        (found.start(), found[0], found[0].removeprefix("cam."))
        for found in _NAME.finditer(code)
        if found[0] in _VECTORS
    ]


def arguments(text: str, notation: Notation) -> str:
    """Return the arguments of a function, or fields of a camera, in a notation: `i, W, e`."""
    return text if notation == "code" else _renamed(text, _ARGUMENTS)


def words(text: str, notation: Notation = "book") -> str:
    """Return a text in a notation. Its code, between backticks, is written with words."""
    parts = text.split("`")
    parts[1::2] = [program(part, notation) for part in parts[1::2]]
    return "`".join(parts)


@functools.lru_cache(256)
def spoken(text: str, notation: Notation = "book") -> str:
    """Return words() without the backticks, for text in which code has no font of its own."""
    return words(text, notation).replace("`", "")


def _renamed(code: str, names: dict[str, str]) -> str:
    return _NAME.sub(lambda found: names.get(found[0], found[0]), code)
