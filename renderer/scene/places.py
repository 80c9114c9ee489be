"""The lines of fields in a TOML text, for errors.

The text must be one that tomllib has read without complaint.
"""

from __future__ import annotations

import itertools
import re
import tomllib
from bisect import bisect_left

from renderer.errors import LucidaError

Path = tuple[str | int, ...]

_BLANK = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
_BETWEEN = re.compile(r"(?:[ \t\r\n,]+|#[^\n]*)*")  # what is in brackets
_SPACE = re.compile(r"[ \t]*")
_KEY = re.compile(r"""[\w-]+|"(?:[^"\\\n]++|\\.)*+"|'[^'\n]*'""")
_BARE = re.compile(r"[^,\]}\n#]*")
_STRING = re.compile(
    r'"""(?:[^"\\]++|\\.|"(?!""))*+"{3,5}'  # up to two quotes may stand before the closing three
    r"|'''.*?'{3,5}"
    r'|"(?:[^"\\\n]++|\\.)*+"'
    r"|'[^'\n]*'",
    re.DOTALL,
)


class Places:
    """The lines of a TOML text's fields."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._breaks = [match.start() for match in re.finditer("\n", text)]
        self._lines: dict[Path, int] = {(): 1}
        self._counts: dict[Path, int] = {}
        self._scan()

    def line(self, field: str) -> int:
        """Return the line, from 1, of a field such as `steps[3].camera.w`: the first line of its
        value, or the line of what it is in if it is missing.
        """
        path = parsed_path(field)
        while path not in self._lines:
            path = path[:-1]
        return self._lines[path]

    # The scanner: one method a construct.

    def _scan(self) -> None:
        table: Path = ()
        while True:
            self._skip(_BLANK)
            if self._at >= len(self._text):
                return
            start = self._at
            if self._text.startswith("[[", start):
                self._at += 2
                table = self._resolved(self._keys(), element=True)
                self._at += 2
            elif self._text.startswith("[", start):
                self._at += 1
                table = self._resolved(self._keys(), element=False)
                self._at += 1
            else:
                self._pair(table)
                continue
            self._place(table, start)

    def _pair(self, table: Path) -> None:
        start = self._at
        path = (*table, *self._keys())
        self._at += 1  # the equals sign
        self._skip(_SPACE)
        self._value(path, start)

    def _value(self, path: Path, start: int) -> None:
        first = self._text[self._at : self._at + 1]
        if first == "[":
            self._place(path, start)
            self._array(path)
        elif first == "{":
            self._place(path, start)
            self._inline_table(path)
        elif first in ('"', "'"):
            begin = self._at
            self._skip(_STRING)
            opened = self._text[begin : begin + 4]
            several = opened[:3] in ('"""', "'''") and opened[3:] in ("\n", "\r")
            self._place(path, self._text.index("\n", begin) + 1 if several else start)
        else:
            self._place(path, start)
            self._skip(_BARE)

    def _array(self, path: Path) -> None:
        self._at += 1
        for number in itertools.count():
            if self._is_closed():
                return
            self._value((*path, number), self._at)

    def _inline_table(self, path: Path) -> None:
        self._at += 1
        while not self._is_closed():
            self._pair(path)

    def _is_closed(self) -> bool:
        """Return True, and leave the brackets, if nothing else follows in them."""
        self._skip(_BETWEEN)
        closed = self._text[self._at : self._at + 1] in ("]", "}", "")
        self._at += closed
        return closed

    def _keys(self) -> tuple[str, ...]:
        keys = []
        while True:
            self._skip(_SPACE)
            begin = self._at
            self._skip(_KEY)
            keys.append(_unquoted(self._text[begin : self._at]))
            self._skip(_SPACE)
            if not self._text.startswith(".", self._at):
                return tuple(keys)
            self._at += 1

    def _resolved(self, keys: tuple[str, ...], element: bool) -> Path:
        """Return a header's path: below an array of tables, it means the last element."""
        path: Path = ()
        for key in keys[:-1]:
            path = (*path, key)
            if path in self._counts:
                path = (*path, self._counts[path] - 1)
        path = (*path, keys[-1])
        if element:
            number = self._counts.get(path, 0)
            self._counts[path] = number + 1
            path = (*path, number)
        return path

    def _place(self, path: Path, at: int) -> None:
        """Record where a path begins, and the paths that it is in, unless they have begun."""
        line = bisect_left(self._breaks, at) + 1
        while path not in self._lines:
            self._lines[path] = line
            path = path[:-1]

    def _skip(self, pattern: re.Pattern[str]) -> None:
        match = pattern.match(self._text, self._at)
        self._at = match.end() if match else len(self._text)  # that is not TOML


def located(error: LucidaError, places: Places, source: str) -> LucidaError:
    """Return the error with its file and line, `lecture.toml:12`, as editors find it."""
    where = f"{source}:{places.line(error.field)}"
    return LucidaError(error.field, error.problem, error.remedy, where)


def parsed_path(field: str) -> Path:
    """Return `steps[3].camera.w` as ("steps", 3, "camera", "w")."""
    parts = re.findall(r"\[(\d+)\]|([^.\[\]]+)", field)
    return tuple(int(number) if number else name for number, name in parts)


def _unquoted(key: str) -> str:
    if key[:1] == '"' and "\\" in key:
        return next(iter(tomllib.loads(f"{key} = 0")))
    return key[1:-1] if key[:1] in ('"', "'") else key
