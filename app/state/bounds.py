"""Bounds of options, as marks on their fields: `exposure_ev: Annotated[float, Range(-8, 8)]`.

Values from sessions and lectures are checked; values from the window's keys and fields are clamped.
msgspec has already checked their types, and ignores the marks. Its own Meta supports neither lists
of values nor check functions, and has other messages.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import MISSING, dataclass, fields, is_dataclass, replace
from functools import cache
from operator import is_
from typing import Annotated, Any, TypeVar, get_args, get_origin, get_type_hints

from lucida.renderer.system.errors import LucidaError

T = TypeVar("T")


class OptionPart:
    """A part of the options, such as an instrument's: the base of a frozen dataclass."""


# A mark has two methods: problem(value) returns the problem and the remedy, or None;
# clamped(value, default) returns the nearest valid value, or the default if none is near.


@dataclass(frozen=True)
class Range:
    """Numbers from least to most, both included."""

    least: float
    most: float

    def problem(self, value: float) -> tuple[str, str] | None:
        if self.least <= value <= self.most:  # false for NaN
            return None
        return f"{_text(value)} is out of range", f"give {_text(self.least)} to {_text(self.most)}"

    def clamped(self, value: float, default: Any) -> Any:
        if value != value:  # NaN; math.isnan() does not accept large integers
            return self.least if default is None else default
        return type(value)(min(max(value, self.least), self.most))


@dataclass(frozen=True)
class OneOf:
    """One of a few numbers."""

    values: tuple[int, ...]

    def problem(self, value: int) -> tuple[str, str] | None:
        if value in self.values:
            return None
        return f"{value} is not possible", f"give one of {', '.join(map(str, self.values))}"

    def clamped(self, value: int, default: Any) -> Any:
        return min(self.values, key=lambda known: abs(known - value))


@dataclass(frozen=True)
class AtMost:
    """A list of at most `count` entries; clamping keeps the last, newest ones."""

    count: int

    def problem(self, value: tuple[Any, ...]) -> tuple[str, str] | None:
        if len(value) <= self.count:
            return None
        return f"has {len(value)} entries", f"give at most {self.count}"

    def clamped(self, value: tuple[Any, ...], default: Any) -> Any:
        return value[-self.count :]


@dataclass(frozen=True)
class Beside:
    """The path of a file, "" for none. A lecture names one in its own folder; its reader makes that
    absolute.
    """

    endings: tuple[str, ...]

    def problem(self, value: str) -> tuple[str, str] | None:
        if not value or value.lower().endswith(self.endings):
            return None
        return f"{value!r} is no such file", f"give one that ends in {' or '.join(self.endings)}"

    def clamped(self, value: str, default: Any) -> Any:
        return default


@dataclass(frozen=True)
class Accepted:
    """A value that another module's check accepts. It raises LucidaError for any other."""

    check: Callable[[Any], object]

    def problem(self, value: Any) -> tuple[str, str] | None:
        try:
            self.check(value)
        except LucidaError as error:
            return error.problem, error.remedy
        return None

    def clamped(self, value: Any, default: Any) -> Any:
        return default


def check(kind: type, values: Any) -> None:
    """Raise LucidaError for the first value that is out of bounds, with its field's path.

    kind: a dataclass. values: one of that kind, or a dict with some of its fields, whose parts may
    be dicts again.
    """
    problems: list[LucidaError] = []
    _bounded(kind, values, None, "", problems)
    if problems:
        raise problems[0]


def clamped(options: T) -> T:
    """Return the dataclass with every value within its bounds; the same object if all are."""
    kept: T = _bounded(type(options), options, None, "", [])
    return kept


def range_of(kind: type, field: str) -> tuple[float, float]:
    """Return (least, most) of a number's field or a list's entries, for a slider."""
    found = [mark for mark in _marks_inside(_hints(kind)[field]) if isinstance(mark, Range)]
    return float(found[0].least), float(found[0].most)


def whole_range_of(kind: type, field: str) -> tuple[int, int]:
    """Return range_of() for whole numbers."""
    least, most = range_of(kind, field)
    return int(least), int(most)


def files_of(kind: type) -> tuple[str, ...]:
    """Return the fields that hold a file's path."""
    return tuple(
        name
        for name, hint in _hints(kind).items()
        if any(isinstance(mark, Beside) for mark in _marks_inside(hint))
    )


def _text(number: float) -> str:
    return f"{number:g}" if isinstance(number, float) else str(number)


@cache
def _hints(kind: type) -> dict[str, Any]:
    hints = get_type_hints(kind, include_extras=True)
    return {field.name: hints[field.name] for field in fields(kind)}


def _marks_inside(hint: Any) -> Iterator[Any]:
    """Yield the marks of a hint, then those of its arguments."""
    if get_origin(hint) is Annotated:
        yield from hint.__metadata__
    for part in get_args(hint):
        yield from _marks_inside(part)


def _bounded(hint: Any, value: Any, default: Any, path: str, problems: list[LucidaError]) -> Any:
    """Clamp everything in the value; return the value itself if it is within bounds.

    Append a LucidaError to problems for each value that was not.
    """
    parts = get_args(hint)
    if value is None:
        return None
    if get_origin(hint) is Annotated:
        for mark in hint.__metadata__:
            if found := mark.problem(value):
                problems.append(LucidaError(path, *found))
                value = mark.clamped(value, default)
    elif is_dataclass(hint):
        return _bounded_fields(hint, value, path, problems)  # type: ignore[arg-type]
    elif get_origin(hint) is tuple:
        hints = parts[:1] * len(value) if Ellipsis in parts else parts
        defaults = (*(default if isinstance(default, tuple) else ()), *[None] * len(value))
        after = tuple(
            _bounded(*entry, f"{path}[{k}]", problems)
            for k, entry in enumerate(zip(hints, value, defaults, strict=False))
        )
        return value if all(map(is_, after, value)) else after
    elif type(None) not in parts:
        return value
    return _bounded(parts[0], value, default, path, problems)  # of Annotated, or of `int | None`


def _bounded_fields(kind: type, value: Any, path: str, problems: list[LucidaError]) -> Any:
    changes = {}
    for name, hint in _hints(kind).items():
        before = value.get(name) if isinstance(value, dict) else getattr(value, name)
        where = f"{path}.{name}" if path else name
        after = _bounded(hint, before, getattr(kind, name, MISSING), where, problems)
        if after is not before:
            changes[name] = after
    if not changes:
        return value
    return value | changes if isinstance(value, dict) else replace(value, **changes)
