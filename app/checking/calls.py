"""What a student's code is asked, and what came of it: between a check and what runs the code.

Values are those of JSON. A camera, an object, a scene is a dict: Python code gets it as an object
with attributes, any other program as it stands in JSON.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol


@dataclass(frozen=True)
class Limits:
    """seconds: for all calls together, from the program's start. memory_mb: of the process.
    output: characters of what it prints that are kept. network: it may connect to others."""

    seconds: float = 20.0
    memory_mb: int = 1024
    output: int = 20_000
    network: bool = False


@dataclass(frozen=True)
class Call:
    """One call. function: its name. arguments: names, for messages, and values, in their order.
    vectorised: values that are lists are handed over as NumPy arrays, and the answer is one of
    arrays."""

    function: str
    arguments: tuple[tuple[str, Any], ...]
    vectorised: bool = False


@dataclass(frozen=True)
class Failure:
    """Why there is no answer, in one line with the remedy. traceback: the student's own lines.
    call: the number of the call in the run; None where it was not a call's."""

    kind: Literal["missing", "syntax", "exception", "time", "memory", "ended", "answer"]
    text: str
    traceback: tuple[str, ...] = ()
    call: int | None = None


@dataclass(frozen=True)
class Run:
    """values: of each call, in JSON's values, or the Failure of that call; shorter than the calls
    where the run ended early. output: what was printed, shortened in its middle. failure: what
    ended the run early."""

    values: tuple[Any, ...]
    output: str = ""
    failure: Failure | None = None


class Student(Protocol):
    """What answers calls: a Python file, a program, a file of rays. survived: something that it
    started may still run after `close`."""

    survived: bool

    def functions(self) -> frozenset[str] | None:
        """The functions that it has; None where that cannot be known. Raises LucidaError where it
        cannot be run at all."""

    def call(self, calls: Sequence[Call]) -> Run:
        """All calls, in their order; blocks. May be used again; each time with the time limit."""

    def stop(self) -> None:
        """Ends what runs, from any thread: `call` returns soon, with a failure."""

    def close(self) -> None:
        """Ends its process, and all that it started."""
