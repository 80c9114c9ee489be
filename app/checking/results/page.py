"""A class's results as one self-contained HTML file: no network, no script, no other files.

The files that were read may hold anything: all their text is escaped.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from lucida.app.checking.reports.page import STYLE
from lucida.app.checking.results.model import ClassResults, MistakeCount, StepCount, shown, told
from lucida.app.lecture.text import Code, DisplayedFormula, Heading, ItemList, Math, Words, parse
from lucida.renderer.system.errors import LucidaError

TITLE = "What the class answered"
TALK = "To talk about tomorrow"
BY_STEP, UNREAD = "By step", "Not read"
KEY = ("correct at once", "correct later", "not correct yet")
KINDS = ("right", "later", "wrong")
LATEX = (  # what the replies of lectures hold, as signs
    (r"^\mathsf{T}", "ᵀ"), (r"\mathbf", ""), (r"\cdot", "·"), (r"\times", "\u00d7"),
    (r"\,", " "), ("{", ""), ("}", ""), ("-", "\u2212"),
)  # fmt: skip
MORE = """
section h2 { display: block; } h2.part { margin: 2rem 0 .5rem; }
.legend i { display: inline-block; width: .8rem; height: .8rem; margin-right: .3rem;
  border-radius: .15rem; } .legend span { margin-right: .8rem; white-space: nowrap; }
.step, .made { display: grid; grid-template-columns: 2fr 3fr; gap: 0 1rem; margin: .4rem 0; }
.made { margin: 0 0 .2rem; font-size: .9rem; } .made > :first-child { padding-left: 1.2rem; }
.made .dim { padding: 0; }
@media (max-width: 40rem) { .step, .made { grid-template-columns: 1fr; } .step { margin-top: 1rem; }
  .made .dim { padding-left: 1.2rem; } }
.bar { display: flex; height: 1.6rem; color: var(--paper); font-size: .85rem; font-weight: 600; }
.bar span { min-width: 1.4rem; text-align: center; line-height: 1.6rem; }
.right { --of: var(--right); } .wrong { --of: var(--wrong); }
.later { --of: color-mix(in srgb, var(--right) 45%, var(--paper)); color: var(--ink); }
.bar span, .legend i { background: var(--of); }
@media print { .step, .made { break-inside: avoid; } }
"""


def page(results: ClassResults) -> str:
    """Return the page."""
    parts = [f'<h1>{TITLE}</h1>\n<p class="dim">{_text(results.summary)}</p>\n']
    if results.to_talk_about:
        parts.append(_part(TALK))
        parts += [_talk(results, count) for count in results.to_talk_about]
    key = "".join(
        f'<span><i class="{kind}"></i>{words}</span> '
        for kind, words in zip(KINDS, KEY, strict=True)
    )
    parts += [_part(BY_STEP), f'<p class="legend">{key}</p>\n']
    parts += [_step(results, step) for step in results.steps]
    if results.problems:
        parts.append(_part(UNREAD))
        parts += [f"<p>{_text(problem)}</p>\n" for problem in results.problems]
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{TITLE}</title>\n<style>{STYLE}{MORE}</style>\n</head>\n<body>\n"
        f"{''.join(parts)}</body>\n</html>\n"
    )


def _talk(results: ClassResults, count: MistakeCount) -> str:
    mistake = count.mistake
    reply = f"<p>{_marked(mistake.reply)}</p>\n" if mistake.reply not in ("", mistake.name) else ""
    read = ""
    if mistake.read:
        read = f"<p>Explained by {_text(results.step_name(mistake.read))}.</p>\n"
    return (
        f'<section class="wrong">\n<h2>{_marked(mistake.name)}</h2>\n{reply}'
        f'<p class="dim">{_text(results.told(count))}</p>\n{read}</section>\n'
    )


def _step(results: ClassResults, step: StepCount) -> str:
    counts = step.at_once, step.later, step.not_yet
    name = _text(results.step_name(step.title))
    rows = [f'<div class="step"><div>{name}</div>{_bar(counts)}</div>\n']
    rows += [
        f'<div class="made"><div>{_marked(one.mistake.name)}</div>'
        f'<div class="dim">{_text(told(one, step.students))}</div></div>\n'
        for one in step.mistakes
    ]
    return "".join(rows)


def _bar(counts: Sequence[int]) -> str:
    """Return the numbers of students as one bar, each with its number in it."""
    drawn = [
        f'<span class="{kind}" style="flex: {count}">{count}</span>'
        for kind, count in zip(KINDS, counts, strict=True)
        if count
    ]
    said = escape(", ".join(map("{}: {}".format, KEY, counts)))
    head = f'<div class="bar" role="img" aria-label="{said}" title="{said}">'
    return f"{head}{''.join(drawn)}</div>\n"


def _part(title: str) -> str:
    return f'<h2 class="part">{title}</h2>\n'


def _marked(text: str) -> str:
    """Return a lecture's text for the page: bold, italic, code and formulas in signs."""
    return "".join(
        f"<{tag}>{escape(words)}</{tag}>" if tag else escape(words) for words, tag in _words(text)
    )


def _words(text: str) -> list[tuple[str, str]]:
    """Return the parts of a lecture's text, each with its tag in HTML; as it is if it is none."""
    text = shown(text)
    try:
        blocks = parse(text)
    except LucidaError:
        return [(text, "")]
    found: list[tuple[str, str]] = []
    for block in blocks:
        if isinstance(block, Code | DisplayedFormula | Heading | ItemList):
            return [(text, "")]
        for span in block.line:
            if isinstance(span, Math):
                found.append((_signs(span.latex), "i"))
            else:
                found.append((span.text, _tag(span)))
    return found


def _tag(words: Words) -> str:
    return "code" if words.code else "b" if words.bold else "i" if words.italic else ""


def _signs(latex: str) -> str:
    for old, new in LATEX:
        latex = latex.replace(old, new)
    return latex


def _text(text: str) -> str:
    return escape(shown(text))
