"""The classic mistakes, read from the tables in catalogue/.

A part has correct lines and the mistakes in them. `{name}` is replaced by a value that depends on
the task. A mistake has a name, a hint, and `wrong`: either the wrong code of a line, by the line's
name, or a wrong value, by the value's name. A wrong value is wrong in each line that uses it. Code
that is correct in a task is no mistake there.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Set
from pathlib import Path

import msgspec

from .program import CodeLine, Mistake, Swaps

FOLDER = Path(__file__).parent / "catalogue"

Values = Mapping[str, str]
Part = tuple[list[CodeLine], list[Mistake]]


class _Row(msgspec.Struct, forbid_unknown_fields=True):
    """A mistake in the table.

    hint: "" to use the hint of the mistake with the same name in [closest-hit].
    title: the lecture's step to read again, if it differs from the part's.
    when: the facts about a task in which people make it; "not ..." for a fact that must not hold.
    rare: True if few people make it.
    alone: True if it can also be made in only the columns, or only the rows.
    swaps: as in Mistake.
    """

    name: str
    wrong: dict[str, str]
    hint: str = ""
    title: str = ""
    when: tuple[str, ...] = ()
    rare: bool = False
    alone: bool = False
    swaps: Swaps = ()


class _Table(msgspec.Struct, forbid_unknown_fields=True):
    title: str
    lines: dict[str, str]
    mistakes: tuple[_Row, ...] = ()


@functools.cache
def _catalogue() -> dict[str, _Table]:
    tables: dict[str, _Table] = {}
    for path in FOLDER.glob("*.toml"):
        tables |= msgspec.toml.decode(path.read_bytes(), type=dict[str, _Table])
    return tables


def part(
    name: str,
    values: Values | None = None,
    facts: Set[str] = frozenset(),
    angles: Values | None = None,
) -> Part:
    """Return the lines of a part, and their mistakes.

    values: the values of the names in braces.
    facts: the facts that hold for the task, as in _Row.when.
    angles: the task's word for the angle of each edge of the viewport, by the edge's name in the
    part. The mistakes in the use of angles come first.
    """
    values, table, angle = values or {}, _catalogue()[name], _catalogue()["angle"]
    rows = [(table.title, row) for row in table.mistakes]
    if angles:
        values = {**values, **_edges(angle.lines["edge"], angles)}
        rows[:0] = [
            (angle.title, msgspec.structs.replace(row, wrong=_edges(row.wrong["edge"], angles)))
            for row in angle.mistakes
        ]
    lines = _filled(table.lines, values)
    made: list[Mistake] = []
    for title, row in rows:
        if all(
            (fact.removeprefix("not ") in facts) != fact.startswith("not ") for fact in row.when
        ):
            wrong = _filled(row.wrong, values)
            written = _filled(table.lines, {**values, **wrong})
            written |= {key: wrong[key] for key in lines.keys() & wrong.keys()}
            made += _mistakes(row, title, values, _changed(lines, written))
    return [CodeLine(*line) for line in lines.items()], made


def _edges(code: str, angles: Values) -> dict[str, str]:
    return {
        edge: code.format(word=word, angle=word if word.endswith("_rad") else f"radians({word})")
        for edge, word in angles.items()
    }


def _filled(texts: Values, values: Values) -> dict[str, str]:
    return {key.format_map(values): text.format_map(values) for key, text in texts.items()}


def _changed(lines: Values, written: Values) -> Swaps:
    return tuple((key, written[key]) for key, code in lines.items() if written[key] != code)


def _mistakes(row: _Row, title: str, values: Values, wrong: Swaps) -> list[Mistake]:
    """Return a row's mistake; an empty list if nothing is wrong."""
    hint = row.hint or next(
        r.hint for r in _catalogue()["closest-hit"].mistakes if r.name == row.name
    )
    hint, title = hint.format_map(values), (row.title or title).format_map(values)
    swaps = tuple((old.format_map(values), new.format_map(values)) for old, new in row.swaps)
    made = [Mistake(row.name, wrong, hint, title, not row.rare, swaps)] if wrong else []
    if row.alone:
        for line, word in zip(wrong, ("column", "row"), strict=True):
            name = f"{row.name}: in the {word}s"
            told = f"In the {word}s alone: {hint}"
            made.append(Mistake(name, (line,), told, title, is_common=False))
    return made
