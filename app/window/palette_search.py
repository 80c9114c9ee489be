"""The command palette's list: everything that can be done, found by a few letters of its name.

Owns the entries, the search and their order. Knows nothing of how they are drawn
(window/palette.py). The bundle's own palette shows no keys and no menus, and lets exceptions pass
through C++.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

RECENT = 5
# What a query is worth whose words are words of the name, words for it, or beginnings of either, or
# of the menu's; whose letters are the first ones of the name's words, or are all in the name.
EXACT, SYNONYM, BEGINNING, SYNONYM_BEGINNING, ELSEWHERE = 400, 300, 200, 100, 50
INITIALS, LETTERS = 30, 20


@dataclass(frozen=True)
class Entry:
    """Something to do. where: its menu path. keys: as shown. key: what it is remembered by.
    on: of a switch. also: other words for it, separated by blanks."""

    name: str
    where: str
    run: Callable[[], None]
    keys: str = ""
    enabled: bool = True
    on: bool = False
    also: str = ""

    @property
    def key(self) -> str:
        return f"{self.where} > {self.name}"


def found(query: str, entries: Iterable[Entry], recent: Sequence[str] = ()) -> list[Entry]:
    """Return the entries that a query means, the best first.

    recent: keys of what was chosen last, the newest first; among equals, and without a query,
    they stand in front.
    """
    rank = {key: position for position, key in enumerate(recent)}
    matches = []
    for order, entry in enumerate(entries):
        points = _points(query, entry)
        if query and not points:
            continue
        place = rank.get(entry.key, len(rank))
        points += RECENT if entry.key in rank else 0
        matches.append((-points if query else 0, place, order, entry))
    return [entry for *_, entry in sorted(matches, key=lambda row: row[:3])]


def _points(query: str, entry: Entry) -> int:
    """Return how well a query means an entry; words count in singular and plural. 0: not at all."""
    wanted, name, also, where = map(_words, (query, entry.name, entry.also, entry.where))
    ways = (
        (EXACT, name, str.__eq__),
        (SYNONYM, name + also, str.__eq__),
        (BEGINNING, name, str.startswith),
        (SYNONYM_BEGINNING, name + also, str.startswith),
        (ELSEWHERE, where + name, str.startswith),
    )
    for points, words, is_meant in ways if wanted else ():
        if all(any(is_meant(other, word) for other in words) for word in wanted):
            return points
    letters = query.lower().replace(" ", "")
    for points, text in ((INITIALS, "".join(word[0] for word in name)), (LETTERS, "".join(name))):
        rest = iter(text)
        if letters and all(letter in rest for letter in letters):  # in this order
            return points
    return 0


def _words(text: str) -> list[str]:
    return [_singular(word) for word in re.findall(r"\w+", text.lower())]


def _singular(word: str) -> str:
    return word[:-1] if len(word) > 3 and word.endswith("s") and word[-2] != "s" else word
