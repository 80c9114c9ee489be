"""Convert many numbers in a text at once, each exactly as float() and int() would.

A text here is whole lines, and begins with a blank.
"""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]

_LONE_SIGN = re.compile(rb"[-+](?![0-9])")
_EXACT = 1 << 53  # float64 holds all whole numbers up to it,
_POWERS = 10.0 ** np.arange(23)  # and these powers of ten
_NEWLINE, _PLUS, _MINUS, _DOT, _SLASH, _BLANK = 10, 43, 45, 46, 47, 32


def is_number(word: str) -> bool:
    """Return True if float() takes the word."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def words(text: bytes) -> tuple[Ints, Ints]:
    """Return where each word begins, and how many words each line has."""
    octets = np.frombuffer(text, np.uint8)
    blank = octets <= _BLANK
    begins = np.flatnonzero(blank[:-1] > blank[1:]) + 1
    ends = np.flatnonzero(octets == _NEWLINE)
    return begins, np.diff(np.searchsorted(begins, ends), prepend=0)


def floats(text: bytes, begins: Ints) -> NDArray[np.float64]:
    """Return the text's words, which begin at `begins`, as numbers. Raises ValueError if one is not
    a number.
    """
    fixed = _fixed_point(text, begins)
    return _parsed(text, np.float64, len(begins)) if fixed is None else fixed


def corners(text: bytes, begins: Ints) -> tuple[Ints, Ints | None, Ints | None]:
    """Return the first, second and third whole number of words such as 7, 7/8, 7//9 and 7/8/9: 0 if
    a word lacks one, None if all do. Raises ValueError for any other word.
    """
    text = text.replace(b"//", b"/0/")
    octets = np.frombuffer(text, np.uint8)
    slashes = np.flatnonzero(octets == _SLASH)
    if len(slashes):
        begins, _ = words(text)
    each = np.diff(np.searchsorted(slashes, np.append(begins, len(text))))
    most = int(each.max(initial=0))
    lone = _LONE_SIGN.search(text) if b"-" in text or b"+" in text else None  # 0 to fromstring()
    apart = octets <= _BLANK
    if lone or most > 2 or (apart[slashes - 1] | apart[slashes + 1]).any() or (each < most).any():
        return _mixed_corners(text)
    numbers = _parsed(text.replace(b"/", b" "), np.int64, len(begins) * (most + 1))
    columns = [*numbers.reshape(-1, most + 1).T, None, None]
    return columns[0], columns[1], columns[2]


def _mixed_corners(text: bytes) -> tuple[Ints, Ints | None, Ints | None]:
    """Do the same for words that differ in what they have, one by one."""
    rows = []
    for word in text.split():
        first, *others = word.split(b"/")
        if len(others) > 2 or b"_" in word:
            raise ValueError("too many numbers in a corner")
        rows.append([int(first), *(int(k or b"0") for k in (*others, b"", b"")[:2])])
    columns = [np.ascontiguousarray(column) for column in np.array(rows, np.int64).T]
    return columns[0], *(c if c.any() else None for c in columns[1:])  # type: ignore[return-value]


def _parsed(text: bytes, kind: Any, count: int) -> NDArray[Any]:
    """Return the text's numbers, if there are exactly so many and nothing else."""
    if not count:
        return np.zeros(0, kind)
    with warnings.catch_warnings():  # before NumPy 2.4 it only warned of what is no number
        warnings.simplefilter("ignore", DeprecationWarning)
        numbers = np.fromstring(text, kind, sep=" ")
    if len(numbers) != count:
        raise ValueError("not only numbers")
    return numbers


def _fixed_point(text: bytes, begins: Ints) -> NDArray[np.float64] | None:
    """Return words such as -12.345 as numbers, three times as fast; None if there is another kind
    of word.

    A whole number and a power of ten that float64 holds exactly are divided, so that the quotient
    is rounded correctly.
    """
    if not len(begins) or text.translate(None, b"0123456789.+- \t\n"):
        return None
    octets = np.frombuffer(text, np.uint8)
    first = octets[begins]
    negative = first == _MINUS
    signed = negative | (first == _PLUS)
    if text.count(b"-") + text.count(b"+") != signed.sum():
        return None
    blank = octets <= _BLANK
    ends = np.flatnonzero(blank[1:] > blank[:-1]) + 1
    dots = np.flatnonzero(octets == _DOT)
    word = np.arange(len(begins))
    if len(dots) != len(begins) or (dots < begins).any() or (dots >= ends).any():
        word = np.searchsorted(begins, dots, side="right") - 1
    if (word[1:] == word[:-1]).any():  # two dots in a word
        return None
    places = np.zeros(len(begins), np.int64)
    places[word] = ends[word] - dots - 1
    digits = ends - begins - signed
    digits[word] -= 1
    if digits.min() < 1:
        return None
    whole = _parsed(text.replace(b".", b""), np.int64, len(begins))
    if not (whole.min() >= -_EXACT and whole.max() <= _EXACT and places.max() < len(_POWERS)):
        return None
    values = whole / _POWERS[places]
    values[negative & (whole == 0)] = -0.0
    return values
