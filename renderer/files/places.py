"""The lines of fields in a TOML text, for errors.

The text must be one that tomllib has read without an error.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator

from lucida.renderer.system.errors import LucidaError

Path = tuple[str | int, ...]

_NEXT = '"\ue000"'  # replaces a text that begins in the next line
_LONG_TEXT = re.compile(r'"""(?:[^\\]|\\.)*?"{3,5}|' + r"'''.*?'{3,5}", re.DOTALL)
_HEADER = re.compile(r"\s*(\[\[?)(.*?)\]\]?\s*(?:#.*)?")
_KEY = re.compile(r"""\s*((?:[\w-]+|"[^"]*"|'[^']*'|[ \t.])+?)\s*=(.*)""")
_PART = re.compile(r"""[\w-]+|"(?:[^"\\]|\\.)*"|'[^']*'""")


class Places:
    """The lines of all keys and tables in a TOML text. A value's parts are at its key."""

    def __init__(self, text: str) -> None:
        self._lines: dict[Path, int] = {(): 1}
        for path, line in _fields(text):
            for length in range(1, len(path) + 1):
                self._lines.setdefault(path[:length], line)

    def line(self, field: str) -> int:
        """Return the line, from 1, of a field such as `steps[3].camera.w`, or the line of its
        parent if it is missing.
        """
        path = parsed_path(field)
        while path not in self._lines:
            path = path[:-1]
        return self._lines[path]


def _fields(text: str) -> Iterator[tuple[Path, int]]:
    """Yield the path and the line of each header and each key."""
    text = _LONG_TEXT.sub(_shortened, text)
    table: Path = ()
    counts: dict[Path, int] = {}  # of arrays of tables
    depth = 0  # of open brackets
    for number, line in enumerate(text.split("\n"), 1):
        if not line:
            continue
        if depth <= 0 and (header := _HEADER.fullmatch(line)):
            table = ()
            *parents, last = _keys(header[2])
            for key in parents:  # a name below an array of tables belongs to its last element
                table = (*table, key)
                if table in counts:
                    table = (*table, counts[table] - 1)
            table = (*table, last)
            if header[1] == "[[":
                counts[table] = counts.get(table, 0) + 1
                table = (*table, counts[table] - 1)
            yield table, number
            continue
        if depth <= 0 and (assigned := _KEY.match(line)):
            yield (*table, *_keys(assigned[1])), number + (_NEXT in line)
        plain = re.sub(r'"(?:[^"\\]|\\.)*"' + r"|'[^']*'|#.*", "", line)
        depth += sum(map(plain.count, "[{")) - sum(map(plain.count, "]}"))


def _shortened(found: re.Match[str]) -> str:
    """Return a short text in as many lines as a long one."""
    short = _NEXT if found[0][3] in "\r\n" else '""'
    return short + "\n" * found[0].count("\n")


def located(error: LucidaError, places: Places, source: str) -> LucidaError:
    """Return the error with its file and line, `lecture.toml:12`, in the form that editors open."""
    where = f"{source}:{places.line(error.field)}"
    return LucidaError(error.field, error.problem, error.remedy, where)


def parsed_path(field: str) -> Path:
    """Return `steps[3].camera.w` as ("steps", 3, "camera", "w")."""
    parts = re.findall(r"\[(\d+)\]|([^.\[\]]+)", field)
    return tuple(int(number) if number else name for number, name in parts)


def _keys(text: str) -> list[str]:
    return [next(iter(tomllib.loads(f"{key} = 0"))) for key in _PART.findall(text)]
