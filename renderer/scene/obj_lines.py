"""The lines of an .obj text, sorted by their keywords."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from renderer.scene.numerals import Ints

_COMMENT = re.compile(rb"#[^\n]*")
_INDENT = re.compile(rb"^[ \t]+", re.MULTILINE)
_BLANKS = np.frombuffer(b" \t", np.uint8)
_STATEMENTS = ("o", "usemtl", "mtllib")
_POINTS_AND_LINES = np.frombuffer(b"pl", np.uint8)
_INITIALS = np.frombuffer(b"oum", np.uint8)


class Lines:
    """The lines of a tidy text (texts.tidy), numbered as it is: its empty first line is 0."""

    def __init__(self, text: bytes) -> None:
        octets, begins = _begins(text)
        if np.isin(octets[begins], _BLANKS).any():
            text = _INDENT.sub(b"", text)
            octets, begins = _begins(text)
        self.text, self._octets = text, octets
        self._begins = np.append(begins, len(text))
        first, second, third = octets[begins], octets[begins + 1], octets[begins + 2]
        is_v, is_short, is_long = first == ord("v"), _is_blank(second), _is_blank(third)
        chosen = {
            "v": is_v & is_short,
            "vn": is_v & is_long & (second == ord("n")),
            "vt": is_v & is_long & (second == ord("t")),
            "f": (first == ord("f")) & is_short,
        }
        self._numbers = {kind: np.flatnonzero(mask) for kind, mask in chosen.items()}
        self.has_curves = bool(
            (np.isin(first, _POINTS_AND_LINES) & is_short | (first == ord("c"))).any()
        )
        self._others = np.flatnonzero(np.isin(first, _INITIALS))
        # Keywords become blanks: only numbers are left of these lines.
        for kind, numbers in self._numbers.items():
            for k in range(len(kind)):
                octets[begins[numbers] + k] = ord(" ")

    def numbers(self, kind: str) -> Ints:
        """Return the numbers of the lines of this kind: v, vn, vt or f."""
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

    def statements(self) -> list[tuple[int, str, str]]:
        """Return line, keyword and the rest of each o, usemtl and mtllib."""
        found = []
        for number in self._others.tolist():
            keyword, _, rest = self.line(number).replace("\t", " ", 1).partition(" ")
            if keyword in _STATEMENTS:
                found.append((number, keyword, rest.strip()))
        return found

    def line(self, number: int) -> str:
        begin, end = self._begins[number : number + 2]
        return self.text[begin : end - 1].decode("utf-8", "replace")


def _begins(text: bytes) -> tuple[NDArray[np.uint8], Ints]:
    """Return the text's bytes, padded, and the offsets at which its lines begin."""
    octets = np.frombuffer(text + b"\n\n", np.uint8).copy()
    ends = np.flatnonzero(octets == ord("\n"))
    return octets, np.append(0, ends[:-3] + 1)


def _is_blank(octets: NDArray[np.uint8]) -> NDArray[np.bool_]:
    return (octets == _BLANKS[0]) | (octets == _BLANKS[1])
