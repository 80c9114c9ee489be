"""The lines of an .obj text, sorted by their keywords."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.models.texts import Ints

_COMMENT = re.compile(rb"#[^\n]*")
_INDENT = re.compile(rb"^[ \t]+", re.MULTILINE)
_BLANKS = np.frombuffer(b" \t", np.uint8)
_NOTHING = np.frombuffer(b"#\n", np.uint8)
_KINDS = ("v", "vn", "vt", "f", "l", "p", "s", "g")  # of which there may be many lines


class Lines:
    """The lines of a tidy text (texts.tidy), numbered as it is: its empty first line is 0."""

    def __init__(self, text: bytes) -> None:
        octets, begins = _begins(text)
        if np.isin(octets[begins], _BLANKS).any():
            text = _INDENT.sub(b"", text)
            octets, begins = _begins(text)
        self.text, self._octets = text, octets
        self._begins = np.append(begins, len(text))
        ahead = [octets[begins + k] for k in range(3)]
        blank = [(letter == _BLANKS[0]) | (letter == _BLANKS[1]) for letter in ahead]
        is_other = ~np.isin(ahead[0], _NOTHING)
        self._numbers = {}
        for kind in _KINDS:
            mask = blank[len(kind)].copy()
            for letter, wanted in zip(ahead, kind, strict=False):
                mask &= letter == ord(wanted)
            is_other &= ~mask
            self._numbers[kind] = np.flatnonzero(mask)
            for k in range(len(kind)):  # only numbers are left of these lines
                octets[begins[mask] + k] = ord(" ")
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
            keyword, _, rest = self.line(number).replace("\t", " ", 1).partition(" ")
            yield number, keyword, rest.strip()

    def line(self, number: int) -> str:
        begin, end = self._begins[number : number + 2]
        return self.text[begin : end - 1].decode("utf-8", "replace")


def _begins(text: bytes) -> tuple[NDArray[np.uint8], Ints]:
    """Return the text's bytes, padded, and the offsets at which its lines begin."""
    octets = np.frombuffer(text + b"\n\n", np.uint8).copy()
    ends = np.flatnonzero(octets == ord("\n"))
    return octets, np.append(0, ends[:-3] + 1)
