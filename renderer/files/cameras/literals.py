"""Named numbers in pasted text: `K = np.array([[800, 0, 320], ...])`, as NumPy, Python and MATLAB
print them.

Nothing is executed. A calculation after the numbers is an error, since they would be wrong without
it.
"""

from __future__ import annotations

import re
from typing import Any

from lucida.renderer.system.errors import LucidaError

DEEPEST = 8  # nesting of brackets

NAME = r"""(?:^|;|\{|,)[ \t]*["']?([A-Za-z_](?: ?[\w.]){0,60})["']?[ \t]*"""
_NAME = re.compile(NAME + r"(?:=(?!=)|:)\s*", re.MULTILINE)
_CALL = re.compile(r"[A-Za-z_][\w.]*\s*\(\s*")  # np.array(, torch.tensor(
_NUMBER = r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|nan\b|inf\b)"
_TOKEN = re.compile(rf"\s*(?:(?P<number>{_NUMBER})|(?P<sign>[\[\](){{}},;]))", re.IGNORECASE)
_PLAIN = re.compile(rf"{_NUMBER}(?:(?:[ \t]*[,x][ \t]*|[ \t]+){_NUMBER})*", re.IGNORECASE)
_END = re.compile(r"(?:\s*,\s*(?:dtype|device)\s*=\s*[\w.'\":]+)*\s*(?:,\s*)?\)")
_REST = re.compile(r"[ \t]*(?:$|[;,}\n]|#|//|%)", re.MULTILINE)
_TEXT = re.compile(r"""["']?([A-Za-z][\w-]*)["']?(?=[ \t]*(?:$|[;,}\n]|#|//|%))""", re.MULTILINE)
_OPENING, _CLOSING = "[({", "])}"
# As people type them: np.eye(3), numpy.identity(4), np.zeros(3), np.zeros((3, 1)), eye(3).
_MADE = re.compile(r"(?:\w+\.)?(eye|identity|zeros)\(\s*\(?\s*(\d)\s*(?:,\s*(\d)\s*)?\)?\s*\)")


def values_in(text: str) -> dict[str, Any]:
    """Return the numbers, lists of numbers, and single words that a text assigns to names.

    If a name occurs twice, the last one counts. Raises LucidaError.
    """
    found: dict[str, Any] = {}
    place = 0
    while match := _NAME.search(text, place):
        place = match.end()
        value, end = _value(match[1], text, place)
        if value is not None:
            found[match[1]], place = value, end
    return found


def _value(name: str, text: str, start: int) -> tuple[Any, int]:
    """Return the value at `start`, None if it is not a number, and the position of its end."""
    value: Any
    if (made := _MADE.match(text, start)) and _REST.match(text, made.end()):
        rows, columns = int(made[2]), int(made[3] or made[2])
        if made[1] == "zeros":
            return [[0.0] * (int(made[3]) if made[3] else 1)] * rows, made.end()
        return [[float(i == j) for j in range(columns)] for i in range(rows)], made.end()
    place, calls = start, 0
    while call := _CALL.match(text, place):
        place, calls = call.end(), calls + 1
    if text[place : place + 1] in tuple(_OPENING):
        value, place = _nested(name, text, place)
    elif plain := _PLAIN.match(text, place):
        numbers = [float(word) for word in re.findall(_NUMBER, plain[0], re.IGNORECASE)]
        value, place = (numbers if len(numbers) > 1 else numbers[0]), plain.end()
    elif word := _TEXT.match(text, start):
        return word[1], word.end()
    else:
        return None, start
    for _ in range(calls):
        closing = _END.match(text, place)
        if closing is None:
            raise _goes_on(name, text, place)
        place = closing.end()
    if not _REST.match(text, place):
        raise _goes_on(name, text, place)
    return value, place


def _goes_on(name: str, text: str, place: int) -> LucidaError:
    rest = text[place : place + 30].strip()
    return LucidaError(name, f"goes on with {rest!r} after its numbers", "give the numbers alone")


def _nested(name: str, text: str, place: int) -> tuple[list[Any], int]:
    """Return the list that begins at a bracket. Semicolons may separate rows, as in MATLAB."""
    outer: list[list[Any]] = []
    rows: list[list[list[Any]]] = []  # for each open bracket, the rows before a semicolon
    while token := _TOKEN.match(text, place):
        place = token.end()
        if token["number"]:
            outer[-1].append(float(token["number"]))
        elif token["sign"] in _OPENING:
            if len(outer) == DEEPEST:
                raise LucidaError(name, "is nested too deeply", "give rows of numbers")
            outer.append([])
            rows.append([])
        elif token["sign"] == ";":
            rows[-1].append(outer.pop())
            outer.append([])
        elif token["sign"] in _CLOSING:
            done, before = outer.pop(), rows.pop()
            if before:
                done = [*before, done] if done else before
            if not outer:
                return done, place
            outer[-1].append(done)
    rest = text[place : place + 20].strip()
    problem = f"holds {rest!r} among its numbers" if rest else "has a bracket that is not closed"
    raise LucidaError(name, problem, "give numbers in brackets")
