"""Put other tables into a scene file's text; what has not changed stays as its author wrote it.

A comment after a value goes with the value. A comment in its own line goes with the object, the
light or the material that it belongs to; see sections.py.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Iterator
from typing import Any

from renderer.errors import LucidaError
from renderer.scene.bracketed import comments, rearranged
from renderer.scene.model import Keys
from renderer.scene.places import Path, Places
from renderer.scene.sections import TextSection, line_end, line_start, sections
from renderer.scene.tables import parse_toml
from renderer.scene.toml_writing import entries, key_text, value_text

LISTS = ("objects", "lights")
MARK = "\ufeff"
Tables = dict[str, Any]


class CommentsLostError(LucidaError):
    """The file can only be written without its comments. Nothing was written."""


def rewritten(text: str, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> str:
    """Return the text of a scene file with the tables `new` in place of `old`, which it holds.

    old_keys, new_keys: of their objects and lights. The same key is the same section.
    Raises CommentsLostError if the result would not be read as `new`.
    """
    mark, text = (MARK, text[1:]) if text.startswith(MARK) else ("", text)
    if new == old and new_keys == old_keys:
        return mark + text
    found = _Rewriting(text, old, old_keys, new, new_keys).text()
    try:
        is_new = parse_toml(found) == new
    except LucidaError:
        is_new = False
    if is_new:
        return mark + found
    problem = "would lose its comments: they cannot be kept in this arrangement of tables"
    raise CommentsLostError("", problem, "overwrite it, or make the change in a text editor")


class _Rewriting:
    def __init__(self, text: str, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> None:
        self._text, self._old, self._new = text, old, new
        self._was, self._now = (
            dict(zip(LISTS, keys, strict=True)) for keys in (old_keys, new_keys)
        )
        self._newline = "\r\n" if "\r\n" in text else "\n"
        self._places = Places(text)
        self._spans = self._places.spans
        self._sections = sections(text, self._places)
        self._new_names: dict[str, str] = {}  # of materials, by their old names
        self._names: list[tuple[int, int, str]] = []  # where these are written
        self._lost: list[str] = []  # comments inside values that are replaced
        self._after: dict[TextSection | None, list[str]] = defaultdict(list)
        self._ahead: dict[TextSection, list[str]] = {}
        self._gone: set[TextSection] = set()
        self._view = self._viewed()

    def text(self) -> str:
        homes = self._change_sections()
        for parent, values in self._rest(homes).items():
            self._add(parent, values, homes)
        for name in reversed(LISTS):  # lights come before objects
            if not isinstance(self._view.get(name), list) and self._new.get(name):
                self._order(name)
        return self._joined()

    def _viewed(self) -> Tables:
        """Return the new tables under the paths of the old ones: objects and lights by their old
        numbers, where they are sections, and renamed materials by their old names."""
        view = dict(self._new)
        for name in LISTS:
            if not self._new.get(name) or (name,) in self._spans:
                if not self._old.get(name) and self._new.get(name):
                    del view[name]  # sections take the place of an empty list
                continue
            there = dict(zip(self._now[name], self._new[name], strict=True))
            old = enumerate(self._was[name] if name in self._old else ())
            view[name] = {number: there[key] for number, key in old if key in there}
            if not view[name]:
                del view[name]
        self._new_names = self._renamed()
        if self._new_names:
            names = {new: old for old, new in self._new_names.items()}
            view["materials"] = {names.get(k, k): t for k, t in self._new["materials"].items()}
            for old_name, name in self._new_names.items():
                for first, last in self._places.names["materials", old_name]:
                    self._names.append((first, last, key_text(name)))
        return view

    def _renamed(self) -> dict[str, str]:
        """Return the new name of each material that has another one: the most alike of the new
        ones, by its fields, and by the objects that used it.
        """
        old, new = self._old.get("materials") or {}, self._new.get("materials") or {}
        there = dict(zip(self._now["objects"], self._new.get("objects") or [], strict=True))
        objects = zip(self._was["objects"], self._old.get("objects") or [], strict=True)
        uses = [(t.get("material"), there.get(key, {}).get("material")) for key, t in objects]

        def likeness(one: str, other: str) -> tuple[bool, ...]:
            a, b = old[one], new[other]
            return a == b, (one, other) in uses, any(b.get(k) == v for k, v in a.items())

        gone, come = (name for name in old if name not in new), [n for n in new if n not in old]
        pairs = [(likeness(a, b), a, b) for a in gone for b in come]
        found: dict[str, str] = {}
        for alike, one, other in sorted(pairs, key=lambda pair: pair[0], reverse=True):
            if any(alike) and one not in found and other not in found.values():
                found[one] = other
        return found

    # Values and sections that were there.

    def _change_sections(self) -> dict[Path, TextSection]:
        """Write the new values over the old. Return the sections that stay, by path."""
        homes = {}
        for section in self._sections:
            path = section.path
            unit = path[:2] if path[:1] in (("objects",), ("lights",), ("materials",)) else path[:1]
            if _at(self._view, unit) is None:
                self._gone.add(section)
                continue
            if isinstance(value := _at(self._view, path), dict):
                homes[path] = section
            else:
                self._remove(section, *section.header, keep=value is not None)
            for statement in section.statements:
                if statement != ("lucida",):  # the format's version is not in the tables
                    self._statement(section, statement)
        firsts = [section.first for section in self._sections]
        for edit in self._names:
            self._sections[bisect_right(firsts, edit[0]) - 1].edits.append(edit)
        return homes

    def _statement(self, section: TextSection, path: Path) -> None:
        span, new = self._spans[path], _at(self._view, path)
        if new is None:
            # Sections take its place, or may do so.
            keep = len(path) == 1 and path[0] in (*LISTS, "materials")
            self._remove(section, span.start, span.end, keep)
            return
        self._lost = []
        value = self._value(path, _at(self._old, path), new)
        if value != self._text[span.value : span.end]:
            section.edits.append((span.value, span.end, value))
        if self._lost:
            start = line_start(self._text, span.start)
            section.edits.append((start, start, self._comment_lines(self._lost)))

    def _remove(self, section: TextSection, start: int, end: int, keep: bool) -> None:
        """Remove the lines of a statement or of a header. keep: but not their comments."""
        first, last = line_start(self._text, start), line_end(self._text, end)
        kept = comments(self._text[first:last]) if keep else []
        section.edits.append((first, last, self._comment_lines(kept)))

    def _comment_lines(self, found: list[str]) -> str:
        return "".join(comment + self._newline for comment in found)

    def _value(self, path: Path, old: Any, new: Any) -> str:
        """Return the new text of a value."""
        span = self._spans[path]
        keyed = path[0] if len(path) == 1 and path[0] in LISTS else None
        was, now = (self._was[keyed], self._now[keyed]) if keyed else ((), ())
        if old == new and was == now:
            return self._cut(span.value, span.end)
        wanted: list[tuple[int | None, str]] = []
        if isinstance(old, dict) and isinstance(new, dict):
            units = sorted(self._units(path, old), key=lambda unit: self._spans[unit].start)
            held = set()
            for number, unit in enumerate(units):
                inner = unit[len(path) :]
                if (value := _at(new, inner)) is not None:
                    held.add(unit)
                    key = self._cut(self._spans[unit].start, self._spans[unit].value)
                    wanted.append((number, key + self._value(unit, _at(old, inner), value)))
            for place, value in _uncovered(path, new, held, _prefixes(held)):
                wanted.append((None, f"{self._dotted(place, len(path))} = {value_text(value)}"))
        elif isinstance(old, list) and isinstance(new, list) and old:
            units = [(*path, number) for number in range(len(old))]
            numbers = {item: number for number, item in enumerate(was or range(len(old)))}
            for item, value in zip(now or range(len(new)), new, strict=True):
                k = numbers.get(item)
                text = value_text(value) if k is None else self._value(units[k], old[k], value)
                wanted.append((k, text))
        else:
            self._lost += comments(self._text[span.value : span.end])
            return value_text(new)
        return rearranged(self._text, span, [self._spans[unit] for unit in units], wanted)

    def _units(self, path: Path, old: Tables) -> Iterator[Path]:
        """Yield the paths of the keys of an inline table; dotted keys have longer ones."""
        for key, value in old.items():
            place = (*path, key)
            if place in self._spans:
                yield place
            else:
                yield from self._units(place, value)

    # Values that were not there.

    def _rest(self, homes: dict[Path, TextSection]) -> dict[Path, Tables]:
        """Return what has no place in the text yet, by the path of its table."""
        paths = [path for section in homes.values() for path in section.statements]
        held = {path for path in paths if _at(self._view, path) is not None}
        found: dict[Path, Tables] = defaultdict(dict)
        for path, value in _uncovered((), self._view, held, {*homes, *_prefixes({*held, *homes})}):
            found[path[:-1]][str(path[-1])] = value
        return found

    def _add(self, path: Path, values: Tables, homes: dict[Path, TextSection]) -> None:
        if path in ((), ("materials",)):
            for key, value in list(values.items()):
                if isinstance(value, dict):
                    self._add_table((*path, key), values.pop(key))
        if not values:
            return
        if path in homes:
            section, at = homes[path], homes[path].body
        else:  # next to its other fields, in dotted keys
            for section in self._sections:
                kin = [s for s in section.statements if s[: len(path)] == path]
                if kin and len(section.path) < len(path) and section not in self._gone:
                    at = line_end(self._text, self._spans[kin[-1]].end)
                    break
            else:
                self._add_above(path, values)
                return
        depth = len(section.path)
        lines = [f"{self._dotted((*path, k), depth)} = {value_text(v)}" for k, v in values.items()]
        text = "".join(line + self._newline for line in lines)
        if at and self._text[at - 1] != "\n":
            text = self._newline + text
        section.edits.append((at, at, text))

    def _add_above(self, path: Path, values: Tables) -> None:
        """Add a table of which only tables inside it are in the text, above the first of these."""
        section = next(s for s in self._sections if s.path[: len(path)] == path)
        text = self._lines(f"[{self._dotted(path)}]", values)
        section.edits.append((section.first, section.first, text + self._newline))

    def _add_table(self, path: Path, value: Tables) -> None:
        """Add [camera] or [materials.NAME], after the materials, the camera, or the first part."""
        if path == ("materials",):
            for name, table in value.items():
                self._add_table((*path, name), table)
            return
        kin = [s for s in self._sections if s.path[:1] == ("materials",) == path[:1]]
        kin = kin or [s for s in self._sections if s.path[:1] in ((), ("camera",))]
        self._after[kin[-1]].append(self._lines(f"[{self._dotted(path)}]", value))

    def _dotted(self, path: Path, start: int = 0) -> str:
        """Return the keys of a path from a part on, with dots between them."""
        if path[0] == "materials" and len(path) > 1:
            path = (path[0], self._new_names.get(str(path[1]), path[1]), *path[2:])
        return ".".join(key_text(part) for part in path[start:] if isinstance(part, str))

    def _lines(self, header: str, table: Tables) -> str:
        return "".join(line + self._newline for line in [header, *entries(table)])

    # The order of objects and lights.

    def _order(self, name: str) -> None:
        """Put each section that is new or moved after the one that it follows. The sections whose
        order is the same stay where they are."""
        was = self._was[name] if name in self._old else ()
        units: dict[int, list[TextSection]] = defaultdict(list)
        for section in self._sections:
            if section.path[:1] == (name,):
                units[was[int(section.path[1])]].append(section)
        numbers = {key: number for number, key in enumerate(was)}
        staying = _rising([numbers[key] for key in self._now[name] if key in units])
        first = next((s for s in self._sections if s.path[:1] == (name,)), None)
        if first is not None:
            target = self._ahead.setdefault(first, [])
        else:
            above = [s.path[:1] for s in self._sections]
            at = above.index(("objects",)) if name == "lights" and ("objects",) in above else None
            target = self._after[self._sections[at - 1] if at else self._sections[-1]]
        for key, table in zip(self._now[name], self._new[name], strict=True):
            if numbers.get(key) in staying:
                target = self._after[units[key][-1]]
            elif key in units:
                target.append("".join(map(self._moved, units[key])))
                self._gone.update(units[key])
            else:
                target.append(self._lines(f"[[{name}]]", table))

    def _moved(self, section: TextSection) -> str:
        text = self._edited(section)
        if text and not text.endswith("\n"):
            text += self._newline
        if len(section.path) > 2:  # comments inside a unit move with it
            text, section.before = section.before + text, ""
        return text

    # The text.

    def _joined(self) -> str:
        parts: list[str] = []
        kept = ""  # comments that belong to no section, between sections that are gone
        blank = False  # whether a new section needs a line between it and the next
        for section in self._sections:
            before = kept + (section.before if section.before.strip() or not kept else "")
            text = "" if section in self._gone else self._edited(section)
            if ahead := self._ahead.get(section):
                parts.append(before)
                self._append(parts, ahead)
                before, blank = "", True
            if text:
                parts += [before or (self._newline if blank else ""), text]
            kept = "" if text else before if before.strip() else ""
            # What then ends in a comment must not stand right above another section's header.
            blank = (
                bool(section.edits) and _ends_in_comment(text) if text else blank or bool(before)
            )
            if after := self._after.get(section):
                self._append(parts, after)
                blank = True
        rest = kept + self._text[self._sections[-1].last :]
        return "".join(parts) + (self._newline if blank and rest.strip() else "") + rest

    def _append(self, parts: list[str], new: list[str]) -> None:
        for text in new:
            last = next((part for part in reversed(parts) if part), "")
            if last and not last.endswith("\n"):
                parts.append(self._newline)
            parts += [
                self._newline if last and not last.endswith(("\n\n", "\r\n\r\n")) else "",
                text,
            ]

    def _edited(self, section: TextSection) -> str:
        text = self._replaced(section.first, section.last, section.edits)
        return text if text.strip() or not section.edits else ""

    def _cut(self, first: int, last: int) -> str:
        names = [edit for edit in self._names if first <= edit[0] < last]
        return self._replaced(first, last, names)

    def _replaced(self, first: int, last: int, edits: list[tuple[int, int, str]]) -> str:
        """Return a part of the text with its edits. Edits inside an earlier one are left out."""
        text, at = [], first
        for begin, end, new in sorted(edits, key=lambda edit: edit[:2]):
            if begin >= at:
                text += [self._text[at:begin], new]
                at = end
        return "".join([*text, self._text[at:last]])


def _at(table: Any, path: Path) -> Any:
    """Return the value at a path; None if there is none."""
    for key in path:
        if isinstance(table, list):
            table = table[int(key)] if isinstance(key, int) and key < len(table) else None
        else:
            table = table.get(key) if isinstance(table, dict) else None
    return table


def _uncovered(
    path: Path, table: Tables, held: set[Path], shared: set[Path]
) -> Iterator[tuple[Path, Any]]:
    """Yield the values of a table that are not in the text. shared: tables that are there in
    part."""
    for key, value in table.items():
        place = (*path, key)
        if place in held:
            continue
        if place in shared:
            yield from _uncovered(place, value, held, shared)
        else:
            yield place, value


def _prefixes(paths: set[Path]) -> set[Path]:
    return {path[:count] for path in paths for count in range(1, len(path))}


def _ends_in_comment(text: str) -> bool:
    return text[line_start(text.rstrip(), len(text)) :].lstrip().startswith("#")


def _rising(numbers: list[int]) -> set[int]:
    """Return the longest rising subsequence."""
    ends: list[int] = []
    chains: list[Any] = []  # (number, the chain before it)
    for number in numbers:
        k = bisect_left(ends, number)
        ends[k : k + 1] = [number]
        chains[k : k + 1] = [(number, chains[k - 1] if k else None)]
    chain, found = chains[-1] if chains else None, set()
    while chain is not None:
        found.add(chain[0])
        chain = chain[1]
    return found
