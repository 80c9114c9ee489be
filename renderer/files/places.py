"""The lines of fields in a TOML text, for errors.

The text must be one that tomllib has read without complaint.
"""

from __future__ import annotations

import re
import tomllib
from bisect import bisect_left

from lucida.renderer.system.errors import LucidaError

Path = tuple[str | int, ...]

_TOKEN = re.compile(
    r'"""(?:[^"\\]++|\\.|"(?!""))*+"{3,5}'  # up to two quotes may stand before the closing three
    r"|'''.*?'{3,5}"
    r'|"(?:[^"\\\n]++|\\.)*+"'
    r"|'[^'\n]*'"
    r"|#[^\n]*"
    r"|[\[\]{}=,\n]"
    r"|[^\s\[\]{}=,#\"']+",
    re.DOTALL,
)
_KEY = re.compile(r"""[\w-]+|"(?:[^"\\\n]++|\\.)*+"|'[^'\n]*'""")


class Places:
    """The lines of a TOML text's fields. headers: the line and the path of each table's header."""

    def __init__(self, text: str) -> None:
        self._breaks = [match.start() for match in re.finditer("\n", text)]
        self._lines: dict[Path, int] = {(): 1}
        self._counts: dict[Path, int] = {}  # of arrays of tables
        self.headers: list[tuple[int, Path]] = []
        self._scan(text)

    def line(self, field: str) -> int:
        """Return the line, from 1, of a field such as `steps[3].camera.w`: the first line of its
        value, or the line of what it is in if it is missing.
        """
        path = parsed_path(field)
        while path not in self._lines:
            path = path[:-1]
        return self._lines[path]

    def _scan(self, text: str) -> None:
        table: Path = ()
        opened: list[tuple[Path, int | None]] = []  # lists, with the number of the entry; tables
        value: Path | None = None  # of the value that comes next
        words: list[str] = []  # of a key or a header, which begins at `start`
        start = 0
        for match in _TOKEN.finditer(text + "\n"):
            at, token = match.start(), match[0]
            within, number = opened[-1] if opened else (table, None)
            if token[0] == "#" or (token == "\n" and value is not None):
                continue
            if token in ("]", "}") and opened:
                opened.pop()
                value, words = None, []
            elif value is not None:
                if token[:3] in ('"""', "'''") and token[3] in "\r\n":
                    start = text.index("\n", at) + 1
                elif number is not None:
                    start = at
                self._place(value, start)
                if token in ("[", "{"):
                    opened.append((value, 0 if token == "[" else None))
                value = (*value, 0) if token == "[" else None
            elif number is not None:
                if token == ",":
                    opened[-1] = within, number + 1
                    value = (*within, number + 1)
            elif token == "=":
                value, words = (*within, *_keys(words)), []
            elif token in (",", "\n"):
                if words[:1] == ["["]:
                    table = self._resolved(_keys(words), element=words[1] == "[")
                    self.headers.append((self._place(table, start), table))
                words = []
            else:
                start = start if words else at
                words.append(token)

    def _resolved(self, keys: list[str], element: bool) -> Path:
        """Return a header's path: below an array of tables, it means the last element."""
        path: Path = ()
        for key in keys[:-1]:
            path = (*path, key)
            if path in self._counts:
                path = (*path, self._counts[path] - 1)
        path = (*path, *keys[-1:])
        if element:
            number = self._counts.get(path, 0)
            self._counts[path] = number + 1
            path = (*path, number)
        return path

    def _place(self, path: Path, at: int) -> int:
        """Record where a path begins, and the paths that it is in, unless they have begun. Return
        the line.
        """
        line = bisect_left(self._breaks, at) + 1
        while path not in self._lines:
            self._lines[path] = line
            path = path[:-1]
        return line


def located(error: LucidaError, places: Places, source: str) -> LucidaError:
    """Return the error with its file and line, `lecture.toml:12`, as editors find it."""
    where = f"{source}:{places.line(error.field)}"
    return LucidaError(error.field, error.problem, error.remedy, where)


def parsed_path(field: str) -> Path:
    """Return `steps[3].camera.w` as ("steps", 3, "camera", "w")."""
    parts = re.findall(r"\[(\d+)\]|([^.\[\]]+)", field)
    return tuple(int(number) if number else name for number, name in parts)


def _keys(words: list[str]) -> list[str]:
    return [_unquoted(key) for key in _KEY.findall("".join(words))]


def _unquoted(key: str) -> str:
    if key[:1] == '"' and "\\" in key:
        return next(iter(tomllib.loads(f"{key} = 0")))
    return key[1:-1] if key[:1] in ('"', "'") else key
