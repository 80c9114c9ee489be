"""Lists whose elements are put in another order: which of them stay, and the text of such a list.

Knows nothing of what the elements are.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Sequence

from renderer.scene.places import Span

_AFTER = re.compile(r"(?:[ \t]*(,))?([ \t]*#[^\n]*)?")
_HEAD = re.compile(r"[ \t]*#[^\n]*")
_INDENT = re.compile(r"\n([ \t]*)$")


def rising(numbers: Sequence[int]) -> list[int]:
    """Where the longest rising sequence of numbers >= 0 is: positions."""
    ends: list[int] = []
    at: list[int] = []
    before: list[int] = []
    for position, number in enumerate(numbers):
        before.append(-1)
        if number < 0:
            continue
        k = bisect_left(ends, number)
        before[position] = at[k - 1] if k else -1
        ends[k : k + 1], at[k : k + 1] = [number], [position]
    found = []
    position = at[-1] if at else -1
    while position >= 0:
        found.append(position)
        position = before[position]
    return found[::-1]


def rearranged(
    text: str, whole: Span, elements: Sequence[Span], wanted: Sequence[tuple[int | None, str]]
) -> str | None:
    """The text of a list in brackets with other elements: each goes with the comments before it and
    behind it in its line.

    whole, elements: where these are in the text. wanted: of each element that is to be there the
    number that it had, None for a new one, and its text; one of them at least. None where the
    commas are at places that are not known here.
    """
    begin = whole.value + 1
    newline = "\r\n" if "\r\n" in text else "\n"
    head = _HEAD.match(text, begin)
    start = head.end() if head else begin
    units: list[tuple[str, str]] = []  # what is before an element, and behind its comma
    comma = ""
    for element in elements:
        after = _AFTER.match(text, element.end)
        assert after is not None
        comma = after[1] or ""
        if not comma and element is not elements[-1]:
            return None
        ends_line = bool(after[2]) or text[after.end() : after.end() + 1] in ("\n", "\r")
        units.append((text[start : element.value], (after[2] or "").rstrip("\r")))
        start = after.end() if ends_line else max(after.end(1), element.end)
        start -= text[start - 1] == "\r"
    rest = text[start : whole.end - 1]
    indent = _INDENT.search(units[0][0]) if units else None
    before_new = newline + indent[1] if indent else " " * bool(units)
    parts, in_comment = [head[0].rstrip("\r") if head else ""], bool(head)
    for number, (old, value) in enumerate(wanted):
        before, behind = (before_new, "") if old is None else units[old]
        if in_comment and not before.lstrip("\r").startswith("\n"):
            before = newline + before
        is_last = number == len(wanted) - 1
        parts += [before, value, comma if is_last else ",", behind]
        in_comment = bool(behind)
    if in_comment and not rest.lstrip("\r").startswith("\n"):
        rest = newline + rest
    return f"[{''.join(parts)}{rest}]"
