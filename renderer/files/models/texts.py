"""Read text models within bounds, in one encoding and with one kind of line end.

Many numbers are read at once, exactly as by float() and int(). A text with numbers consists of
whole lines, and begins with a blank.
"""

from __future__ import annotations

import codecs
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.reading import read_file
from lucida.renderer.scene.limits import TEXT_MODEL_BYTES
from lucida.renderer.system.errors import LucidaError

Ints = NDArray[np.int64]

_COMMENT_LINE = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)
_LONE_SIGN = re.compile(rb"[-+](?![0-9])")
_NEWLINE, _SLASH, _BLANK = 10, 47, 32


def read_text_bytes(path: Path) -> bytes:
    """Return the tidy text of a model, in UTF-8 or nearly so. Raises LucidaError, also for binary
    data, in which the search for lines would take long.
    """
    data = read_file(path, TEXT_MODEL_BYTES)
    if b"\0" in data:
        problem, remedy = "holds zero bytes: it is not text", "export it again, as text in UTF-8"
        raise LucidaError("", problem, remedy, str(path))
    return tidy(data)


def tidy(data: bytes) -> bytes:
    """Return a text with newlines only, and with continued lines (a backslash at the end) joined.

    It begins and ends with a newline. Apart from the first one, lines keep their numbers.
    """
    text = data.removeprefix(codecs.BOM_UTF8)
    if b"\r" in text:
        text = text.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    text = b"\n%s\n" % text
    if b"\\\n" in text:  # a backslash continues its line, except in a comment: # C:\models\
        text = _COMMENT_LINE.sub(lambda line: line[0].rstrip(b"\\"), text)
        text = text.replace(b"\\\n", b" ")
    return text


def is_number(word: str) -> bool:
    """Return True if float() accepts the word."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def words(text: bytes) -> tuple[Ints, Ints]:
    """Return the offset of each word, and the number of words in each line."""
    octets = np.frombuffer(text, np.uint8)
    blank = octets <= _BLANK
    begins = np.flatnonzero(blank[:-1] > blank[1:]) + 1
    ends = np.flatnonzero(octets == _NEWLINE)
    return begins, np.diff(np.searchsorted(begins, ends), prepend=0)


def floats(text: bytes, begins: Ints) -> NDArray[np.float64]:
    """Return the text's words, which begin at `begins`, as numbers. Raises ValueError if one is not
    a number.
    """
    return _parsed(text, np.float64, len(begins))


def corners(text: bytes) -> tuple[list[Any], Ints]:
    """Return the first, second and third whole number of words such as 7, 7/8, 7//9 and 7/8/9: 0 if
    a word lacks one, None if all do; and the number of words in each line. Raises ValueError for
    any other word.
    """
    text = text.replace(b"//", b"/0/")
    octets = np.frombuffer(text, np.uint8)
    slashes = np.flatnonzero(octets == _SLASH)
    if (octets[slashes + 1] <= _BLANK).any():  # 7/ and 7/8/ are 7/0 and 7/8/0
        return corners(re.sub(rb"/(?=[\x00- ])", b"/0", text))
    if (b"-" in text or b"+" in text) and _LONE_SIGN.search(text):  # 0 to fromstring()
        raise ValueError("a sign without a number")
    begins, counts = words(text)
    more = np.diff(np.searchsorted(slashes, np.append(begins, len(text))))
    most = int(more.max(initial=0))
    numbers = _parsed(text.replace(b"/", b" "), np.int64, len(begins) + len(slashes))
    columns: list[Any] = [None, None, None]
    if most > 2:
        raise ValueError("too many numbers in a corner")
    if (more == most).all():
        columns[: most + 1] = numbers.reshape(-1, most + 1).T
        return columns, counts
    firsts = np.cumsum(more + 1) - more - 1
    for k in range(most + 1):
        is_given = more >= k
        columns[k] = np.where(is_given, numbers[np.where(is_given, firsts + k, 0)], 0)
    return columns, counts


def _parsed(text: bytes, kind: Any, count: int) -> NDArray[Any]:
    """Return the text's numbers if it consists of exactly `count` of them."""
    if not count:
        return np.zeros(0, kind)
    with warnings.catch_warnings():  # NumPy before 2.4 only warned of other words
        warnings.simplefilter("ignore", DeprecationWarning)
        numbers = np.fromstring(text, kind, sep=" ")
    if len(numbers) != count:
        raise ValueError("not only numbers")
    return numbers
