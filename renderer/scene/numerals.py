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


def corners(text: bytes) -> tuple[Ints, Ints | None, Ints | None]:
    """Return the first, second and third whole number of words such as 7, 7/8, 7//9 and 7/8/9: 0 if
    a word lacks one, None if all do. Raises ValueError for any other word.
    """
    text = text.replace(b"//", b"/0/")
    octets = np.frombuffer(text, np.uint8)
    slashes = np.flatnonzero(octets == _SLASH)
    if (octets[slashes + 1] <= _BLANK).any():  # 7/ and 7/8/ are 7/0 and 7/8/0
        return corners(re.sub(rb"/(?=[\x00- ])", b"/0", text))
    if (b"-" in text or b"+" in text) and _LONE_SIGN.search(text):  # 0 to fromstring()
        raise ValueError("a sign without a number")
    begins, _ = words(text)
    more = np.diff(np.searchsorted(slashes, np.append(begins, len(text))))
    most = int(more.max(initial=0))
    numbers = _parsed(text.replace(b"/", b" "), np.int64, len(begins) + len(slashes))
    columns: list[Any] = [None, None, None]
    if most > 2:
        raise ValueError("too many numbers in a corner")
    if (more == most).all():
        columns[: most + 1] = numbers.reshape(-1, most + 1).T
        return columns[0], columns[1], columns[2]
    firsts = np.cumsum(more + 1) - more - 1
    for k in range(most + 1):
        columns[k] = np.zeros(len(begins), np.int64)
        columns[k][more >= k] = numbers[firsts[more >= k] + k]
    return columns[0], columns[1], columns[2]


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
