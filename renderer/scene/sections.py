"""The sections of a scene file's text: tables under a header, each with its own comments.

A comment directly above a header belongs to its section, one between blank lines to nobody. Knows
nothing of what is in a section.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from renderer.scene.places import Path, Places, Span


@dataclass
class TextSection:
    """A section of the text: its header with the comments above it, and its lines. before: what is
    between it and the one before it. edits: (first, last, text) in place of letters of it."""

    path: Path
    first: int
    last: int
    body: int  # where another line can be put in: after its last statement
    before: str = ""
    edits: list[tuple[int, int, str]] = field(default_factory=list)
    new: str = ""  # of a block that is not in the text yet
    gone: bool = False


def sections(text: str, places: Places) -> list[TextSection]:
    """The sections of a text in its order; first what is above all headers."""
    spans = list(places.spans.values())
    headers = places.headers
    firsts = [*(header.first for header in headers), len(spans)]
    blocks: list[TextSection] = []
    last = _head_end(text, spans[: firsts[0]], headers[0].start if headers else len(text))
    blocks.append(TextSection((), 0, last, last))
    for number, header in enumerate(headers):
        own = [s for s in spans[header.first : firsts[number + 1]] if not s.is_inner]
        following = headers[number + 1].start if number + 1 < len(headers) else None
        first = _lead(text, header.start, last)
        body = line_end(text, max([header.end, *(span.end for span in own)]))
        end = _trail(text, body, following)
        blocks.append(TextSection(header.path, first, end, body, text[last:first]))
        last = end
    return blocks


def _head_end(text: str, spans: list[Span], limit: int) -> int:
    """Where the part above all sections ends: its statements, or the file's first comment."""
    if spans:
        return line_end(text, max(span.end for span in spans))
    end = _trail(text, 0, None)
    return end if end < limit and not text[end : end + 2].strip() else 0


def line_end(text: str, at: int) -> int:
    found = text.find("\n", at)
    return len(text) if found < 0 else found + 1


def _lead(text: str, start: int, limit: int) -> int:
    """Where the comments directly above a header begin."""
    first = text.rfind("\n", 0, start) + 1
    while first > limit:
        above = text.rfind("\n", 0, first - 1) + 1
        if above < limit or not text[above:first].lstrip().startswith("#"):
            break
        first = above
    return max(first, limit)


def _trail(text: str, at: int, following: int | None) -> int:
    """Where the comments directly below a section's last line end; those that reach down to the
    next header are that one's."""
    end = at
    while end < len(text):
        line = line_end(text, end)
        if not text[end:line].lstrip().startswith("#"):
            break
        end = line
    return at if following is not None and _lead(text, following, at) < end else end
