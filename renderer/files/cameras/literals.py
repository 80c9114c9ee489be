"""Named numbers in a text: `K = np.array([[800, 0, 320], ...])`, as NumPy, Python, C and MATLAB
write them.

Nothing is executed. A calculation with the numbers is an error, since they would be wrong without
it.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from lucida.renderer.system.errors import LucidaError

_COMMENT = re.compile(r"(?:#|//|%)[^\n]*")
_NAME = re.compile(
    r"""(?:^|;|\{|,)[ \t]*["']?(?!(?:dtype|device|elements|data)\b)([A-Za-z_](?: ?[\w.]){0,60})"""
    r"""["']?[ \t]*(?:\[\s*\d*\s*\]\s*)*(?:=(?!=)|:)""",
    re.MULTILINE,
)
# Text around numbers that changes none of them: keywords, shapes and calls.
_KEYWORD = re.compile(
    r"""["']?\b(?:dtype|device|elements|data)["']?\s*[=:](?:\s*[\w.'":]+)?|\.reshape\([^)]*\)"""
)
_CALL = re.compile(r"[A-Za-z_][\w.:]*\s*(?=\()")
# As people type them: np.eye(3), numpy.identity(4), np.zeros(3), np.zeros((3, 1)), eye(3).
_MADE = re.compile(r"(?:\w+\.)?(eye|identity|zeros)\(\s*\(?\s*(\d)\s*(?:,\s*(\d)\s*)?\)?\s*\)")
_NUMBER = re.compile(r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan|inf)", re.IGNORECASE)
_BETWEEN = re.compile(r"(?:(?<=[\d.])f)?[\s\[\](){},;]+|(?<=\d)x(?=\d)")
_WORD = re.compile(r"""["']?([A-Za-z][\w-]*)["']?[\s,;}]*""")


def assigned(text: str) -> dict[str, str]:
    """Return what a text assigns to each name, up to the next one. The last of a name counts."""
    text = _COMMENT.sub("", text)
    names = list(_NAME.finditer(text))
    ends = [*(name.start() for name in names[1:]), len(text)]
    return {name[1]: text[name.end() : end] for name, end in zip(names, ends, strict=False)}


def values_in(text: str) -> dict[str, Any]:
    """Return the numbers, flat lists of numbers, and single words that a text assigns to names.

    Raises LucidaError.
    """
    values = {name: value_of(name, value) for name, value in assigned(text).items()}
    return {name: value for name, value in values.items() if value is not None}


def value_of(name: str, text: str) -> Any:
    """Return the value in a text; None if it is neither numbers nor a word. Raises LucidaError."""
    if alone := _WORD.fullmatch(text.strip()):
        return alone[1]
    text = _CALL.sub("", _MADE.sub(_made, _KEYWORD.sub("", text))).strip()
    if text[:1] not in tuple("[({") and not _NUMBER.match(text):
        return None
    if sum(map(text.count, "[({")) > sum(map(text.count, "])}")):
        raise LucidaError(name, "has a bracket that is not closed", "give numbers in brackets")
    words = [word for word in _BETWEEN.split(text) if word]
    for word in words:
        if not _NUMBER.fullmatch(word):
            problem = f"goes on with {word[:30]!r} after its numbers"
            raise LucidaError(name, problem, "give the numbers alone")
    numbers = list(map(float, words))
    return numbers[0] if len(numbers) == 1 else numbers


def _made(call: re.Match[str]) -> str:
    """Return the numbers that eye(), identity() or zeros() makes."""
    if call[1] == "zeros":
        return str([0.0] * (int(call[2]) * int(call[3] or 1)))
    return str(np.eye(int(call[2]), int(call[3] or call[2])).ravel().tolist())
