"""The command palette's list: everything that can be done, found by a few letters of its name.

Owns the entries, the search and their order. Knows nothing of how they are drawn
(window/palette.py). The bundle's own palette shows no keys and no menus, and lets exceptions pass
through C++.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

CONSECUTIVE, WORD, FIRST = 8, 10, 6  # what a letter is worth after another, at a word, in front
RECENT = 5
# What a query is worth whose words are words of the name, words for it, beginnings of either.
EXACT, SYNONYM, BEGINNING, SYNONYM_BEGINNING = 400, 300, 200, 100
ELSEWHERE = -1000  # its letters are found only with the menu's


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


@dataclass(frozen=True)
class Match:
    """letters: the places in the entry's name that were searched for."""

    entry: Entry
    letters: tuple[int, ...] = ()


def found(query: str, entries: Iterable[Entry], recent: Sequence[str] = ()) -> list[Match]:
    """The entries that hold the query's letters in their order, or mean its words, the best first.

    recent: keys of what was chosen last, the newest first; among equals, and without a query,
    they stand in front.
    """
    rank = {key: position for position, key in enumerate(recent)}
    matches = []
    for order, entry in enumerate(entries):
        result = score(query, entry.name)
        points, letters = result if result is not None else (0, ())
        words = _word_points(query, entry)
        if result is None and not words and query:
            whole = score(query, f"{entry.where} {entry.name}")
            if whole is None:
                continue
            points = whole[0] + ELSEWHERE
        points += words
        place = rank.get(entry.key, len(rank))
        points += RECENT if entry.key in rank else 0
        matches.append((-points if query else 0, place, order, Match(entry, letters)))
    return [match for *_, match in sorted(matches, key=lambda row: row[:3])]


def _word_points(query: str, entry: Entry) -> int:
    """Return the score for a query whose words are all the entry's own, in singular or plural."""
    wanted = [_singular(word) for word in query.lower().split()]
    name = [_singular(word) for word in re.findall(r"\w+", entry.name.lower())]
    also = [_singular(word) for word in entry.also.lower().split()]
    ways = (
        (EXACT, name, str.__eq__),
        (SYNONYM, name + also, str.__eq__),
        (BEGINNING, name, str.startswith),
        (SYNONYM_BEGINNING, name + also, str.startswith),
    )
    for points, words, is_meant in ways if wanted else ():
        if all(any(is_meant(other, word) for other in words) for word in wanted):
            return points
    return 0


def _singular(word: str) -> str:
    return word[:-1] if len(word) > 3 and word.endswith("s") and word[-2] != "s" else word


def score(query: str, text: str) -> tuple[int, tuple[int, ...]] | None:
    """Return how well the query's letters, in order, match a text, and where; None if they
    do not.
    """
    wanted = [letter for letter in query.lower() if not letter.isspace()]
    if not wanted:
        return 0, ()
    lower = text.lower()
    if len(lower) != len(text):  # a letter that has no lower case of one letter
        lower = text
    # Each occurrence of the first letter is a beginning; after it, the nearest letters are taken,
    # those that begin a word before others.
    starts = (start for start, letter in enumerate(lower) if letter == wanted[0])
    found = [places for start in starts if (places := _places(wanted, lower, start))]
    scored = ((_points(places, lower), places) for places in found)
    return max(scored, key=lambda row: row[0], default=None)


def _places(wanted: list[str], text: str, start: int) -> tuple[int, ...] | None:
    places: list[int] = []
    at = start
    for letter in wanted:
        nearest = text.find(letter, at)
        if nearest < 0:
            return None
        if places and nearest != places[-1] + 1:
            word = next((k for k in range(nearest, len(text)) if _at_word(text, k, letter)), -1)
            nearest = word if word >= 0 else nearest
        places.append(nearest)
        at = nearest + 1
    return tuple(places)


def _at_word(text: str, place: int, letter: str) -> bool:
    return text[place] == letter and (place == 0 or not text[place - 1].isalnum())


def _points(places: tuple[int, ...], text: str) -> int:
    points = -len(text) // 4 - (places[0] if places else 0) // 2
    for index, place in enumerate(places):
        if index and place == places[index - 1] + 1:
            points += CONSECUTIVE
        if place == 0 or not text[place - 1].isalnum():
            points += WORD
        if place == index:
            points += FIRST
    return points
