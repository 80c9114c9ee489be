"""A lecture's text broken into lines and laid out in a column of any width.

The caller's function measures words and formulas. Lengths are in pixels, with y downwards from the
column's top.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from lucida.app.ui.explaining.breaking import breakable, broken, narrowed

from .text import (
    Block,
    Code,
    DisplayedFormula,
    Heading,
    ItemList,
    Line,
    Math,
    Paragraph,
    Question,
    Words,
)

# Lengths relative to the text's size.
LEADING = 1.18  # from line to line
CODE_LEADING = 1.1
PARAGRAPH = 0.5  # between blocks
ITEM = 0.2  # between a list's items
INDENT = 1.25  # of a list, at least
HEADING_SIZE = 1.25
ASIDE = 0.8  # at the left of a question's text
WHOLE_CODE = 16  # longest code in a sentence that is not broken, in letters


@dataclass(frozen=True)
class PieceSize:
    """The size of a piece: ascent above the baseline, descent below it."""

    width: float
    ascent: float
    descent: float


@dataclass(frozen=True)
class Piece:
    """A word, several words, or a formula.

    size: of its text. style: "text", "bold", "vector" (a single bold word, which may be a vector's
    name), "italic", "code" or "math" (LaTeX). display: a formula on its own line.
    """

    text: str
    style: str
    size: float
    display: bool = False


@dataclass(frozen=True)
class Placed:
    """A piece in its place: its left edge and its baseline.

    kind: of the block it is in.
    """

    piece: Piece
    x: float
    baseline: float
    kind: str


@dataclass(frozen=True)
class Backdrop:
    """The background of a block, "code" or "question": left, top, right, bottom."""

    kind: str
    left: float
    top: float
    right: float
    bottom: float


@dataclass(frozen=True)
class Laid:
    """A column of text. height: of the whole column. width: of its widest line."""

    pieces: tuple[Placed, ...]
    boxes: tuple[Backdrop, ...]
    height: float
    width: float


class Measure(Protocol):
    """A function that measures pieces."""

    def __call__(self, piece: Piece) -> PieceSize: ...


def lay(blocks: tuple[Block, ...], width: float, size: float, measure: Measure) -> Laid:
    """Lay out the blocks in a column. size: of the text."""
    column = _Column(width, size, measure)
    for number, block in enumerate(blocks):
        if number:
            column.y += PARAGRAPH * size
        column.block(block)
    right = max((p.x + measure(p.piece).width for p in column.pieces), default=0.0)
    return Laid(tuple(column.pieces), tuple(column.boxes), column.y, right)


class _Column:
    """A column that is filled downwards from y."""

    def __init__(self, width: float, size: float, measure: Measure) -> None:
        self.y = 0.0
        self.pieces: list[Placed] = []
        self.boxes: list[Backdrop] = []
        self._width, self._size, self._measure = width, size, measure

    def block(self, block: Block) -> None:
        size = self._size
        match block:
            case Heading(line=line):
                self._lines(line, 0.0, HEADING_SIZE * size, "heading", bold=True)
            case Paragraph(line=line):
                self._lines(line, 0.0, size, "text")
            case Question(line=line):
                top = self.y
                self.y += 0.35 * size
                self._lines(line, ASIDE * size, size, "question")
                self.y += 0.35 * size
                self.boxes.append(Backdrop("question", 0.0, top, self._width, self.y))
            case ItemList():
                self._listing(block)
            case Code(text=text):
                self._code(text)
            case DisplayedFormula(latex=latex):
                self._formula(latex)

    def _listing(self, block: ItemList) -> None:
        size, items = self._size, block.items
        marks = [
            Piece(f"{number}." if block.numbered else "•", "text", size)
            for number, _ in enumerate(items, start=1)
        ]
        widths = [self._measure(mark).width + 0.4 * size for mark in marks]
        indent = max(INDENT * size, *widths)
        for number, item in enumerate(items):
            if number:
                self.y += ITEM * size
            first = len(self.pieces)
            self._lines(item, indent, size, "item")
            baseline = self.pieces[first].baseline if len(self.pieces) > first else self.y
            self._put(marks[number], indent - widths[number], baseline, "mark")

    def _formula(self, latex: str) -> None:
        """Lay out a formula. Break it at its signs into several rows if it is too wide."""
        size, row = self._size, ""
        rows: list[str] = []
        for part in breakable(latex):
            longer = f"{row} {part}".strip()
            if row and self._formula_width(longer) > self._width:
                rows.append(row)
                longer = part
            row = longer
        rows.append(row)
        widest = max(map(self._formula_width, rows))
        left = max(0.0, min(INDENT * size, self._width - widest))
        for number, one in enumerate(rows):
            piece = Piece(one, "math", size, display=True)
            extent = self._measure(piece)
            self.y += (0.15 if number == 0 else 0.3) * size
            self._put(piece, left, self.y + extent.ascent, "formula")
            self.y += extent.ascent + extent.descent
        self.y += 0.15 * size

    def _formula_width(self, latex: str) -> float:
        return self._measure(Piece(latex, "math", self._size, display=True)).width

    def _code(self, text: str) -> None:
        """Lay out lines of code. Continue a long one in the next row, and then indent all less."""
        size, inset = self._size, 0.5 * self._size
        letter = self._measure(Piece("0", "code", size)).width
        letters = max(8, int((self._width - 2 * inset) / letter))
        top = self.y
        self.y += inset
        lines = tuple(text.splitlines()) or ("",)
        if max(map(len, lines)) > letters:
            lines = narrowed(lines)
        for line in lines:
            for row in broken(line, letters):
                if row:
                    piece = Piece(row, "code", size)
                    self._put(piece, inset, self.y + self._measure(piece).ascent, "code")
                self.y += CODE_LEADING * size
        self.y += inset - 0.1 * size
        self.boxes.append(Backdrop("code", 0.0, top, self._width, self.y))

    def _lines(self, line: Line, left: float, size: float, kind: str, bold: bool = False) -> None:
        """Lay out a paragraph, broken into lines."""
        space = self._measure(Piece(" ", "text", size)).width
        x = left
        row: list[tuple[Piece, PieceSize, float]] = []
        for atom in _atoms(line, size, bold):
            extents = [self._measure(piece) for piece in atom]
            wide = sum(extent.width for extent in extents)
            if row and x + wide > self._width:
                self._end_row(row, size, kind)
                row, x = [], left
            for piece, extent in zip(atom, extents, strict=True):
                row.append((piece, extent, x))
                x += extent.width
            x += space
        self._end_row(row, size, kind)

    def _end_row(self, row: list[tuple[Piece, PieceSize, float]], size: float, kind: str) -> None:
        """Place a row. Tall formulas move it and the next one down."""
        if not row:
            return
        usual = self._measure(Piece("x", "text", size))
        air = (LEADING * size - usual.ascent - usual.descent) / 2
        above = max(max(extent.ascent for _, extent, _ in row), usual.ascent)
        below = max(max(extent.descent for _, extent, _ in row), usual.descent)
        baseline = self.y + air + above
        for piece, _, x in row:
            self._put(piece, x, baseline, kind)
        self.y = baseline + below + air

    def _put(self, piece: Piece, x: float, baseline: float, kind: str) -> None:
        self.pieces.append(Placed(piece, x, baseline, kind))


def _atoms(line: Line, size: float, bold: bool) -> Iterator[list[Piece]]:
    """Return the parts that must not be broken: words, with the formulas and signs that
    touch them.
    """
    atom: list[Piece] = []
    for span in line:
        if isinstance(span, Math):
            atom.append(Piece(span.latex, "math", size))
            continue
        is_whole = span.code and len(span.text) <= WHOLE_CODE
        for part in [span.text] if is_whole else re.findall(r"\s+|\S+", span.text):
            if not part.isspace():
                atom.append(Piece(part, _style(span, bold), size))
            elif atom:
                yield atom
                atom = []
    if atom:
        yield atom


def _style(words: Words, bold: bool) -> str:
    if words.code:
        return "code"
    if words.bold and " " not in words.text:
        return "vector"
    if words.bold or bold:
        return "bold"
    return "italic" if words.italic else "text"
