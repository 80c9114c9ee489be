"""The lines of an .obj text, sorted by their keywords."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .texts import Ints

_COMMENT = re.compile(rb"#[^\n]*")
_INDENT = re.compile(rb"^ +", re.MULTILINE)
_BLANK = ord(" ")
_NOTHING = np.frombuffer(b"#\n", np.uint8)
_KINDS = ("v", "vn", "vt", "f", "l", "p", "s", "g")  # kinds with many lines


class Lines:
    """The lines of a tidy text (texts.tidy), numbered from 0, its empty first line."""

    def __init__(self, text: bytes) -> None:
        text = text.replace(b"\t", b" ")
        octets, begins = _begins(text)
        if (octets[begins] == _BLANK).any():
            text = _INDENT.sub(b"", text)
            octets, begins = _begins(text)
        self.text, self._octets = text, octets
        self._begins = np.append(begins, len(text))
        is_other = ~np.isin(octets[begins], _NOTHING)
        first, second, third = (octets[begins + k].astype(np.int32) for k in range(3))
        words = {2: first << 8 | second, 3: first << 16 | second << 8 | third}
        self._numbers = {}
        for kind in _KINDS:
            word = f"{kind} ".encode()
            mask = words[len(word)] == int.from_bytes(word, "big")
            is_other &= ~mask
            self._numbers[kind] = np.flatnonzero(mask)
            for k in range(len(kind)):  # keep only the numbers of these lines
                octets[begins[mask] + k] = _BLANK
        self._others = np.flatnonzero(is_other)

    def numbers(self, kind: str) -> Ints:
        """Return the numbers of the lines of this kind, one of _KINDS."""
        return self._numbers[kind]

    def of(self, kind: str) -> bytes:
        """Return these lines without their keywords and comments."""
        numbers = self._numbers[kind]
        if not len(numbers):
            return b""
        gaps = np.flatnonzero(np.diff(numbers) != 1)
        from_ = self._begins[numbers[np.concatenate([[0], gaps + 1])]]
        to = self._begins[numbers[np.concatenate([gaps, [len(numbers) - 1]])] + 1]
        pieces = (
            self._octets[a:b].tobytes() for a, b in zip(from_.tolist(), to.tolist(), strict=True)
        )
        text = b"".join(pieces)
        return _COMMENT.sub(b"", text) if b"#" in text else text

    def statements(self) -> Iterator[tuple[int, str, str]]:
        """Yield line, keyword and the rest of all other lines."""
        for number in self._others.tolist():
            keyword, _, rest = self.line(number).partition(" ")
            yield number, keyword, rest.strip()

    def line(self, number: int) -> str:
        begin, end = self._begins[number : number + 2]
        return self.text[begin : end - 1].decode("utf-8", "replace")


def _begins(text: bytes) -> tuple[NDArray[np.uint8], Ints]:
    """Return the text's bytes, padded, and the offsets at which its lines begin."""
    octets = np.frombuffer(text + b"\n\n", np.uint8).copy()
    ends = np.flatnonzero(octets == ord("\n"))
    return octets, np.append(0, ends[:-3] + 1)
