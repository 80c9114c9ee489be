"""Change the elements of values in brackets: of lists and inline tables.

Each element keeps the comments in the lines before it, and the one after it in its own line.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from renderer.scene.places import STRING, Span

_COMMENT = re.compile(rf"{STRING.pattern}|(#[^\r\n]*)", re.DOTALL)
_COMMA = re.compile(r"(?:[^,#]++|#[^\n]*+)*+(,)")
_LINE = re.compile(r"[^\r\n]*")


def comments(text: str) -> list[str]:
    """Return the comments in the text of a value."""
    return [match[1] for match in _COMMENT.finditer(text) if match[1]]


def rearranged(
    text: str, whole: Span, elements: Sequence[Span], wanted: Sequence[tuple[int | None, str]]
) -> str:
    """Return the text of a value in brackets with other elements.

    whole, elements: where these are in the text. wanted: for each new element its number among the
    old ones, or None, and its text.
    """
    numbers = [number for number, _ in wanted]
    ends = [whole.value + 1, *(element.end for element in elements)]
    starts = [*(element.start for element in elements), whole.end - 1]
    gaps = [text[end:start] for end, start in zip(ends, starts, strict=True)]
    opening, closing = text[whole.value], text[whole.end - 1]
    if numbers == list(range(len(elements))):  # every letter between them stays
        pieces = [
            piece for gap, (_, new) in zip(gaps, wanted, strict=False) for piece in (gap, new)
        ]
        return "".join([opening, *pieces, gaps[-1], closing])
    newline = "\r\n" if "\r\n" in text else "\n"
    comma = ""
    behind, before = [], []  # of each gap: what is behind the element before it, and the rest
    for number, gap in enumerate(gaps):
        comma = ""
        if number and (found := _COMMA.match(gap)):
            gap, comma = gap[: found.start(1)] + gap[found.end(1) :], ","
        line = _LINE.match(gap)
        assert line is not None
        at = line.end() if line.end() < len(gap) else 0
        behind.append(gap[:at].rstrip())
        before.append(gap[at:])
    lead = before[0]
    before_new = newline + re.split(r"\r?\n", lead)[-1] if "\n" in lead else " "
    parts, in_comment = [opening, behind[0]], bool(behind[0])
    for place, (old, new) in enumerate(wanted):
        space = before_new if old is None else before[old]
        if not place and "\n" not in space:  # the first one
            space = lead if "#" not in lead else ""
        elif old == 0 and not space:
            space = before[1] if len(elements) > 1 and not before[1].strip() else " "
        if in_comment and "\n" not in space:
            space = newline + space.lstrip()
        is_last = place == len(wanted) - 1
        after = "" if old is None else behind[old + 1]
        parts += [space, new, comma if is_last else ",", after]
        in_comment = bool(after)
    rest = before[-1] if wanted or "#" in before[-1] else ""
    if in_comment and "\n" not in rest:
        rest = newline + rest
    return "".join([*parts, rest, closing])
