"""A class's results as one self-contained HTML file: no network, no script, no other files.

The files that were read may hold anything: all their text is escaped.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from app.checking.reports.page import STYLE
from app.lecture.text import Code, DisplayedFormula, Heading, ItemList, Math, Words, parse
from app.results.model import ClassResults, MistakeCount, StepCount, Timeline, shown, told
from renderer.errors import LucidaError

TITLE = "What the class answered"
TALK = "To talk about tomorrow"
BY_STEP, OVER_TIME, UNREAD = "By step", "Over time", "Not read"
KEY = ("correct at once", "correct later", "not correct yet")
KINDS = ("right", "later", "wrong")
TRANSPOSED = "ᵀ"
LATEX = (  # what the replies of lectures hold, as signs
    (r"^\mathsf{T}", TRANSPOSED), (r"\mathbf", ""), (r"\cdot", "·"), (r"\times", "\u00d7"),
    (r"\,", " "), ("{", ""), ("}", ""), ("-", "\u2212"),
)  # fmt: skip
WIDE, HIGH = 600, 26  # of a bar, SVG units
MORE = """
table { width: 100%; border-collapse: collapse; } td { padding: .3rem .5rem .3rem 0;
  vertical-align: top; } td:first-child { width: 40%; } tr.made td { padding: 0 0 .2rem 1.2rem;
  font-size: .9rem; } tr.made td:last-child { padding-left: 0; }
.count { color: var(--dim); white-space: nowrap; } svg { display: block; width: 100%; }
rect.right { fill: var(--right); } rect.later { fill: var(--right); fill-opacity: .45; }
rect.wrong { fill: var(--wrong); } rect.ground { fill: var(--shade); }
svg text { font: 14px system-ui, sans-serif; fill: var(--ink); }
svg .in { fill: #ffffff; text-anchor: middle; font-weight: 600; }
@media (prefers-color-scheme: dark) { svg .in { fill: #000000; } }
@media print { svg .in { fill: #ffffff; } }
.later + .in { fill: var(--ink); }
.key i { display: inline-block; width: .8rem; height: .8rem; margin: 0 .3rem 0 .8rem;
  border-radius: .15rem; } .key .right { background: var(--right); }
.key .later { background: var(--right); opacity: .45; } .key .wrong { background: var(--wrong); }
h2.part { margin: 2rem 0 .5rem; } .over { margin: .8rem 0 0; overflow-wrap: anywhere; }
"""


def page(results: ClassResults) -> str:
    """Return the page."""
    parts = [f'<h1>{TITLE}</h1>\n<p class="dim">{_text(results.summary)}</p>\n']
    if results.to_talk_about:
        parts.append(_part(TALK))
        parts += [_talk(results, count) for count in results.to_talk_about]
    parts += [_part(BY_STEP), _key(KINDS, KEY), "<table>\n"]
    parts += [_step(results, step) for step in results.steps]
    parts.append("</table>\n")
    if results.timeline is not None:
        parts += [_part(OVER_TIME), *_over_time(results.timeline)]
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
    rows = [
        f"<tr><td>{_text(results.step_name(step.title))}</td>"
        f"<td>{_bar(counts, step.students)}</td></tr>\n"
    ]
    rows += [
        f'<tr class="made"><td>{_marked(one.mistake.name)}</td>'
        f'<td class="count">{_text(told(one, step.students))}</td></tr>\n'
        for one in step.mistakes
    ]
    return "".join(rows)


def _bar(counts: Sequence[int], total: int) -> str:
    """Return the numbers of students as one bar, each with its number in it."""
    told = ", ".join(f"{name}: {count}" for name, count in zip(KEY, counts, strict=True))
    drawn, x = [], 0.0
    for kind, count in zip(KINDS, counts, strict=True):
        wide = WIDE * count / max(total, 1)
        if count:
            drawn.append(_rect(kind, x, 0, wide, HIGH))
            drawn.append(f'<text class="in" x="{x + wide / 2:.1f}" y="18">{count}</text>')
        x += wide
    return _svg(WIDE, HIGH, told, drawn)


def _over_time(timeline: Timeline) -> list[str]:
    answers = [("wrong", timeline.wrong), ("right", timeline.right)]
    parts = [
        _key(("right", "wrong"), ("correct answers", "wrong answers")),
        '<p class="over">All answers</p>\n',
        _columns(timeline, answers),
    ]
    for mistake, counts in timeline.mistakes:
        parts.append(f'<p class="over">{_marked(mistake.name)}</p>\n')
        parts.append(_columns(timeline, [("wrong", counts)]))
    return parts


def _columns(timeline: Timeline, rows: Sequence[tuple[str, Sequence[int]]]) -> str:
    """Return a column per bin, its rows on one another, with the sum above and the time below."""
    wide, high, top, whole = 1000, 60, 18, 96
    sums = [sum(counts) for counts in zip(*(counts for _, counts in rows), strict=True)]
    most, step = max(*sums, 1), wide / len(sums)
    drawn = [_rect("ground", 0, top, wide, high)]
    every = -(-len(sums) // 8)  # labels that have room
    for n, (label, total) in enumerate(zip(timeline.labels, sums, strict=True)):
        x, y = n * step, float(top + high)
        for kind, counts in rows:
            tall = high * counts[n] / most
            y -= tall
            if counts[n]:
                drawn.append(_rect(kind, x + 1, y, min(step - 2, 60), tall))
        if total:
            drawn.append(f'<text x="{x + 2:.1f}" y="{y - 3:.1f}">{total}</text>')
        if n % every == 0:
            drawn.append(f'<text x="{x + 2:.1f}" y="{whole - 2}">{escape(label)}</text>')
    told = ", ".join(f"{label}: {n}" for label, n in zip(timeline.labels, sums, strict=True))
    return _svg(wide, whole, told, drawn)


def _rect(kind: str, x: float, y: float, wide: float, high: float) -> str:
    return f'<rect class="{kind}" x="{x:.1f}" y="{y:.1f}" width="{wide:.1f}" height="{high:.1f}"/>'


def _svg(wide: float, high: float, told: str, drawn: Sequence[str]) -> str:
    return (
        f'<svg viewBox="0 0 {wide} {high}" role="img" aria-label="{escape(told)}">'
        f"<title>{escape(told)}</title>{''.join(drawn)}</svg>\n"
    )


def _key(kinds: Sequence[str], words: Sequence[str]) -> str:
    shown = "".join(
        f'<i class="{kind}"></i>{word}' for kind, word in zip(kinds, words, strict=True)
    )
    return f'<p class="key">{shown}</p>\n'


def _part(title: str) -> str:
    return f'<h2 class="part">{title}</h2>\n'


def plain(text: str) -> str:
    """Return a lecture's text without its marks, in letters that the window's fonts have."""
    return "".join(words for words, _ in _words(text)).replace(TRANSPOSED, "^T")


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
