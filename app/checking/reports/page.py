"""Results as one self-contained HTML file to hand back: no network, no script, no other files.

It omits what the task's feedback withholds. Everything from the student's program is text: it is
escaped, and its control characters are written out.
"""

from __future__ import annotations

import base64
from collections.abc import Iterable, Mapping, Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.checked import TaskResult
from lucida.app.checking.own_words import signature
from lucida.app.checking.reports.picture import Pictured, changed_pixels, difference_picture
from lucida.app.checking.reports.told import VERDICTS, Told, of_points, reported, summary
from lucida.app.checking.tasks import CheckTask
from lucida.renderer.images.png import png_of
from lucida.renderer.system.errors import visible

STYLE = """
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1b1f24; --dim: #59636e;
  --line: #d1d9e0; --shade: #f4f6f8; --right: #1a7f37; --wrong: #c4232b; --failed: #9a6700; }
@media (prefers-color-scheme: dark) { :root { --paper: #14181d; --ink: #e6eaef; --dim: #9aa5b1;
  --line: #3a434d; --shade: #1e242b; --right: #4cc46a; --wrong: #ff7b72; --failed: #e3b341; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 60rem; padding: 1.5rem; background: var(--paper);
  color: var(--ink); font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { display: flex; flex-wrap: wrap; align-items: baseline; gap: 0 .75rem; font-size: 1.2rem;
  margin: 0; } h3 { font-size: 1rem; margin: 1rem 0 .25rem; }
p { margin: .25rem 0; }
.dim { color: var(--dim); }
section { margin: 1.5rem 0 0; padding: 1rem 1.25rem; border: 1px solid var(--line);
  border-left: .4rem solid var(--dim); border-radius: .4rem; }
section.right { border-left-color: var(--right); }
section.wrong { border-left-color: var(--wrong); }
section.failed { border-left-color: var(--failed); }
.right .verdict { color: var(--right); }
.wrong .verdict { color: var(--wrong); } .failed .verdict { color: var(--failed); }
.points { margin-left: auto; font-weight: normal; font-size: 1rem; color: var(--dim); }
pre, code { font: .9rem/1.45 ui-monospace, monospace; }
pre { background: var(--shade); padding: .6rem .8rem; border-radius: .3rem; margin: .25rem 0;
  white-space: pre-wrap; overflow-wrap: anywhere; }
.printed { max-height: 20rem; overflow: auto; }
@media (max-width: 40rem) { body { padding: 1rem .75rem; } section { padding: .75rem .9rem; } }
.told { margin: .5rem 0; padding-left: 1.2rem; } .told li:first-child { font-weight: 600; }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; margin-top: .75rem; }
figure { margin: 0; flex: 1 1 14rem; max-width: 22rem; }
figcaption { color: var(--dim); font-size: .9rem; }
img { width: 100%; image-rendering: pixelated; border: 1px solid var(--line); display: block; }
@media print { :root { color-scheme: light; --paper: #ffffff; --ink: #000000; --dim: #444444;
  --line: #999999; --shade: #ffffff; --right: #1a7f37; --wrong: #c4232b; --failed: #9a6700; }
  body { max-width: none; padding: 0; font-size: 11pt; } pre { border: 1px solid var(--line); }
  .printed { max-height: none; } figure { flex-basis: 9rem; }
  h2, h3, h2 + p { break-after: avoid; } li, .pictures { break-inside: avoid; }
  * { print-color-adjust: exact; } }
"""


def page(
    tried: Sequence[TaskResult],
    tasks: Sequence[CheckTask],
    name: str,
    problem: str,
    pictures: Mapping[str, Pictured],
) -> str:
    """Return the page.

    tried, tasks, problem: as in told.reported.
    name: the displayed name of what was checked.
    pictures: by the tasks' names.
    """
    found = reported(tried, tasks, problem)
    sections = [_section(one, pictures.get(one.task.name)) for one in found]
    title = f"Lucida check: {_text(name)}"
    told = _text(problem) or summary(tried, tasks)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        f'<h1>{title}</h1>\n<p class="dim">{told}</p>\n'
        f"{''.join(sections)}</body>\n</html>\n"
    )


def _section(one: Told, pictures: Pictured | None) -> str:
    task = one.task
    verdict = one.verdict or "tried"
    shown = VERDICTS.get(verdict, verdict)
    points = "" if one.verdict is None else of_points(one.points, task.points)
    parts = [
        f'<h2><span>{_text(task.name)}</span> <span class="verdict">{shown}</span>'
        f' <span class="points">{points}</span></h2>\n'
        f'<p class="dim"><code>{_text(signature(task))}</code></p>\n'
    ]
    if one.failure:
        reason, *lines = one.failure
        parts.append(f"<p>{_text(reason)}</p>\n")
        parts.append(_pre("", lines))
    if one.diagnosis:
        items = "".join(f"<li>{_coded(sentence)}</li>" for sentence in one.diagnosis)
        parts.append(f'<ul class="told">{items}</ul>\n')
    if one.first is not None:
        parts.append(_pre(f"{one.wrong}; the first one:", one.first_lines))
        if pictures is not None:
            parts.append(_pictures(pictures))
    if one.output:
        parts.append(_pre("Printed", [one.output], "printed"))
    return f'<section class="{verdict}">\n{"".join(parts)}</section>\n'


def _pictures(pictures: Pictured) -> str:
    changed = changed_pixels(pictures.right, pictures.given)
    shown = (
        ("with your code", pictures.given),
        ("correct", pictures.right),
        ("where they differ", difference_picture(pictures.right, changed)),
    )
    figures = "".join(
        f'<figure><img alt="{caption}" src="{_data(image)}">'
        f"<figcaption>{caption}</figcaption></figure>"
        for caption, image in shown
    )
    return f'<div class="pictures">{figures}</div>\n'


def _data(image: NDArray[np.uint8]) -> str:
    content = base64.b64encode(png_of(np.ascontiguousarray(image))).decode()
    return f"data:image/png;base64,{content}"


def _pre(title: str, lines: Iterable[str], name: str = "") -> str:
    text = "\n".join(lines)
    if not text:
        return ""
    head = f"<h3>{title}</h3>\n" if title else ""
    opened = f'<pre class="{name}" tabindex="0">' if name else "<pre>"  # scrollable by keys
    return f"{head}{opened}{_text(text)}</pre>\n"


def _coded(sentence: str) -> str:
    """Return escaped text, with `code` as code."""
    parts = [_text(part) for part in sentence.split("`")]
    return "".join(
        f"<code>{part}</code>" if number % 2 else part for number, part in enumerate(parts)
    )


def _text(text: str) -> str:
    """Return text, escaped for a page."""
    return escape(visible(text))
