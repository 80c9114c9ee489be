"""A student's Python file as a Student: it runs in a separate process."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any, Self

from lucida.app.checking.tasks import Call, Failure, Limits, Run
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.child import interpreter
from lucida.renderer.system.errors import LucidaError, one_line, shortened

from .account import Account
from .program import (
    ProgramOverError,
    ProgramStudent,
    StudentProgram,
    told_call,
    told_over,
    whole_number,
)

_LONGEST_FILE = 4 << 20  # bytes
_LONGEST_TEXT = 300  # of a message
_PYTHON_MB = 96  # memory of Python and its libraries, on top of the student's limit
_MEMORY_STATUS = 86  # as in student_process.py
_MAIN = 'put what runs on its own under `if __name__ == "__main__":`'
_GARBLED = (ValueError, LookupError, TypeError, RecursionError)  # not written by our code


class NotRunnableError(LucidaError):
    """A file that answers no calls. output: its output up to that point."""

    def __init__(self, failure: Failure, output: str) -> None:
        super().__init__("", failure.text)
        self.failure, self.output = failure, output


class FileStudent(ProgramStudent):
    """A student's Python file, read once, on first use.

    One process serves all calls until one of them ends it; the next run then starts another. Call
    close(): nothing else ends the process while this one lives.

    python: the interpreter; "" for this process's own.
    files: its own imported modules.
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
        self.files: tuple[str, ...] = ()
        self._functions: frozenset[str] = frozenset()
        self._failed: Failure | None = None  # permanent
        self._used_s = 0.0  # time of the process's runs
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
            begin = time.monotonic()
            end = begin + self.limits.seconds
            values: list[Any] = []
            failure = self._start(end)
            if self._program and calls:
                failure = self._run(self._program, calls, values, end)
            if self._program:
                self._printed += self._program.output()
            self._used_s += time.monotonic() - begin
            printed, self._printed = self._printed, self._printed if self._failed else ""
            return Run(tuple(values), printed, failure)

    def _start(self, end: float) -> Failure | None:
        """Start a process that runs the file, unless there is one. Return the failure, if any."""
        if self._closed or self._failed:
            return self._failed or Failure("ended", f"{self._name}: it is closed")
        if self._program and not self._program.stopped and self._used_s < self.limits.seconds:
            return None
        self._end()
        self._used_s = 0.0
        path = os.path.realpath(self._path)
        limits = Limits(self.limits.seconds, self.limits.memory_mb + _PYTHON_MB, self.limits.output)
        python = self._python or interpreter() or "python3"
        try:
            source = read_file(self._path, _LONGEST_FILE).decode("latin-1")
            command = [python, "-I", "-B", "-c", _own_code()]
            program = self._begin(command, os.path.dirname(path), limits)
        except LucidaError as error:
            told = LucidaError("", error.problem, error.remedy, error.source or str(self._path))
            self._failed = Failure("missing", str(told))
            return self._failed
        program.send(json.dumps({"path": path, "source": source}).encode() + b"\n")
        failure = self._imported(program, end)
        if failure:
            self._printed = program.output()
            self._end()
            if not program.stopped:
                self._failed = failure
        return failure

    def _imported(self, program: StudentProgram, end: float) -> Failure | None:
        """Wait until the file is imported. Return the failure, if any."""
        try:
            line = program.line(end)
            told = json.loads(line[1:])
            self.files = tuple(map(str, told["files"]))
            if line[:1] == b"f":
                return self._failure(told, None)
            self._functions = frozenset(map(str, told["functions"]))
            return None
        except ProgramOverError as error:
            over = error
        except _GARBLED:
            over = ProgramOverError("garbled")
        if over.status in (126, 127):
            who = f" that {self._account.name} can read" if self._account else ""
            return Failure("missing", f"no Python could be started; name one{who}: --python")
        return self._over(over, "while the file is imported", _MAIN)

    def _run(
        self, program: StudentProgram, calls: Sequence[Call], values: list[Any], end: float
    ) -> Failure | None:
        """Append the answers to `values`. Return the reason if the run ended early."""
        asked = [(call.function, call.arguments) for call in calls]
        program.send(json.dumps(asked).encode() + b"\n")
        try:
            for call in calls:
                line = program.line(end)
                told = json.loads(line[1:], parse_int=whole_number)
                answer = told if line[:1] == b"a" else self._failure(told, call, len(values))
                values.append(answer)
            return None
        except ProgramOverError as error:
            over = error
        except _GARBLED:
            over = ProgramOverError("garbled")
        number = len(values)
        place = f"in call {number + 1} of {len(calls)}: {told_call(calls[number])}"
        failure = self._over(over, place, "is each call slow, or a loop endless?", number)
        self._printed += program.output()
        self._end()
        return failure

    def _failure(
        self, told: dict[str, Any], call: Call | None, number: int | None = None
    ) -> Failure:
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
        return Failure(kind, f"{where}: {text}{called}", tuple(map(str, told["lines"])), number)

    def _over(
        self, over: ProgramOverError, place: str, endless: str, number: int | None = None
    ) -> Failure:
        """Return the failure for the end of the process."""
        kind, text = told_over(over, self.limits, "its process")
        if over.status == _MEMORY_STATUS:
            kind, text = "memory", f"needs more than the memory limit of {self.limits.memory_mb} MB"
        reason = f"; {endless}" if kind == "time" else ""
        return Failure(kind, f"{self._name}: {text} {place}{reason}", call=number)


@cache
def _own_code() -> str:
    return Path(__file__).with_name("student_process.py").read_text("utf-8") + "\nmain()"
