"""Put changed tables into a scene file's text; all other text stays as its author wrote it.

The text is cut into sections, one for each header, and tomlkit changes the keys of a section. The
comments directly above a header belong to its section; all other comments stay where they are.
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

from lucida.renderer.files.places import Path, Places
from lucida.renderer.files.tables import parse_toml
from lucida.renderer.files.toml_writing import entries, key_text, value_text
from lucida.renderer.scene.origin import Keys
from lucida.renderer.system.errors import LucidaError

LISTS = ("objects", "lights")
MARK = "\ufeff"
Tables = dict[str, Any]


class CommentsLostError(LucidaError):
    """The file could only be written without its comments. Nothing was written."""


def rewritten(text: str, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> str | None:
    """Return the text of a scene file with the tables `new` in place of `old`, which it holds.

    old_keys, new_keys: of their objects and lights. The same key is the same table.
    Return None if the arrangement of the tables in the text cannot hold the change.
    """
    if new == old and new_keys == old_keys:
        return text
    mark, text = (MARK, text[1:]) if text.startswith(MARK) else ("", text)
    is_windows = 0 < text.count("\n") == text.count("\r\n")
    try:
        file = _Sections(text.replace("\r\n", "\n") if is_windows else text)
        file.change_table((), _without_lists(old), _without_lists(new))
        for name, was, now in zip(LISTS, old_keys, new_keys, strict=True):
            if name in new:
                before = dict(zip(was, old[name], strict=True)) if name in old else None
                file.change_list(name, before, dict(zip(now, new[name], strict=True)))
        if parse_toml(file.text) != new:
            return None
    except (LucidaError, TOMLKitError, LookupError, TypeError, ValueError):
        return None
    return mark + (file.text.replace("\n", "\r\n") if is_windows else file.text)


def _without_lists(tables: Tables) -> Tables:
    return {key: value for key, value in tables.items() if key not in LISTS}


@dataclass(eq=False)
class _Section:
    """The lines of one table: head, its comments and header; body, its keys; rest, blank lines and
    comments after the keys.
    """

    path: Path
    head: str
    body: str
    rest: str

    @property
    def text(self) -> str:
        return self.head + self.body + self.rest


class _Sections:
    """A text's sections in order. The first one is the top of the file, with the path ().

    Methods raise LookupError or another error if the text cannot hold a change.
    """

    def __init__(self, text: str) -> None:
        self._sections = list(_cut(text))

    @property
    def text(self) -> str:
        return "".join(section.text for section in self._sections)

    def change_table(self, path: Path, old: Tables, new: Tables) -> None:
        """Change the table at a path, in its own section and in those of its tables."""
        for key in dict.fromkeys([*old, *new]):
            was, now = old.get(key), new.get(key)
            if was == now:
                continue
            sections = self._at((*path, key))
            if sections and isinstance(now, dict):
                self.change_table((*path, key), was or {}, now)
                continue
            for section in sections:
                self._remove(section)
            if not path and was is None and isinstance(now, dict):
                self._insert(1, (key,), f"[{key_text(key)}]", now)
            elif not sections or now is not None:
                with self._keys(path) as keys:
                    _change(keys, key, was, now)

    def change_list(self, name: str, old: dict[int, Tables] | None, new: dict[int, Tables]) -> None:
        """Change the objects or the lights, by their keys. old: None if the file has no list."""
        if old == new:
            return
        sections = self._at((name,))
        if old is not None and not sections:
            if old:
                raise LookupError("a list in brackets")
            with self._keys(()) as keys:
                del keys[name]
        for number, (key, table) in enumerate((old or {}).items()):
            if key in new:
                self.change_table((name, number), table, new[key])
        # Insert new tables, each after the one before it.
        owned = {key: self._at((name, number)) for number, key in enumerate(old or ())}
        place = self._sections.index(sections[0]) if sections else len(self._sections)
        for key, table in new.items():
            if key not in owned:
                owned[key] = [self._insert(place, (), f"[[{name}]]", table)]
            place = self._sections.index(owned[key][-1]) + 1
        for key in [key for key in owned if key not in new]:
            for section in owned[key]:
                self._remove(section)
        if not new:
            with self._keys(()) as keys:
                keys[name] = []

    def _at(self, path: Path) -> list[_Section]:
        """Return the sections of a table and of those inside it."""
        return [section for section in self._sections if section.path[: len(path)] == path]

    @contextlib.contextmanager
    def _keys(self, path: Path) -> Iterator[tomlkit.TOMLDocument]:
        """Yield the keys of the only section at a path, to be changed."""
        (section,) = (section for section in self._sections if section.path == path)
        keys = tomlkit.parse(section.body)
        yield keys
        text = tomlkit.dumps(keys).rstrip("\n")
        section.body = text + "\n" if text else ""

    def _insert(self, number: int, path: Path, header: str, table: Tables) -> _Section:
        """Insert a section as the one of that number, between blank lines."""
        before, is_last = self._sections[number - 1], number == len(self._sections)
        if text := before.text:
            before.rest += "\n" * (2 - len(text) + len(text.rstrip("\n")))
        body = "".join(f"{line}\n" for line in entries(table))
        section = _Section(path or (header,), f"{header}\n", body, "" if is_last else "\n")
        self._sections.insert(number, section)
        return section

    def _remove(self, section: _Section) -> None:
        """Remove a section. Comments after a blank line below it stay, since they stand alone."""
        number = self._sections.index(section)
        alone = f"\n{section.rest}".partition("\n\n")[2]
        before = self._sections[number - 1]
        before.rest += alone if "#" in alone else "" if before.rest else section.rest[:1]
        del self._sections[number]


def _cut(text: str) -> Iterator[_Section]:
    """Yield the sections of a text."""
    lines = re.findall(".*\n|.+", text)
    headers = [(1, ()), *Places(text).headers, (len(lines) + 1, ())]
    head, begin = "", 0
    for (_, path), (next_header, _) in itertools.pairwise(headers):
        end = next_header - 1
        while end > begin and next_header <= len(lines) and lines[end - 1].lstrip().startswith("#"):
            end -= 1  # comments of the next section
        keys_end = next((k for k in range(end, begin, -1) if _has_key(lines[k - 1])), begin)
        body, rest = "".join(lines[begin:keys_end]), "".join(lines[keys_end:end])
        if not path and not body:  # keys come after the file's first comment
            head, rest = rest, ""
        yield _Section(path, head, body, rest)
        head, begin = "".join(lines[end:next_header]), next_header


def _has_key(line: str) -> bool:
    """Return False for a line that is blank or a comment."""
    return line.strip() != "" and not line.lstrip().startswith("#")


def _change(container: Any, key: str, was: Any, now: Any) -> None:
    """Change a value in a table of tomlkit; None for no value."""
    if now is None:
        del container[key]
    elif isinstance(was, dict) and isinstance(now, dict):
        for name in dict.fromkeys([*was, *now]):
            if was.get(name) != now.get(name):
                _change(container[key], name, was.get(name), now.get(name))
    else:
        container[key] = tomlkit.value(value_text(now))
