"""Any program as a Student: it reads each call as a line of JSON, and writes a line of JSON."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

from app.checking.calls import Call, Failure, Kind, Limits, Run
from app.checking.running.isolation import Access, command_plan
from app.checking.running.program import ProgramOverError, StudentProgram
from app.checking.running.told import told_call, told_over, whole_number
from renderer.errors import LucidaError, one_line, shortened

_FAREWELL = 1.0  # seconds for a program to end after its last answer


class CommandStudent:
    """A student's program, started by a command line. Raises LucidaError.

    Each run restarts the program, writes all calls and closes its input.

    command: words and quotes as in a shell, without a shell's other features.
    survived: True if something that it started may still be running.
    """

    def __init__(
        self, command: str, limits: Limits | None = None, access: Access | None = None
    ) -> None:
        self._limits, self._access = limits or Limits(), access or Access()
        self._words = _words(command)
        self._name = os.path.basename(self._words[0])
        self.survived = False
        self._turn = threading.Lock()
        self._change = threading.Lock()
        self._program: StudentProgram | None = None
        self._closed = False

    def functions(self) -> None:
        """Return None, because the functions are not known. Raises LucidaError if there is no such
        program.
        """
        if shutil.which(self._words[0]) is None:
            raise _not_found(self._words[0])

    def call(self, calls: Sequence[Call]) -> Run:
        with self._turn:
            end = time.monotonic() + self._limits.seconds
            try:
                self.functions()
                with self._change:
                    program = self._program = self._started()
            except LucidaError as error:
                return Run((), "", Failure("missing", str(error)))
            values: list[Any] = []
            try:
                failure = self._run(program, calls, values, end)
            finally:
                if not program.end():
                    self.survived = True
            return Run(tuple(values), program.output.take(), failure)

    def stop(self) -> None:
        with self._change:
            program = self._program
        if program:
            program.stop()

    def close(self) -> None:
        self._closed = True
        self.stop()

    def _started(self) -> StudentProgram:
        if self._closed:
            raise LucidaError("", "it is closed", source=self._name)
        limits = self._limits
        try:
            plan = command_plan(self._words, self._access, limits)
            return StudentProgram(plan, limits.output)
        except FileNotFoundError:
            # Also raised if the interpreter in the file's first line is missing.
            raise _not_found(self._words[0]) from None
        except PermissionError:
            remedy = "make it executable, or name what runs it first"
            raise LucidaError("", "it is not executable", remedy, self._name) from None
        except OSError as error:
            reason = error.strerror or str(error)
            remedy = "name what runs it first: sh, python, node"
            raise LucidaError("", f"it cannot be started: {reason}", remedy, self._name) from None

    def _run(
        self, program: StudentProgram, calls: Sequence[Call], values: list[Any], end: float
    ) -> Failure | None:
        """Append the answers to `values`. Return the reason if the run ended early."""
        program.send("".join(map(_line, calls)).encode())
        program.send(None)
        lines = _numbered(program.lines(end, self._limits.memory_mb))
        try:
            for call in calls:
                number, line = next(lines)
                try:
                    values.append(json.loads(line, parse_int=whole_number))
                except (ValueError, RecursionError):
                    text = shortened(one_line(line.decode("utf-8", "replace")), 80)
                    told = f"line {number} of what it answers is no JSON: {text}"
                    remedy = f"answer to {told_call(call)}; print other things to standard error"
                    return self._failure("answer", f"{told}; {remedy}", len(values))
        except ProgramOverError as over:
            return self._over(over, calls, len(values))
        with suppress(ProgramOverError):
            for number, _ in _numbered(program.lines(time.monotonic() + _FAREWELL, 1 << 40)):
                told = f"it answers more than the {len(calls)} calls (line {number} after them)"
                return self._failure("answer", f"{told}; one line for each call", None)
        return None

    def _over(self, over: ProgramOverError, calls: Sequence[Call], number: int) -> Failure:
        kind, text = told_over(over, self._limits, "it ", "it ")
        text += f", with {number} of {len(calls)} answers"
        if kind == "time":
            text += "; does it read to the end of its input, and flush what it prints?"
        elif kind == "ended":
            text += f"; the next was {told_call(calls[number])}"
        return self._failure(kind, text, number)

    def _failure(self, kind: Kind, text: str, number: int | None) -> Failure:
        return Failure(kind, f"{self._name}: {text}", call=number)


def _words(command: str) -> list[str]:
    try:
        words = shlex.split(command, posix=sys.platform != "win32")
    except ValueError as error:
        raise LucidaError("--command", f"{command!r}: {error}", "close the quotes") from None
    if not words or not words[0].strip("\"'"):
        raise LucidaError("--command", "is empty", 'name a program: --command "julia rays.jl"')
    if "\0" in command:
        raise LucidaError("--command", "has a zero byte")
    return [words[0].strip("\"'"), *words[1:]] if sys.platform == "win32" else words


def _not_found(word: str) -> LucidaError:
    there = os.path.isfile(word)
    if there and not os.access(word, os.X_OK):
        return LucidaError("", "it is not executable", "name what runs it first", word)
    if there:
        return LucidaError("", "what runs it is not there", "see its first line, #!...", word)
    return LucidaError("", "there is no such program", "is it installed, and on the PATH?", word)


def _line(call: Call) -> str:
    return json.dumps({"function": call.function, **dict(call.arguments)}) + "\n"


def _numbered(lines: Iterator[bytes]) -> Iterator[tuple[int, bytes]]:
    """Yield the lines that are not blank, with their numbers from 1."""
    for number, line in enumerate(lines, 1):
        text = line.removeprefix(b"\xef\xbb\xbf").strip()
        if text:
            yield number, text
