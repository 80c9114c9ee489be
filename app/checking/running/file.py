"""A student's Python file as a Student: it runs in a separate process."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Self

from lucida.app.checking.tasks import Call, Failure, Limits, Run
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.child import interpreter
from lucida.renderer.system.errors import LucidaError, one_line, shortened

from .account import Account
from .program import ProgramOverError, ProgramStudent, StudentProgram, told_call, whole_number

_LONGEST_FILE = 4 << 20  # bytes
_LONGEST_TEXT = 300  # of a message
_PYTHON_MB = 96  # memory of Python and its libraries, on top of the student's limit
_MAIN = 'put what runs on its own under `if __name__ == "__main__":`'
_GARBLED = "it wrote into a file of ours: one that it has not opened itself"


class NotRunnableError(LucidaError):
    """The file cannot answer calls. output: its output up to that point."""

    def __init__(self, failure: Failure, output: str) -> None:
        super().__init__("", failure.text)
        self.failure, self.output = failure, output


class FileStudent(ProgramStudent):
    """A student's Python file, read once, on first use.

    One process serves all calls until one of them ends it; the next run then starts another. Call
    close(), because nothing else ends the process before this one exits.

    python: the interpreter; "" for this process's own.
    """

    def __init__(
        self,
        path: Path | str,
        limits: Limits | None = None,
        python: str = "",
        account: Account | None = None,
    ) -> None:
        self._path, self._python = Path(path), python
        super().__init__(one_line(self._path.name), limits, account)
        self._functions: frozenset[str] = frozenset()
        self._failed: Failure | None = None  # permanent
        self._printed = ""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def functions(self) -> frozenset[str]:
        """Return the names of all callables in the file. Raises NotRunnableError."""
        with self._turn:
            failure = self._start(time.monotonic() + self.limits.seconds)
            if failure:
                raise NotRunnableError(failure, self._printed)
            return self._functions

    def call(self, calls: Sequence[Call]) -> Run:
        with self._turn:
            end = time.monotonic() + self.limits.seconds
            values: list[Any] = []
            failure = self._start(end)
            if self._program and calls:
                asked = [(call.function, call.arguments) for call in calls]
                failure = self._answers(self._program, asked, calls, values, end)
                self._printed += self._program.output()
                if failure:
                    self._end()
            printed, self._printed = self._printed, self._printed if self._failed else ""
            return Run(tuple(values), printed, failure)

    def _start(self, end: float) -> Failure | None:
        """Start a process that runs the file, unless there is one. Return the failure, if any."""
        if self._closed:
            return Failure("ended", f"{self._name}: it is closed")
        if self._failed or (self._program and not self._program.stopped):
            return self._failed
        self._end()
        path = os.path.realpath(self._path)
        limits = replace(self.limits, memory_mb=self.limits.memory_mb + _PYTHON_MB)
        python = self._python or interpreter() or "python3"
        try:
            source = read_file(self._path, _LONGEST_FILE).decode("latin-1")
            command = [python, "-I", "-B", "-c", _own_code()]
            program = self._begin(command, os.path.dirname(path), limits)
        except LucidaError as error:
            told = LucidaError("", error.problem, error.remedy, error.source or str(self._path))
            self._failed = Failure("missing", str(told))
            return self._failed
        opened: list[Any] = []
        failure = self._answers(program, {"path": path, "source": source}, [None], opened, end)
        failure = failure or (opened[0] if isinstance(opened[0], Failure) else None)
        self._printed += program.output()
        if failure:
            self._end()
            self._failed = None if program.stopped else failure
        else:
            self._functions = frozenset(map(str, opened[0] if isinstance(opened[0], list) else ()))
        return failure

    def _answers(
        self,
        program: StudentProgram,
        request: Any,
        calls: Sequence[Call | None],
        values: list[Any],
        end: float,
    ) -> Failure | None:
        """Append the answers to `values`. Return the reason if the process ended early.

        calls: those of the request; None for the file's import.
        """
        program.send(json.dumps(request).encode() + b"\n")
        try:
            for call in calls:
                line = program.line(end)
                told = json.loads(line[1:], parse_int=whole_number)
                values.append(told if line[:1] == b"a" else self._failure(told, call, len(values)))
            return None
        except ProgramOverError as error:
            over = error
        except (ValueError, LookupError, TypeError, RecursionError):  # not from our code
            over = ProgramOverError("ended", _GARBLED)
        number = len(values)
        call, place, remedy = calls[number], "while the file is imported", _MAIN
        if call is not None:
            place = f"in call {number + 1} of {len(calls)}: {told_call(call)}"
            remedy = "is each call slow, or a loop endless?"
        text = f"{self._name}: {over.text} {place}{f'; {remedy}' if over.kind == 'time' else ''}"
        return Failure(over.kind, text, call=None if call is None else number)

    def _failure(self, told: dict[str, Any], call: Call | None, number: int) -> Failure:
        """Return the failure for an exception or an invalid answer that the process reported."""
        kind: Any = str(told["kind"])  # a Kind
        text = shortened(one_line(told["text"]), _LONGEST_TEXT)
        where = one_line(told["where"]) or self._name
        called = f"; called as {told_call(call)}" if call else ""
        if kind == "answer":
            wanted = "numbers, lists, arrays, or an object with origin and direction"
            text = f"returned {text}; wanted are {wanted}"
        elif kind == "memory":
            text = f"it needs more than the memory limit of {self.limits.memory_mb} MB ({text})"
        elif kind == "ended":
            text = f"it ends the program ({text}); {'a function is to return' if call else _MAIN}"
        elif text.startswith("EOFError: EOF when reading a line"):
            text += f"; input() finds nothing here: {'use the arguments' if call else _MAIN}"
        lines = tuple(map(str, told["lines"]))
        return Failure(kind, f"{where}: {text}{called}", lines, number if call else None)


@cache
def _own_code() -> str:
    return Path(__file__).with_name("student_process.py").read_text("utf-8") + "\nmain()"
