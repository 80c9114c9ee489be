"""A student's Python file as a Student: it runs in a separate process."""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any, Self

from app.checking.calls import Call, Failure, Limits, Run
from app.checking.running.account import Account
from app.checking.running.program import ProgramOverError, StudentProgram
from app.checking.running.told import told_call, told_over, whole_number
from renderer.child import interpreter
from renderer.errors import LucidaError, one_line
from renderer.scene.reading import read_file

_LONGEST_FILE = 4 << 20  # bytes
_PYTHON_MB = 96  # memory of Python and its libraries, on top of the student's limit
_MEMORY_STATUS = 86  # as in student_process.py
_MAIN = 'put what runs on its own under `if __name__ == "__main__":`'
_GARBLED = (ValueError, LookupError, TypeError, RecursionError)  # not written by our code
_WROTE_BETWEEN = "it wrote into a file of ours: one that it has not opened itself"


class NotRunnableError(LucidaError):
    """A file that answers no calls. output: its output up to that point."""

    def __init__(self, failure: Failure, output: str) -> None:
        super().__init__("", failure.text)
        self.failure, self.output = failure, output


class FileStudent:
    """A student's Python file, read once, on first use.

    One process serves all calls until one of them ends it; the next run then starts another. Call
    close(): nothing else ends the process while this one lives.

    python: the interpreter; "" for this process's own.
    account: the user that it runs as; None for this process's own.
    survived: True if something that it started may still be running.
    """

    def __init__(
        self,
        path: Path | str,
        limits: Limits | None = None,
        python: str = "",
        account: Account | None = None,
    ) -> None:
        self._path, self.limits = Path(path), limits or Limits()
        self._python, self._account = python, account
        self.survived = False
        self.files: tuple[str, ...] = ()  # its own imported modules
        self._name = one_line(self._path.name)
        self._turn = threading.Lock()  # allows one run at a time
        self._change = threading.Lock()
        self._program: StudentProgram | None = None
        self._functions: frozenset[str] = frozenset()
        self._failed: Failure | None = None  # permanent
        self._closed = False
        self._used_s = 0.0  # time of the process's runs
        self._printed = ""
        self._values: list[Any] = []

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

    @property
    def answered(self) -> int:
        """The number of answered calls in the current or last run. Safe to read from any thread."""
        return len(self._values)

    def call(self, calls: Sequence[Call]) -> Run:
        with self._turn:
            begin = time.monotonic()
            end = begin + self.limits.seconds
            values = self._values = []
            failure = self._start(end)
            if failure is None and calls:
                failure = self._run(calls, values, end)
            if self._program:
                self._printed += self._program.output()
            self._used_s += time.monotonic() - begin
            printed, self._printed = self._printed, self._printed if self._failed else ""
            return Run(tuple(values), printed, failure)

    def stop(self) -> None:
        with self._change:
            program = self._program
        if program:
            program.stop()

    def close(self) -> None:
        self._closed = True
        self.stop()
        with self._turn:
            self._end()

    def _start(self, end: float) -> Failure | None:
        """Start a process that runs the file, unless there is one. Return the failure, if any."""
        closed = Failure("ended", f"{self._name}: it is closed")
        if self._closed or self._failed:
            return self._failed or closed
        if self._program and self._used_s < self.limits.seconds:
            return None
        self._end()
        self._used_s = 0.0
        opening = {"path": os.path.realpath(self._path)}
        try:
            opening["source"] = self._source().decode("latin-1")
            with self._change:
                program = self._program = self._started()
        except LucidaError as error:
            self._failed = Failure("missing", str(error))
            return self._failed
        program.send(json.dumps(opening).encode() + b"\n")
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
        except ProgramOverError as over:
            if over.status in (126, 127):
                who = f" that {self._account.name} can read" if self._account else ""
                return Failure("missing", f"no Python could be started; name one{who}: --python")
            return self._over(over, "while the file is imported", _MAIN)
        except _GARBLED:
            return Failure("ended", f"{self._name}: {_WROTE_BETWEEN}")
        return None

    def _source(self) -> bytes:
        try:
            return read_file(self._path, _LONGEST_FILE)
        except LucidaError as error:
            raise LucidaError("", error.problem, error.remedy, str(self._path)) from None

    def _started(self) -> StudentProgram:
        python = self._python or interpreter() or "python3"
        code = f"import sys; at_start = frozenset(sys.modules)\n{_own_code()}\nmain(at_start)"
        limits = self.limits
        folder = os.path.dirname(os.path.realpath(self._path))
        whole = Limits(limits.seconds, limits.memory_mb + _PYTHON_MB, limits.output)
        command = [python, "-I", "-B", "-c", code]
        try:
            return StudentProgram(command, folder, whole, self._account)
        except OSError as error:
            raise LucidaError("", f"cannot be started: {error.strerror}", "", python) from None

    def _run(self, calls: Sequence[Call], values: list[Any], end: float) -> Failure | None:
        """Append the answers to `values`. Return the reason if the run ended early."""
        assert self._program
        self._program.send(_request(calls))
        begin = answered = time.monotonic()
        try:
            for call in calls:
                values.append(self._answer(call, self._program.line(end), len(values)))
                answered = time.monotonic()
        except (ProgramOverError, *_GARBLED) as error:
            number = len(values)
            place = f"in call {number + 1} of {len(calls)}: {told_call(calls[number])}"
            reason = endless(number, answered - begin, time.monotonic() - answered)
            failure = Failure("ended", f"{self._name}: {_WROTE_BETWEEN} {place}", call=number)
            if isinstance(error, ProgramOverError):
                failure = self._over(error, place, reason, number)
            self._printed += self._program.output()
            self._end()
            return failure
        return None

    def _answer(self, call: Call, line: bytes, number: int) -> Any:
        if line[:1] == b"a":
            return json.loads(line[1:], parse_int=whole_number)
        return self._failure(json.loads(line[1:]), call, number)

    def _end(self) -> None:
        with self._change:
            program, self._program = self._program, None
        if program and not program.close():
            self.survived = True

    def _failure(
        self, told: dict[str, Any], call: Call | None, number: int | None = None
    ) -> Failure:
        """Return the failure for an exception or an invalid answer that the process reported."""
        kind: Any = str(told["kind"])  # a Kind
        text, where = one_line(told["text"]), one_line(told["where"]) or self._name
        called = f"; called as {told_call(call)}" if call else ""
        if kind == "answer":
            assert call
            wanted = "numbers, lists, arrays, or an object with origin and direction"
            text = f"{call.function} returned {text}; wanted are {wanted}"
        elif kind == "memory":
            text = f"it needs more than the memory limit of {self.limits.memory_mb} MB ({text})"
        elif kind == "ended":
            remedy = "a function is to return" if call else _MAIN
            text = f"it ends the program ({text}); {remedy}"
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


def endless(number: int, answering_s: float, waited_s: float) -> str:
    """Explain why a time limit was too short.

    number: of answered calls; answering_s: the time they took.
    waited_s: the time spent on the next one.
    """
    if number and answering_s > waited_s:
        return f"each call takes {answering_s / number:.2g} s"
    return "is there a loop that does not end?"


def _request(calls: Sequence[Call]) -> bytes:
    """Return the request. Lists and objects are sent once, even if many calls share them."""
    places: dict[tuple[int, bool], int] = {}
    shared: list[tuple[str, Any, bool]] = []
    written = []
    for call in calls:
        arguments = []
        for name, value in call.arguments:
            if isinstance(value, dict | list | tuple):
                as_array = call.vectorised and not isinstance(value, dict)
                place = places.setdefault((id(value), as_array), len(shared))
                if place == len(shared):
                    shared.append((name, value, as_array))
                arguments.append([place])
            else:
                arguments.append(value)
        written.append((call.function, arguments))
    return json.dumps({"shared": shared, "calls": written}).encode() + b"\n"


@cache
def _own_code() -> str:
    return Path(__file__).with_name("student_process.py").read_text("utf-8")
