"""The one kind of error that a user's mistake raises: what is wrong, where, and the remedy.

Knows nothing of who shows it: the command line prints it and exits with 2, the window shows it.
"""

from __future__ import annotations


class LucidaError(ValueError):
    """A user's mistake, told in one line: `source: field: problem; remedy`.

    field: the path of the offending value, such as "camera.w"; "" where there is none.
    problem: the rule that is broken, with the value. remedy: what to do. source: the file.
    """

    def __init__(self, field: str, problem: str, remedy: str = "", source: str = "") -> None:
        self.field, self.problem, self.remedy, self.source = field, problem, remedy, source
        super().__init__(field, problem, remedy, source)

    def __str__(self) -> str:
        where = "".join(f"{part}: " for part in (self.source, self.field) if part)
        text = where + self.problem + (f"; {self.remedy}" if self.remedy else "")
        return one_line(text)

    def within(self, prefix: str) -> LucidaError:
        """The same error with its field under `prefix`: "w" within "camera" is "camera.w"."""
        field = f"{prefix}.{self.field}" if self.field else prefix
        return LucidaError(field, self.problem, self.remedy, self.source)

    def in_file(self, source: str) -> LucidaError:
        """The same error, naming the file that it comes from."""
        return LucidaError(self.field, self.problem, self.remedy, str(source))


def one_line(text: str) -> str:
    """The text without line breaks, and without what a terminal would take for a command."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in " ".join(text.split()))
