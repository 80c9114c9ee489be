"""The words of a lecture's text, for tests that look for them."""

from __future__ import annotations

from lucida.app.lecture.text import Block, Code, DisplayedFormula, ItemList, Line, Words


def plain_text(blocks: tuple[Block, ...]) -> str:
    """The words of a text without their marks; formulas as their LaTeX."""
    parts = []
    for block in blocks:
        match block:
            case ItemList():
                parts += [words_of(item) for item in block.items]
            case Code():
                parts.append(block.text)
            case DisplayedFormula():
                parts.append(block.latex)
            case _:
                parts.append(words_of(block.line))
    return "\n".join(parts)


def words_of(line: Line) -> str:
    """A line's words without their marks."""
    return "".join(span.text if isinstance(span, Words) else span.latex for span in line)
