"""A scene file's text with other tables in it: what has not changed stays as its author wrote it.

What belongs to what in a text is told by sections.py. A new value takes the place of the old one's
letters; objects and lights are sections that are moved, taken out and put in whole. What comes out
is read again: where it is not what it should be (an arrangement of tables that this module does not
know), the file is written anew, without its comments.
"""

from __future__ import annotations

import contextlib
from bisect import bisect_left
from typing import Any

from renderer.errors import LucidaError
from renderer.scene.list_order import rearranged, rising
from renderer.scene.model import Keys
from renderer.scene.places import Path, Places, Span
from renderer.scene.sections import TextSection, line_end, sections
from renderer.scene.tables import VERSION, parse_toml
from renderer.scene.toml_writing import entries, key_text, toml_text, value_text

LISTS = ("objects", "lights")
MARK = "\ufeff"
Tables = dict[str, Any]


def rewritten(text: str, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> str:
    """The text of a scene file with the tables `new` instead of `old`, which are what it holds.

    old_keys, new_keys: of their objects and lights; the same key is the same section.
    """
    mark, text = (MARK, text[1:]) if text.startswith(MARK) else ("", text)
    if new == old and new_keys == old_keys:
        return mark + text
    with contextlib.suppress(LucidaError, _UnknownFormError):
        found = _Rewriting(text, old, old_keys).to(new, new_keys)
        if parse_toml(found) == new:
            return mark + found
    return mark + toml_text({"lucida": VERSION, **new})


class _UnknownFormError(Exception):
    """Tables are arranged in a way that is not known here."""


class _Rewriting:
    def __init__(self, text: str, old: Tables, keys: Keys) -> None:
        self._text, self._old, self._keys = text, old, dict(zip(LISTS, keys, strict=True))
        self._newline = "\r\n" if "\r\n" in text else "\n"
        self._places = Places(text)
        self._blocks = sections(text, self._places)
        self._there = list(self._blocks)
        self._starts = [block.first for block in self._there]
        self._sections = {block.path: block for block in self._there}
        self._near: dict[Path, list[tuple[Path, Span]]] = {}  # by the first two parts of the path
        for place, span in self._places.spans.items():
            self._near.setdefault(place[:2], []).append((place, span))
        self._tail = text[self._blocks[-1].last :]

    def to(self, new: Tables, keys: Keys) -> str:
        lists = {name: new.get(name) for name in LISTS}
        self._table((), _without(self._old, LISTS), _without(new, LISTS))
        for name, order in zip(LISTS, keys, strict=True):
            self._list(name, lists[name], order)
        parts: list[str] = []
        kept = ""  # of what is gone: comments of nobody
        for block in self._blocks:
            before = kept + (block.before if block.before.strip() or not kept else "")
            kept = ""
            if block.gone:
                kept = before if before.strip() else ""
                continue
            parts += [before, self._block_text(block)]
        return "".join(parts) + kept + self._tail

    # What is where.

    def _block_of(self, offset: int) -> TextSection:
        return self._there[bisect_left(self._starts, offset + 1) - 1]

    def _block_text(self, block: TextSection) -> str:
        if block.new:
            return block.new
        found = self._edited(block.first, block.last, block.edits)
        return found if found.endswith("\n") or not found else found + self._newline

    def _edited(self, first: int, last: int, edits: list[tuple[int, int, str]]) -> str:
        text, at = [], first
        for begin, end, new in sorted(edits, key=lambda edit: edit[:2]):
            text += [self._text[at:begin], new]
            at = max(end, at)
        return "".join([*text, self._text[at:last]])

    def _inside(self, path: Path) -> list[tuple[Path, Span]]:
        """What is at a path or below it."""
        near = self._places.spans.items() if len(path) < 2 else self._near.get(path[:2], [])
        return [(place, span) for place, span in near if place[: len(path)] == path]

    # Fields.

    def _table(self, path: Path, old: Tables, new: Tables) -> None:
        if path == ("materials",):
            old = self._renamed(path, old, new)
        for key in [*old, *(key for key in new if key not in old)]:
            place = (*path, key)
            if key not in new:
                self._remove(place)
            elif key not in old:
                self._add(path, key, new[key])
            elif not _equal(old[key], new[key]):
                self._change(place, old[key], new[key])

    def _renamed(self, path: Path, old: Tables, new: Tables) -> Tables:
        """The tables without those that have another name only, which is written in its place."""
        gone = [key for key in old if key not in new]
        come = [key for key in new if key not in old]
        for key, name in zip(gone, come, strict=False):
            places = self._places.names.get((*path, key), [])
            if places and old[key] == new[name]:
                for first, last in places:
                    self._edit(first, last, key_text(name))
                old = {name if k == key else k: table for k, table in old.items()}
        return old

    def _change(self, path: Path, old: Any, new: Any) -> None:
        if isinstance(old, dict) and isinstance(new, dict) and old:
            self._table(path, old, new)
        elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
            for number, (was, now) in enumerate(zip(old, new, strict=True)):
                if not _equal(was, now):
                    self._change((*path, number), was, now)
        elif path in self._places.spans:
            span = self._places.spans[path]
            self._edit(span.value, span.end, value_text(new))
        else:
            self._remove(path)
            self._add(path[:-1], str(path[-1]), new)

    def _edit(self, first: int, last: int, text: str) -> None:
        self._block_of(first).edits.append((first, last, text))

    def _remove(self, path: Path) -> None:
        span = self._places.spans.get(path)
        if span is not None and span.is_inner:
            self._remove_inner(path, span.start, span.end)
            return
        for _, span in self._inside(path):
            if not span.is_inner:
                first = self._text.rfind("\n", 0, span.start) + 1
                self._edit(first, line_end(self._text, span.end), "")
        for block in self._there:
            if block.path and block.path[: len(path)] == path:
                block.gone = True

    def _remove_inner(self, path: Path, first: int, last: int) -> None:
        """A key with its value out of an inline table, with the comma beside it."""
        inner = [s for place, s in self._inside(path[:-1]) if len(place) == len(path)]
        before = max((span.end for span in inner if span.end < first), default=None)
        after = min((span.start for span in inner if span.start > last), default=None)
        if before is not None:
            self._edit(before, last, "")
        else:
            self._edit(first, last if after is None else after, "")

    def _add(self, path: Path, key: str, value: Any) -> None:
        spans = self._places.spans
        if path in spans:  # an inline table
            inner = [span for place, span in self._inside(path) if len(place) > len(path)]
            text = f"{key_text(key)} = {value_text(value)}"
            end = max((span.end for span in inner), default=None)
            if end is None:
                self._edit(spans[path].value, spans[path].end, f"{{ {text} }}")
            else:
                self._edit(end, end, f", {text}")
            return
        if path in ((), ("materials",)) and isinstance(value, dict):
            self._add_section((*path, key), value)
            return
        block = self._sections.get(path)
        names = [key]
        if block is None:  # dotted keys
            ends = [span.end for _, span in self._inside(path) if not span.is_inner]
            if not ends:
                raise _UnknownFormError
            block, at = self._block_of(max(ends) - 1), line_end(self._text, max(ends))
            names = [*map(str, path[len(block.path) :]), key]
        else:
            at = block.body
        line = f"{'.'.join(map(key_text, names))} = {value_text(value)}{self._newline}"
        if at and self._text[at - 1] != "\n":
            line = self._newline + line
        block.edits.append((at, at, line))

    def _add_section(self, path: Path, value: Tables) -> None:
        """[camera] or [materials.NAME], after the materials, the camera, or all that is above."""
        if path == ("materials",):
            for name, table in value.items():
                self._add_section((*path, name), table)
            return
        kin = [k for k, b in enumerate(self._blocks) if b.path[:1] == ("materials",)]
        kin = kin if path[0] == "materials" else []
        kin = kin or [k for k, b in enumerate(self._blocks) if b.path[:1] in ((), ("camera",))]
        header = ".".join(key_text(str(name)) for name in path)
        self._insert(kin[-1] + 1, self._new(path, f"[{header}]", value))

    def _new(self, path: Path, header: str, table: Tables) -> TextSection:
        lines = [header, *entries(table)]
        text = "".join(line + self._newline for line in lines)
        return TextSection(path, -1, -1, -1, self._newline, new=text)

    def _insert(self, number: int, block: TextSection) -> None:
        if number == 1 and not self._block_text(self._blocks[0]):
            block.before = ""
            if len(self._blocks) > 1 and not self._blocks[1].before:
                self._blocks[1].before = self._newline
        self._blocks.insert(number, block)

    # Objects and lights.

    def _list(self, name: str, new: list[Tables] | None, keys: tuple[int, ...]) -> None:
        old: list[Tables] | None = self._old.get(name)
        was = self._keys[name] if old is not None else ()
        if new is None or (old is not None and new == old and keys == was):
            if new is None and old is not None:
                self._remove((name,))
            return
        place: Path = (name,)
        if place in self._places.spans:  # objects = [...], in one value
            if old:
                self._inline_list(place, old, was, new, keys)
                return
            self._remove(place)
        units = self._units(name, was)
        if not new:
            self._remove(place)
            self._add((), name, [])
            return
        for key, table in zip(keys, new, strict=True):
            if key in units:
                number = was.index(key)
                assert old is not None
                self._table((name, number), old[number], table)
        self._order(name, units, was, dict(zip(keys, new, strict=True)))

    def _inline_list(
        self,
        place: Path,
        old: list[Tables],
        was: tuple[int, ...],
        new: list[Tables],
        keys: tuple[int, ...],
    ) -> None:
        if keys == was:
            self._change(place, old, new)
            return
        span = self._places.spans[place]
        elements = [self._places.spans[*place, number] for number in range(len(old))]
        wanted: list[tuple[int | None, str]] = []
        for key, table in zip(keys, new, strict=True):
            number = was.index(key) if key in was else None
            if number is None:
                wanted.append((None, value_text(table)))
                continue
            self._change((*place, number), old[number], table)
            wanted.append((number, self._taken(elements[number])))
        written = rearranged(self._text, span, elements, wanted) if new else "[]"
        if written is None:
            lines = "".join(f"{self._newline}    {value_text(table)}," for table in new)
            written = f"[{lines}{self._newline}]"
        self._edit(span.value, span.end, written)

    def _taken(self, span: Span) -> str:
        """The text of a value with its edits, which are the section's no more."""
        block = self._block_of(span.value)
        mine = [edit for edit in block.edits if span.value <= edit[0] and edit[1] <= span.end]
        block.edits = [edit for edit in block.edits if edit not in mine]
        return self._edited(span.value, span.end, mine)

    def _units(self, name: str, keys: tuple[int, ...]) -> dict[int, list[TextSection]]:
        """The sections of each object, [[objects]] and those inside it."""
        units: dict[int, list[TextSection]] = {}
        for block in self._there:
            if block.path[:1] == (name,):
                if len(block.path) < 2:
                    raise _UnknownFormError
                units.setdefault(keys[int(block.path[1])], []).append(block)
        return units

    def _order(
        self,
        name: str,
        units: dict[int, list[TextSection]],
        was: tuple[int, ...],
        new: dict[int, Any],
    ) -> None:
        """Takes out what is gone, and puts each section that is new or moved after the one that it
        follows; what stays in order stays where it is."""
        staying = rising([was.index(key) if key in units else -1 for key in new])
        keys = list(new)
        stays = {keys[number] for number in staying}
        first = next((k for k, b in enumerate(self._blocks) if b.path[:1] == (name,)), None)
        for key, blocks in units.items():
            if key not in new:
                for block in blocks:
                    block.gone = True
            elif key not in stays:
                copies = [self._moved(block) for block in blocks]
                for block in blocks:
                    block.gone = True
                units[key] = copies
        after: TextSection | None = None
        for key in keys:
            if key not in stays:
                blocks = units.get(key) or [self._new((name, -1), f"[[{name}]]", new[key])]
                if after is not None:
                    at = self._blocks.index(after) + 1
                elif first is not None:
                    at = first
                else:
                    at = self._end_for(name)
                for shift, block in enumerate(blocks):
                    self._insert(at + shift, block)
                if after is None and first is not None and at + len(blocks) < len(self._blocks):
                    self._swap_before(blocks[0], self._blocks[at + len(blocks)])
                units[key] = blocks
            after = units[key][-1]

    def _swap_before(self, block: TextSection, following: TextSection) -> None:
        """What stood above the first of a list stays above the list."""
        block.before, following.before = following.before, block.before or self._newline

    def _moved(self, block: TextSection) -> TextSection:
        text = self._block_text(block)
        before = self._newline if len(block.path) == 2 else block.before
        return TextSection(block.path, -1, -1, -1, before, new=text)

    def _end_for(self, name: str) -> int:
        """Where a list begins that the file does not have: objects at the end, lights before."""
        if name == "objects":
            return len(self._blocks)
        found = (k for k, b in enumerate(self._blocks) if b.path[:1] == ("objects",))
        return next(found, len(self._blocks))


def _equal(one: Any, other: Any) -> bool:
    return (type(one) is type(other) and bool(one == other)) or (
        isinstance(one, int | float)
        and isinstance(other, int | float)
        and not isinstance(one, bool)
        and not isinstance(other, bool)
        and one == other
    )


def _without(tables: Tables, names: tuple[str, ...]) -> Tables:
    return {key: value for key, value in tables.items() if key not in names}
