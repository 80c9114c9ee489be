"""The one kind of error that a user's mistake raises: what is wrong, where, and the remedy.

Knows nothing of who shows it: the command line prints it and exits with 2, the window shows it.
"""

from __future__ import annotations

# Letters that are shown, of what a file can make as long as it likes.
LONGEST_FIELD = 200
LONGEST_PART = 800


class LucidaError(ValueError):
    """A user's mistake, told in one line: `source: field: problem; remedy`.

    field: the path of the offending value, such as "camera.w"; "" where there is none.
    problem: the rule that is broken, with the value. remedy: what to do. source: the file.
    """

    def __init__(self, field: str, problem: str, remedy: str = "", source: str = "") -> None:
        self.field, self.problem, self.remedy, self.source = field, problem, remedy, source
        super().__init__(field, problem, remedy, source)

    def __str__(self) -> str:
        field = shortened(self.field, LONGEST_FIELD)
        problem, remedy = (shortened(part, LONGEST_PART) for part in (self.problem, self.remedy))
        where = "".join(f"{part}: " for part in (self.source, field) if part)
        return one_line(where + problem + (f"; {remedy}" if remedy else ""))

    def within(self, prefix: str) -> LucidaError:
        """The same error with its field under `prefix`: "w" within "camera" is "camera.w"."""
        field = f"{prefix}.{self.field}" if self.field else prefix
        return LucidaError(field, self.problem, self.remedy, self.source)

    def in_file(self, source: str) -> LucidaError:
        """The same error, naming the file that it comes from."""
        return LucidaError(self.field, self.problem, self.remedy, str(source))


def one_line(text: str) -> str:
    """Return the text on one line, without what a terminal would take for a command. Bytes of a
    file's name that are not UTF-8 (lone surrogates in Python) become \\xff."""
    return visible(" ".join(text.split()))


def visible(text: str) -> str:
    """Return the text, with line breaks, and with other control characters escaped."""
    return "".join(c if c.isprintable() or c in "\n\t" else _escaped(c) for c in text)


def shortened(text: str, most: int) -> str:
    """The text, cut in its middle where it has more characters than that."""
    if len(text) <= most:
        return text
    return f"{text[: most // 2]}...{text[-(most // 2 - 3) :]}"


def _escaped(sign: str) -> str:
    code = ord(sign)
    return f"\\x{code - 0xDC00:02x}" if 0xDC80 <= code <= 0xDCFF else repr(sign)[1:-1]


def describe(error: Exception) -> str:
    """One line for the window."""
    if isinstance(error, LucidaError):
        return str(error)
    if isinstance(error, MemoryError):
        return "not enough memory; try a smaller image or model"
    return one_line(f"{type(error).__name__}: {error}")
