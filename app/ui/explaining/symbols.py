r"""The table of symbols: each quantity of the lecture in the two notations that users choose from.

book  the lecture's letters: u and v on the viewport, W and H, d and e; vectors are bold
code  words, as programs have them: x, y, width, height, distance, eye

Formulas, and programs with the lecture's letters, are written in *book*: latex(), plain() and
lettered() translate them. The checker's tables of mistakes are written in *code*: program() and
words() translate those. A program that uses letters says `cam.u` and `cam.d`, because it has
neither bold nor italic type: `d` is the direction there, and `u` is on the viewport.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass, replace

from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining.notation import Line


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
NAMES: dict[Notation, str] = {
    "book": "the book: u, v, W, H, e",
    "code": "code: x, y, width, height, eye",
}

_VECTORS = {one.book: one.code for one in TABLE if one.is_vector}
_SCALARS = {one.book: one.code for one in TABLE if not one.is_vector}
_LETTERS = {one.code: one.letter for one in TABLE} | {
    f"{camera}.{one.code}": f"{camera}.{one.book}"
    for camera in ("cam", "camera")
    for one in TABLE
    if one.of_camera
}
_WORDS = {one.letter: one.code for one in TABLE}
_ARGUMENTS = {one.code: one.book for one in TABLE if one.code not in ("x", "y", "point")}
_LATEX = re.compile(
    r"\\mathbf\{(?P<vector>\w+)\}"
    r"|\\(?:mathrm|mathit|text|begin|end)\{[^{}]*\}|\\[A-Za-z]+|_(?:\{[^{}]*\}|\w)"  # stays
    r"|(?<![A-Za-z])(?P<scalar>[A-Za-z])(?![A-Za-z])"
)
_PLAIN = re.compile(r"vec\((?P<vector>\w+)\)|(?<![\w.])(?P<scalar>[A-Za-z])(?!\w)")
_NAME = re.compile(r"(?<![\w.])(?:cam(?:era)?\.)?[A-Za-z_]\w*")


def latex(formula: str, notation: Notation) -> str:
    """Return a formula of the book in a notation."""

    def shown(found: re.Match[str]) -> str:
        if found["vector"] is not None:
            return rf"\mathbf{{{vector(found['vector'], notation)}}}"
        word = _SCALARS.get(found["scalar"] or "", "")
        return rf"\mathit{{{word}}}" if len(word) > 1 else word or found[0]

    return formula if notation == "book" else _LATEX.sub(shown, formula)


def plain(text: str, notation: Notation) -> str:
    """Return a formula of the book as plain text, where vectors are vec(u), in a notation."""

    def shown(found: re.Match[str]) -> str:
        if found["vector"] is not None:
            return f"vec({vector(found['vector'], notation)})"
        return _SCALARS.get(found["scalar"], found[0])

    return text if notation == "book" else _PLAIN.sub(shown, text)


def vector(name: str, notation: Notation) -> str:
    """Return the name of a vector of the book in a notation."""
    return name if notation == "book" else _VECTORS.get(name, name)


def answer(name: str, notation: Notation) -> str:
    """Return the name of what an exercise asks for: a vector, a part of a ray, or numbers such as
    `left, top, d`.
    """
    if name in ("origin", "direction"):
        return f"{name} {_ARGUMENTS[name]}" if notation == "book" else name
    return vector(name, notation) if len(name) == 1 else plain(name, notation)


def in_notation(line: Line, notation: Notation) -> Line:
    """Return a line of the book in a notation."""
    if notation == "book":
        return line
    return replace(
        line,
        name=plain(line.name, notation),
        latex=latex(line.latex, notation),
        latex_numbers=latex(line.latex_numbers, notation),
    )


def program(code: str, notation: Notation) -> str:
    """Return a program that is written in code's words in a notation."""
    return code if notation == "code" else _renamed(code, _LETTERS)


def lettered(code: str, notation: Notation) -> str:
    """Return a program that is written with the book's letters in a notation."""
    return code if notation == "book" else _renamed(code, _WORDS)


def words(text: str, notation: Notation) -> str:
    """Return a text whose code, between backticks, is in code's words, in a notation."""
    parts = text.split("`")
    parts[1::2] = [program(part, notation) for part in parts[1::2]]
    return "`".join(parts)


def formula(code: str) -> str:
    """Return code in code's words as a formula of the book."""
    names = {one.code: rf"\mathbf{{{one.book}}}" if one.is_vector else one.book for one in TABLE}
    return _NAME.sub(lambda found: names.get(found[0], found[0]), code).replace("*", r"\,")


def vectors(code: str, notation: Notation) -> list[tuple[int, str, str]]:
    """Return the vectors in a line of a program that is shown in a notation: the column, the text,
    the vector's name.
    """
    names = {one.letter if notation == "book" else one.code for one in TABLE if one.is_vector}
    return [
        (found.start(), found[0], found[0].removeprefix("cam."))
        for found in _NAME.finditer(code)
        if found[0] in names
    ]


def arguments(text: str, notation: Notation) -> str:
    """Return the arguments of a function, or fields of a camera, in a notation: `i, W, e`."""
    return text if notation == "code" else _renamed(text, _ARGUMENTS)


@functools.lru_cache(256)
def spoken(text: str, notation: Notation) -> str:
    """Return words() without the backticks, for where code has no type of its own."""
    return words(text, notation).replace("`", "")


def _renamed(code: str, names: dict[str, str]) -> str:
    return _NAME.sub(lambda found: names.get(found[0], found[0]), code)
