"""Any program as a Student: it reads each call as a line of JSON, and writes a line of JSON."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from app.checking.calls import Call, Failure, Kind, Limits, Run
from app.checking.running.account import Account
from app.checking.running.program import ProgramOverError, StudentProgram
from app.checking.running.told import told_call, told_over, whole_number
from renderer.errors import LucidaError, one_line, shortened

_FAREWELL_S = 1.0  # for a program to end after its last answer


class CommandStudent:
    """A student's program, started by a command line. Raises LucidaError.

    Each run restarts the program, writes all calls and closes its input.

    command: words and quotes as in a shell, without a shell's other features.
    account: the user that it runs as; None for this process's own.
    survived: True if something that it started may still be running.
    """

    def __init__(
        self, command: str, limits: Limits | None = None, account: Account | None = None
    ) -> None:
        self._limits, self._account = limits or Limits(), account
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
                program.end()
                output = program.output()
            finally:
                self.survived |= not program.close()
            return Run(tuple(values), output, failure)

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
        try:
            return StudentProgram(self._words, os.getcwd(), self._limits, self._account)
        except OSError as error:
            raise LucidaError("", f"cannot be started: {error.strerror}", "", self._name) from None

    def _run(
        self, program: StudentProgram, calls: Sequence[Call], values: list[Any], end: float
    ) -> Failure | None:
        """Append the answers to `values`. Return the reason if the run ended early."""
        program.send("".join(map(_line, calls)).encode(), last=True)
        try:
            for call in calls:
                line = _next_line(program, end)
                try:
                    values.append(json.loads(line, parse_int=whole_number))
                except (ValueError, RecursionError):
                    text = shortened(one_line(line.decode("utf-8", "replace")), 80)
                    told = f"answer {len(values) + 1} is no JSON: {text}"
                    remedy = f"answer to {told_call(call)}; print other things to standard error"
                    return self._failure("answer", f"{told}; {remedy}", len(values))
        except ProgramOverError as over:
            return self._over(over, calls, len(values))
        with suppress(ProgramOverError):
            _next_line(program, time.monotonic() + _FAREWELL_S)
            told = f"it answers more than the {len(calls)} calls; one line for each call"
            return self._failure("answer", told, None)
        return None

    def _over(self, over: ProgramOverError, calls: Sequence[Call], number: int) -> Failure:
        kind, text = told_over(over, self._limits, "it")
        text += f", with {number} of {len(calls)} answers"
        if kind == "time":
            text += "; does it read to the end of its input, and flush what it prints?"
        elif over.why == "ended":
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
    if os.path.isfile(word):
        return LucidaError("", "it is not executable", "name what runs it first", word)
    return LucidaError("", "there is no such program", "is it installed, and on the PATH?", word)


def _line(call: Call) -> str:
    return json.dumps({"function": call.function, **dict(call.arguments)}) + "\n"


def _next_line(program: StudentProgram, end: float) -> bytes:
    """Return the next answer that is not blank."""
    while not (line := program.line(end).removeprefix(b"\xef\xbb\xbf").strip()):
        pass
    return line
