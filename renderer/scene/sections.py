"""The sections of a scene file's text: tables under a header, each with its own comments.

A comment directly above a header, or directly below the last line, belongs to that section. One
between blank lines belongs to none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from renderer.scene.places import Path, Places, Span


@dataclass(eq=False)
class TextSection:
    """A section of a text: its header with the comments above it, and its lines.

    first, last: offsets of the section. header: offsets of the header's letters.
    body: the offset after its last statement, where another line can be put in.
    before: the text between the previous section and this one.
    statements: the paths of its keys, in order, without those inside values.
    edits: (first, last, text), replacements of parts of it.
    """

    path: Path
    first: int
    last: int
    header: tuple[int, int]
    body: int
    before: str
    statements: list[Path]
    edits: list[tuple[int, int, str]] = field(default_factory=list)


def sections(text: str, places: Places) -> list[TextSection]:
    """Return the sections of a text in order; the first one is what is above all headers."""
    spans, headers = places.spans, places.headers
    paths = [(path, spans[path]) for path in spans]
    ends = [*(header.first for header in headers), len(paths)]
    own = [path for path, span in paths[: ends[0]] if not span.is_inner]
    limit = headers[0].start if headers else len(text)
    last = _head_end(text, [spans[path] for path in own], limit)
    found = [TextSection((), 0, last, (0, 0), last, "", own)]
    for number, header in enumerate(headers):
        part = paths[header.first : ends[number + 1]]
        own = [path for path, span in part if not span.is_inner]
        following = headers[number + 1].start if number + 1 < len(headers) else None
        first = _lead(text, header.start, last)
        body = line_end(text, spans[own[-1]].end if own else header.end)
        end = _trail(text, body, following)
        letters = header.start, header.end
        found.append(TextSection(header.path, first, end, letters, body, text[last:first], own))
        last = end
    return found


def line_start(text: str, at: int) -> int:
    return text.rfind("\n", 0, at) + 1


def line_end(text: str, at: int) -> int:
    found = text.find("\n", at)
    return len(text) if found < 0 else found + 1


def _head_end(text: str, spans: Sequence[Span], limit: int) -> int:
    """Return where the part above all sections ends: after its statements, or after the file's
    first comment."""
    if spans:
        return line_end(text, spans[-1].end)
    end = _trail(text, 0, None)
    is_apart = end < limit and not text[end : end + 2].strip()
    return end if is_apart or end == len(text) else 0


def _lead(text: str, start: int, limit: int) -> int:
    """Return where the comments directly above a header begin."""
    first = line_start(text, start)
    while first > limit:
        above = line_start(text, first - 1)
        if above < limit or not text[above:first].lstrip().startswith("#"):
            break
        first = above
    return max(first, limit)


def _trail(text: str, at: int, following: int | None) -> int:
    """Return where the comments directly below a section's last line end. Comments that reach down
    to the next header belong to that header."""
    end = at
    while end < len(text):
        line = line_end(text, end)
        if not text[end:line].lstrip().startswith("#"):
            break
        end = line
    return at if following is not None and _lead(text, following, at) < end else end
