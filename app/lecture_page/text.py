"""A lecture's text as HTML. All of it is escaped."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable
from html import escape

from app.explaining.languages import LANGUAGES
from app.lecture.notation import in_notation
from app.lecture.text import (
    Answer,
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
    stages,
)
from app.lecture_page.mathml import VECTORS, displayed, inline
from app.state.options import Notation
from renderer.errors import visible


def plain(text: str) -> str:
    """Return text, escaped for a page."""
    return escape(visible(text))


def written(text: str, notation: Notation) -> str:
    """Return a lecture's text, such as a reply, as HTML."""
    return blocks_html(parse(text), notation)


class Links:
    """Writes the links of a step's text. shown: their names that have a picture."""

    def __init__(self, step: int, shown: Iterable[str] = ()) -> None:
        self._step, self._shown = step, frozenset(shown)

    def html(self, name: str, words: str) -> str:
        """Return a button that shows the link's picture; only words if it has none."""
        if name not in self._shown:
            return words
        shows = f"{self._step}-{plain(name)}"
        return (
            f'<button type="button" class="link" aria-pressed="false" data-shows="{shows}">'
            f"{words}</button>"
        )


NO_LINKS = Links(0)
# A link or a formula, and what must not begin the next line.
BEFORE_STOP = re.compile(r"(<(button|math)\b(?:(?!<\2\b).)*?</\2>)([.,;:?!)]+)", re.DOTALL)


def blocks_html(
    blocks: tuple[Block, ...], notation: Notation, links: Links = NO_LINKS, answers: bool = True
) -> str:
    """Return a text as HTML.

    What is uncovered one by one has its number in data-stage. answers: with the answers to the
    questions.
    """
    writer = _Writer(stages(blocks), links)
    shown = in_notation(blocks, notation)
    if not answers:
        shown = tuple(block for block in shown if not isinstance(block, Answer))
    grouped = itertools.groupby(shown, _kind)
    return "".join(writer.group(kind, list(group)) for kind, group in grouped)


def _kind(block: Block) -> str:
    if isinstance(block, Question | Answer):
        return "question"
    return "program" if isinstance(block, Code) and block.language in LANGUAGES else ""


class _Writer:
    """Writes blocks. stages: of all of them; the last is the answer's."""

    def __init__(self, stages: int, links: Links) -> None:
        self._stages, self._stage, self._links = stages, 0, links

    def group(self, kind: str, blocks: list[Block]) -> str:
        """Return neighbours of one kind."""
        inside = "".join(map(self._block, blocks))
        if kind == "question":
            return f'<div class="question">{inside}</div>\n'
        if kind == "program" and len(blocks) > 1:
            return f'<div class="programs">{inside}</div>\n'
        return inside

    def _block(self, block: Block) -> str:
        match block:
            case Heading(level=level, line=line):
                name = f"h{min(level + 2, 6)}"
                return f"<{name}>{self._line(line)}</{name}>\n"
            case Paragraph(line=line) | Question(line=line):
                return f"<p>{self._line(line)}</p>\n"
            case Answer(line=line):
                answer = self._line(line)
                return f'<p class="answer" data-stage="{self._stages}">{answer}</p>\n'
            case ItemList():
                name = "ol" if block.numbered else "ul"
                items = "".join(self._item(item, block.covered) for item in block.items)
                return f"<{name}>{items}</{name}>\n"
            case Code(text=text, language=language):
                of = f' data-language="{language}"' if language in LANGUAGES else ""
                return f'<pre tabindex="0"{of}><code>{plain(text)}</code></pre>\n'
            case DisplayedFormula(latex=latex):
                return displayed(latex)
        raise AssertionError(block)

    def _item(self, line: Line, covered: bool) -> str:
        if not covered:
            return f"<li>{self._line(line)}</li>"
        self._stage += 1
        return f'<li data-stage="{self._stage}">{self._line(line)}</li>'

    def _line(self, line: Line) -> str:
        html = "".join(
            inline(span.latex) if isinstance(span, Math) else self._words(span) for span in line
        )
        return BEFORE_STOP.sub(r'<span class="kept">\1\3</span>', html)

    def _words(self, words: Words) -> str:
        html = plain(words.text)
        if words.code:
            html = f"<code>{html}</code>"
        if words.bold:
            name = words.text.strip(".,:;()")
            color = f' class="vector-{name}"' if name in VECTORS else ""
            html = f"<strong{color}>{html}</strong>"
        if words.italic:
            html = f"<em>{html}</em>"
        return self._links.html(words.link, html) if words.link else html
