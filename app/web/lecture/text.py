"""A lecture's text as HTML. All of it is escaped."""

from __future__ import annotations

import re
from html import escape

from lucida.app.lecture.text import (
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
    parse,
)
from lucida.renderer.system.errors import visible

from .mathml import VECTORS, displayed, inline


def plain(text: str) -> str:
    """Return text, escaped for a page."""
    return escape(visible(text))


def written(text: str) -> str:
    """Return a lecture's text, such as a reply, as HTML."""
    return blocks_html(parse(text))


# A formula, and punctuation that must not begin the next line.
BEFORE_STOP = re.compile(r"(<math\b(?:(?!</math>).)*</math>)([.,;:?!)]+)", re.DOTALL)


def blocks_html(blocks: tuple[Block, ...]) -> str:
    """Return a text as HTML."""
    return "".join(map(_block, blocks))


def _block(block: Block) -> str:
    match block:
        case Heading(level=level, line=line):
            name = f"h{min(level + 2, 6)}"
            return f"<{name}>{_line(line)}</{name}>\n"
        case Paragraph(line=line):
            return f"<p>{_line(line)}</p>\n"
        case Question(line=line):
            return f'<div class="question"><p>{_line(line)}</p>\n</div>\n'
        case ItemList():
            name = "ol" if block.numbered else "ul"
            items = "".join(f"<li>{_line(item)}</li>" for item in block.items)
            return f"<{name}>{items}</{name}>\n"
        case Code(text=text):
            return f'<pre tabindex="0"><code>{plain(text)}</code></pre>\n'
        case DisplayedFormula(latex=latex):
            return displayed(latex)
    raise AssertionError(block)


def _line(line: Line) -> str:
    html = "".join(inline(span.latex) if isinstance(span, Math) else _words(span) for span in line)
    return BEFORE_STOP.sub(r'<span class="kept">\1\2</span>', html)


def _words(words: Words) -> str:
    html = plain(words.text)
    if words.code:
        html = f"<code>{html}</code>"
    if words.bold:
        name = words.text.strip(".,:;()")
        color = f' class="vector-{name}"' if name in VECTORS else ""
        html = f"<strong{color}>{html}</strong>"
    return f"<em>{html}</em>" if words.italic else html
