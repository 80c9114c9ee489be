"""The exception for all user errors, with the place, the problem and the remedy.

The command line prints it and exits with status 2; the window shows it.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator

# Limits on the characters shown, because a file can make these texts arbitrarily long.
LONGEST_FIELD = 200
LONGEST_PART = 800


class LucidaError(ValueError):
    """A user error, reported in one line: `source: field: problem; remedy`.

    field: the path of the offending value, such as "camera.w"; "" if there is none. problem: the
    broken rule, with the value. remedy: the advice. source: the file.
    """

    def __init__(self, field: str, problem: str, remedy: str = "", source: str = "") -> None:
        self.field, self.problem, self.remedy, self.source = field, problem, remedy, source
        super().__init__(field, problem, remedy, source)

    def __str__(self) -> str:
        field = shortened(self.field, LONGEST_FIELD)
        problem, remedy = (shortened(part, LONGEST_PART) for part in (self.problem, self.remedy))
        where = "".join(f"{part}: " for part in (self.source, field) if part)
        return one_line(where + problem + (f"; {remedy}" if remedy else ""))

    def __repr__(self) -> str:
        return f"LucidaError({shortened(str(self), LONGEST_PART)!r})"

    def within(self, prefix: str, sign: str = ".") -> LucidaError:
        """Return the same error with its field under `prefix`: "w" within "camera" is
        "camera.w".
        """
        field = sign.join(part for part in (prefix, self.field) if part)
        return LucidaError(field, self.problem, self.remedy, self.source)

    def in_file(self, source: str) -> LucidaError:
        """Return the same error, naming its file."""
        return LucidaError(self.field, self.problem, self.remedy, str(source))

    def at_its_line(self, source: str) -> LucidaError:
        """Return the same error in a file. A field `line 5, column 9` becomes `file:5: column 9`,
        the form that editors open.
        """
        place = re.fullmatch(r"line (\d+)(?:, (column \d+))?", self.field)
        if place is None:
            return self.in_file(source)
        return LucidaError(place[2] or "", self.problem, self.remedy, f"{source}:{place[1]}")

    def of_file_in(self, field: str) -> LucidaError:
        """Return the same error as a problem of the field that names its file."""
        parts = [part for part in (self.source, self.field) if part and part != field]
        return LucidaError(field, ": ".join([*parts, self.problem]), self.remedy)


@contextlib.contextmanager
def under(field: str, sign: str = ".") -> Iterator[None]:
    """Put the fields of errors raised inside under `field`; see LucidaError.within."""
    try:
        yield
    except LucidaError as error:
        raise error.within(field, sign) from None


@contextlib.contextmanager
def errors_as(field: str) -> Iterator[None]:
    """Assign this field to errors raised inside."""
    try:
        yield
    except LucidaError as error:
        raise LucidaError(field, error.problem, error.remedy) from None


def one_line(text: str) -> str:
    r"""Return the text on one line, without control sequences for a terminal.

    Bytes of a file name that are not UTF-8 (lone surrogates in Python) become \xff.
    """
    return visible(" ".join(text.split()))


def counted(*counts: tuple[int, str]) -> str:
    """Return counts as text: `2 objects, 1 light`."""
    return ", ".join(f"{count} {what}{'s' * (count != 1)}" for count, what in counts)


def quoted(text: str) -> str:
    """Return a name on one line, between quotation marks."""
    return f"'{one_line(text)}'"


def visible(text: str) -> str:
    """Return the text with control characters escaped, except for line breaks and tabs, and the
    joiners that Persian words and emoji need.
    """
    return "".join(c if c.isprintable() or c in "\n\t\u200c\u200d" else _escaped(c) for c in text)


def shortened(text: str, most: int) -> str:
    """Return the text, shortened in the middle if it has more than `most` characters."""
    if len(text) <= most:
        return text
    return f"{text[: most // 2]}...{text[-(most // 2 - 3) :]}"


def _escaped(sign: str) -> str:
    code = ord(sign)
    return f"\\x{code - 0xDC00:02x}" if 0xDC80 <= code <= 0xDCFF else repr(sign)[1:-1]


def describe(error: Exception) -> str:
    """Return an error as one line for the window."""
    if isinstance(error, LucidaError):
        return str(error)
    if isinstance(error, MemoryError):
        return "not enough memory; try a smaller image or model"
    return one_line(f"{type(error).__name__}: {error}")


def not_together(field: str, other: str, remedy: str = "give one of the two") -> LucidaError:
    """Return the error of two values that exclude each other."""
    return LucidaError(field, f"cannot be used together with {other}", remedy)
