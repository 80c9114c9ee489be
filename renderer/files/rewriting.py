"""Put changed tables into a scene file's text; the rest stays as its author wrote it.

The text is cut at its headers, and each section's values are changed by tomlkit. The comments
directly above a header belong to it; all others stay where they are.
"""

from __future__ import annotations

import contextlib
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import Item

from renderer.files.places import Path, Places
from renderer.files.tables import parse_toml
from renderer.files.toml_writing import entries, key_text, value_text
from renderer.scene.model import Keys
from renderer.system.errors import LucidaError

LISTS = ("objects", "lights")
MARK = "\ufeff"
Tables = dict[str, Any]


class CommentsLostError(LucidaError):
    """The file could only be written without its comments. Nothing was written."""


@dataclass(eq=False)
class _Section:
    """A header with its lines. lead: comments and header; body: its keys; rest: the lines below."""

    path: Path
    lead: str
    body: str
    rest: str

    def text(self) -> str:
        return self.lead + self.body + self.rest


def rewritten(text: str, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> str | None:
    """Return the text of a scene file with the tables `new` in place of `old`, which it holds.

    old_keys, new_keys: of their objects and lights. The same key is the same table.
    Return None if the arrangement of the tables in the text cannot hold the change.
    """
    mark, text = (MARK, text[1:]) if text.startswith(MARK) else ("", text)
    if new == old and new_keys == old_keys:
        return mark + text
    is_windows = 0 < text.count("\n") == text.count("\r\n")
    try:
        found = _Rewriting(text.replace("\r\n", "\n") if is_windows else text).text(
            old, old_keys, new, new_keys
        )
        if parse_toml(found) != new:
            return None
    except (LucidaError, TOMLKitError, LookupError, TypeError, ValueError):
        return None
    return mark + (found.replace("\n", "\r\n") if is_windows else found)


class _Rewriting:
    def __init__(self, text: str) -> None:
        self.sections = list(_sections(text))

    def text(self, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> str:
        self._table((), *({k: v for k, v in t.items() if k not in LISTS} for t in (old, new)))
        for name, was, now in zip(LISTS, old_keys, new_keys, strict=True):
            if name in new:
                before = dict(zip(was, old[name], strict=True)) if name in old else None
                self._list(name, before, dict(zip(now, new[name], strict=True)))
        return "".join(section.text() for section in self.sections)

    def _below(self, path: Path) -> list[_Section]:
        return [section for section in self.sections if section.path[: len(path)] == path]

    def _table(self, path: Path, old: Tables, new: Tables) -> None:
        """Change the table at a path, in its own section and in those of its tables."""
        for key in dict.fromkeys([*old, *new]):
            was, now = old.get(key), new.get(key)
            if was == now:
                continue
            below = self._below((*path, key))
            if below and isinstance(now, dict):
                self._table((*path, key), was or {}, now)
                continue
            for section in below:
                self._remove(section)
            if not path and was is None and isinstance(now, dict):
                self._add(1, (key,), f"[{key_text(key)}]", now)
            elif not below or now is not None:
                with self._body(path) as body:
                    _change(body, key, was, now)

    def _list(self, name: str, old: dict[int, Tables] | None, new: dict[int, Tables]) -> None:
        """Change the objects or the lights, by their keys; None for a list that was not there."""
        if old == new:
            return
        below = self._below((name,))
        if old is not None and not below:
            with self._body(()) as body:
                if "#" in body[name].as_string() and list(old) != list(new):
                    raise LookupError("comments between tables that come or go")
                _change(body, name, list(old.values()), list(new.values()))
            return
        place = self.sections.index(below[0]) if below else len(self.sections)
        for number, (key, table) in enumerate((old or {}).items()):
            if key in new:
                self._table((name, number), table, new[key])
        units = {key: self._below((name, number)) for number, key in enumerate(old or ())}
        for key, table in new.items():
            if key not in units:
                units[key] = [self._add(place, (), f"[[{name}]]", table)]
            place = self.sections.index(units[key][-1]) + 1
        for key in [key for key in units if key not in new]:
            for section in units[key]:
                self._remove(section)
        if not new:
            with self._body(()) as body:
                body[name] = []

    @contextlib.contextmanager
    def _body(self, path: Path) -> Iterator[tomlkit.TOMLDocument]:
        """Change the keys of a section. Raises LookupError if the text has none at this path."""
        (section,) = (s for s in self.sections if s.path == path)
        body = tomlkit.parse(section.body)
        yield body
        section.body = tomlkit.dumps(body).rstrip("\n") + "\n" if body else ""

    def _add(self, at: int, path: Path, header: str, table: Tables) -> _Section:
        before = self.sections[at - 1]
        if text := before.text():
            before.rest += "\n" * (2 - len(text) + len(text.rstrip("\n")))
        lines = "".join(f"{line}\n" for line in entries(table))
        is_last = at == len(self.sections)
        section = _Section(path or (header,), f"{header}\n", lines, "" if is_last else "\n")
        self.sections.insert(at, section)
        return section

    def _remove(self, section: _Section) -> None:
        """Remove a section, except for the comments below it that stand apart."""
        number = self.sections.index(section)
        apart = f"\n{section.rest}".partition("\n\n")[2]
        before = self.sections[number - 1]
        before.rest += apart if "#" in apart else "" if before.rest else section.rest[:1]
        del self.sections[number]


def _sections(text: str) -> Iterator[_Section]:
    """Yield the sections of a text; the first one, with the path (), is above all headers."""
    lines = re.findall(".*\n|.+", text)
    headers = [(1, ()), *Places(text).headers, (len(lines) + 1, ())]
    lead, begin = "", 0
    for (_, path), (after, _) in itertools.pairwise(headers):
        end = after - 1  # of the section, of its keys
        while end > begin and after <= len(lines) and lines[end - 1].lstrip().startswith("#"):
            end -= 1
        keys = next((k for k in range(end, begin, -1) if not _is_quiet(lines[k - 1])), begin)
        body, rest = "".join(lines[begin:keys]), "".join(lines[keys:end])
        if not path and not body:  # keys come after the file's first comment
            lead, rest = rest, ""
        yield _Section(path, lead, body, rest)
        lead, begin = "".join(lines[end:after]), after


def _is_quiet(line: str) -> bool:
    """Return True for a line that is blank or a comment."""
    return not line.strip() or line.lstrip().startswith("#")


def _change(container: Any, key: Any, was: Any, now: Any) -> None:
    """Change a value in a table or an array of tomlkit; None for no value."""
    if now is None:
        del container[key]
    elif isinstance(was, dict) and isinstance(now, dict):
        for name in dict.fromkeys([*was, *now]):
            if was.get(name) != now.get(name):
                _change(container[key], name, was.get(name), now.get(name))
    elif isinstance(was, list) and isinstance(now, list) and len(was) == len(now):
        for number, (before, after) in enumerate(zip(was, now, strict=True)):
            if before != after:
                _change(container[key], number, before, after)
    else:
        container[key] = _item(now)


def _item(value: Any) -> Item:
    return tomlkit.value(value_text(value))
