"""Calls to a student's code and their results: the interface between a check and what runs the
code.

Values are JSON values. A camera, an object or a scene is a dict: Python code receives it as an
object with attributes, any other program as plain JSON.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from lucida.app.state.options.shared import Notation

Kind = Literal["missing", "syntax", "exception", "time", "memory", "ended", "answer"]


@dataclass(frozen=True)
class Limits:
    """Limits of a run of the student's code.

    seconds: for all calls together, from the program's start.
    memory_mb: memory of each process, on Linux.
    output: the number of printed characters that are kept.
    """

    seconds: float = 20.0
    memory_mb: int = 1024
    output: int = 20_000


@dataclass(frozen=True)
class Call:
    """One call.

    function: its name.
    arguments: names, for messages, and values, in their order.
    as_arrays: lists are passed as NumPy arrays.
    notation: of the names in messages.
    """

    function: str
    arguments: tuple[tuple[str, Any], ...]
    as_arrays: bool = False
    notation: Notation = "code"


@dataclass(frozen=True)
class Failure:
    """The reason for a missing answer, in one line with the remedy.

    traceback: the student's own lines.
    call: the number of the call in the run; None if no call caused it.
    """

    kind: Kind
    text: str
    traceback: tuple[str, ...] = ()
    call: int | None = None


@dataclass(frozen=True)
class Run:
    """The results of a run.

    values: for each call, its JSON value or its Failure; shorter than the calls if the run ended
    early.
    output: the printed text, shortened in the middle.
    failure: the reason why the run ended early, or None.
    """

    values: tuple[Any, ...]
    output: str = ""
    failure: Failure | None = None


class Student(Protocol):
    """The interface of whatever answers calls: a Python file or a program.

    survived: True if something that it started may still be running after `close`.
    """

    survived: bool

    def functions(self) -> frozenset[str] | None:
        """Return the names of its functions; None if they cannot be known. Raises LucidaError if it
        cannot be run at all.
        """

    def call(self, calls: Sequence[Call]) -> Run:
        """Run all calls in order, and block until they are done. May be called again; the time
        limit applies to each run.
        """

    def restart(self) -> None:
        """Make the next run begin in a new process, which remembers no call."""

    def stop(self) -> None:
        """Stop the current run, from any thread: `call` returns soon, with a failure."""

    def close(self) -> None:
        """End its process, and everything that it started."""
