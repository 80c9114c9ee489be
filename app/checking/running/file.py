"""A student's Python file as a Student: it runs in a separate process."""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any, Self

from app.checking.calls import Call, Failure, Limits, Run
from app.checking.running.isolation import Access, python_plan
from app.checking.running.program import RUN_INPUT, ProgramOverError, StudentProgram, as_input
from app.checking.running.told import told_call, told_over, whole_number
from renderer.errors import LucidaError, one_line
from renderer.scene.reading import close_matches

_LONGEST_FILE = 4 << 20  # bytes
_PYTHON_MB = 96  # memory of Python and its libraries, on top of the student's limit
_MEMORY_STATUS = 86  # exit status: no memory left to report that
_MOST_NAMES, _LONGEST_NAME = 10_000, 100
_MOST_LINES, _LONGEST_LINE = 64, 2_000  # in its report of a failure
_OURS = ("student_values", "student_process")
_START = """\
import sys
at_start = frozenset(sys.modules)
import os, types
for name, source in {sources!r}:
    module = sys.modules[name] = types.ModuleType(name)
    module.__file__ = "<lucida>"
    exec(compile(source, "<lucida>", "exec"), module.__dict__)
try:
    module.main(at_start)
except MemoryError:
    os._exit({memory_status})
"""
_MAIN = 'put what runs on its own under `if __name__ == "__main__":`'
# Errors from answers that our process did not write.
_GARBLED = (ValueError, LookupError, TypeError, RecursionError)
_WROTE_BETWEEN = "it wrote into a file of ours: one that it has not opened itself"
# Single-threaded libraries: for such small calls, threads only cost time. And no window.
_ENVIRONMENT = {
    **dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1"),
    "MALLOC_ARENA_MAX": "2",
    "MPLBACKEND": "Agg",
}


class NotRunnableError(LucidaError):
    """A file that answers no calls. output: its output up to that point."""

    def __init__(self, failure: Failure, output: str) -> None:
        super().__init__("", failure.text)
        self.failure, self.output = failure, output


class FileStudent:
    """A student's Python file, read once, on first use.

    One process serves all calls until one of them ends it; the next run then starts another. Call
    close(): nothing else ends the process while this one lives.

    survived: True if something that it started may still be running.
    """

    def __init__(
        self, path: Path | str, limits: Limits | None = None, access: Access | None = None
    ) -> None:
        self._path, self.limits = Path(path), limits or Limits()
        self._access = access or Access()
        self.survived = False
        self._name = one_line(self._path.name)
        self._turn = threading.Lock()  # allows one run at a time
        self._change = threading.Lock()
        self._program: StudentProgram | None = None
        self._lines: Iterator[bytes] = iter(())
        self._runs = 0
        self._functions: dict[str, list[str]] = {}
        self.files: tuple[str, ...] = ()  # its own imported modules
        self._failed: Failure | None = None  # permanent
        self._closed = threading.Event()
        self._printed = ""
        self._values: list[Any] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def functions(self) -> frozenset[str]:
        """Return the names of all callables in the file. Raises NotRunnableError."""
        with self._turn:
            try:
                failure = self._start(time.monotonic() + self.limits.seconds)
            except BaseException:  # Ctrl-C
                self._end()
                raise
            if failure:
                raise NotRunnableError(failure, self._printed)
            return frozenset(self._functions["functions"])

    @property
    def answered(self) -> int:
        """The number of answered calls in the current or last run. Safe to read from any thread."""
        return len(self._values)

    def call(self, calls: Sequence[Call]) -> Run:
        with self._turn:
            end = time.monotonic() + self.limits.seconds
            values = self._values = []
            try:
                failure = self._start(end)
                if failure is None and calls:
                    failure = self._run(calls, values, end)
            except BaseException:  # Ctrl-C
                self._end()
                raise
            return Run(tuple(values), self._taken_output(), failure)

    def stop(self) -> None:
        with self._change:
            program = self._program
        if program:
            program.stop()

    def close(self) -> None:
        self._closed.set()
        self.stop()
        with self._turn:
            self._end()

    def _start(self, end: float) -> Failure | None:
        """Start a process that runs the file, unless there is one. Return the failure, if any."""
        closed = Failure("ended", f"{self._name}: it is closed")
        if self._closed.is_set() or self._failed:
            return self._failed or closed
        if self._program:
            return None
        try:
            source = self._source()
            with self._change:
                if self._closed.is_set():
                    return closed
                self._program, libraries = self._started()
        except LucidaError as error:
            self._failed = Failure("missing", str(error))
            return self._failed
        self._runs = 0
        opening = {
            "path": os.path.realpath(self._path),
            "source": source.decode("latin-1"),
            "libraries": libraries,
            "memory_mb": self.limits.memory_mb,
            "mark": self._program.mark,
        }
        self._program.send(_own_code())
        self._program.send(json.dumps(opening).encode() + b"\n")
        self._lines = self._program.lines(end, self.limits.memory_mb + _PYTHON_MB)
        try:
            line = next(self._lines)
        except ProgramOverError as over:
            return self._import_failed(self._over(over, "while the file is imported", _MAIN), over)
        self._runs = 1
        try:
            told = json.loads(line[1:])
            self.files = tuple(path for path in told["files"] if "\0" not in path)
            if line[:1] == b"f":
                return self._import_failed(self._failure(told, None))
            self._functions = {kind: _names(told[kind]) for kind in ("functions", "own")}
        except _GARBLED:
            return self._import_failed(Failure("ended", f"{self._name}: {_WROTE_BETWEEN}"))
        return None

    def _import_failed(self, failure: Failure, over: ProgramOverError | None = None) -> Failure:
        self._printed = self._taken_output()
        self._end()
        if not over or over.why != "stopped":
            self._failed = failure
        return failure

    def _source(self) -> bytes:
        try:
            if self._path.is_dir():
                raise LucidaError("", "it is a folder", "give a .py file", self._name)
            if self._path.exists() and not self._path.is_file():
                raise LucidaError("", "it is no file", "give a .py file", self._name)
            with self._path.open("rb") as file:
                source = file.read(_LONGEST_FILE + 1)
        except FileNotFoundError:
            raise LucidaError("", "there is no such file", source=str(self._path)) from None
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise LucidaError("", f"cannot be read: {reason}", source=str(self._path)) from None
        if len(source) > _LONGEST_FILE:
            raise LucidaError("", "it is longer than 4 MB, too long for code", source=self._name)
        return source

    def _started(self) -> tuple[StudentProgram, list[str]]:
        folder, limits = os.path.dirname(os.path.realpath(self._path)), self.limits
        plan = python_plan(RUN_INPUT, folder, _ENVIRONMENT, self._access, limits)
        try:
            return StudentProgram(plan, limits.output), plan.libraries
        except OSError as error:
            problem, python = f"cannot be started: {error.strerror}", plan.orders["command"][0]
            who = self._access.user
            remedy = f"install Python where {who} can read it, or bubblewrap" if who else ""
            raise LucidaError("", problem, remedy, python) from None

    def _run(self, calls: Sequence[Call], values: list[Any], end: float) -> Failure | None:
        """Append the answers to `values`. Return the reason if the run ended early."""
        assert self._program
        self._program.send(_request(calls))
        self._lines = self._program.lines(end, self.limits.memory_mb + _PYTHON_MB)
        begin = answered = time.monotonic()
        try:
            for call, line in zip(calls, self._lines, strict=False):
                values.append(self._answer(call, line, len(values)))
                answered = time.monotonic()
        except (ProgramOverError, *_GARBLED) as error:
            number = len(values)
            place = f"in call {number + 1} of {len(calls)}: {told_call(calls[number])}"
            if isinstance(error, ProgramOverError):
                waited = time.monotonic() - answered
                failure = self._over(
                    error, place, endless(number, answered - begin, waited), number
                )
            else:
                failure = Failure("ended", f"{self._name}: {_WROTE_BETWEEN} {place}", call=number)
            self._printed = self._taken_output()
            self._end()
            return failure
        self._runs += 1
        return None

    def _answer(self, call: Call, line: bytes, number: int) -> Any:
        kind, text = line[:1], line[1:]
        if kind == b"a":
            return json.loads(text, parse_int=whole_number)
        if kind == b"m":
            return Failure("missing", self._lacks(call), call=number)
        return self._failure(json.loads(text), call, number)

    def _taken_output(self) -> str:
        if not self._program:
            printed, self._printed = self._printed, self._printed if self._failed else ""
            return printed
        self._program.output.wait(self._runs, 1.0)
        return self._program.output.take()

    def _end(self) -> None:
        with self._change:
            program, self._program = self._program, None
        if program and not program.end():
            self.survived = True

    def _lacks(self, call: Call) -> str:
        own = self._functions["own"]
        if not own:
            return f"{self._name} has no function {call.function}; it has none"
        has = ", ".join(own[:8]) + (", ..." if len(own) > 8 else "")
        near = close_matches(call.function, own)
        meant = f"; did you mean {near[0]}?" if near else ""
        return f"{self._name} has no function {call.function}; it has: {has}{meant}"

    def _failure(
        self, told: dict[str, Any], call: Call | None, number: int | None = None
    ) -> Failure:
        """Return the failure for an exception or an invalid answer that the process reported."""
        kind: Any  # a Kind
        kind, text, where = _texts([told[part] for part in ("kind", "text", "where")])
        lines, where = _texts(told["lines"]), where or self._name
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
        return Failure(kind, f"{where}: {text}{called}", tuple(lines), number)

    def _over(
        self, over: ProgramOverError, place: str, endless: str, number: int | None = None
    ) -> Failure:
        """Return the failure for the end of the process."""
        if over.why == "ended" and over.status == _MEMORY_STATUS:
            over = ProgramOverError("memory")
        kind, text = told_over(over, self.limits, "", "its process ")
        reason = f"; {endless}" if kind == "time" else ""
        return Failure(kind, f"{self._name}: {text} {place}{reason}", call=number)


def _names(told: list[Any]) -> list[str]:
    """Return names of functions. A program that answers in our process' stead may tell anything."""
    return [name for name in _texts(told, _MOST_NAMES) if len(name) <= _LONGEST_NAME]


def _texts(told: list[Any], most: int = _MOST_LINES) -> list[str]:
    if not all(isinstance(text, str) for text in told):
        raise TypeError
    return [text[:_LONGEST_LINE] for text in told[:most]]


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
def _own_code() -> bytes:
    """Return our code for the student's process, in the form that RUN_INPUT reads."""
    sources = [
        (f"app.checking.running.{name}", Path(__file__).with_name(f"{name}.py").read_text("utf-8"))
        for name in _OURS
    ]
    return as_input(_START.format(sources=sources, memory_status=_MEMORY_STATUS).encode())
