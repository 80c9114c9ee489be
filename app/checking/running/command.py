"""Any program as a Student: it reads each call as a line of JSON, and writes a line of JSON."""

from __future__ import annotations

import json
import os
import shlex
import sys
import time
from collections.abc import Sequence
from typing import Any

from lucida.app.checking.tasks import Call, Failure, Limits, Run
from lucida.renderer.system.errors import LucidaError, one_line, shortened

from .account import Account
from .program import ProgramOverError, ProgramStudent, StudentProgram, told_call, whole_number


class CommandStudent(ProgramStudent):
    """A student's program, started by a command line. Raises LucidaError.

    Each run restarts the program, writes all calls and closes its input.

    command: words and quotes as in a shell, without its other features.
    """

    def __init__(
        self, command: str, limits: Limits | None = None, account: Account | None = None
    ) -> None:
        self._words = _words(command)
        super().__init__(os.path.basename(self._words[0]), limits, account)

    def functions(self) -> None:
        """Return None, because the functions are not known."""

    def call(self, calls: Sequence[Call]) -> Run:
        with self._turn:
            end = time.monotonic() + self.limits.seconds
            if self._closed:
                return Run((), "", Failure("ended", f"{self._name}: it is closed"))
            try:
                program = self._begin(self._words, os.getcwd(), self.limits)
            except LucidaError as error:
                return Run((), "", Failure("missing", str(error)))
            values: list[Any] = []
            failure = self._run(program, calls, values, end)
            program.end()
            printed = program.output()
            self._end()
            return Run(tuple(values), printed, failure)

    def _run(
        self, program: StudentProgram, calls: Sequence[Call], values: list[Any], end: float
    ) -> Failure | None:
        """Append the answers to `values`. Return the reason if the run ended early."""
        program.send("".join(map(_line, calls)).encode(), last=True)
        line = b""
        try:
            while len(values) < len(calls):
                if line := program.line(end).strip():
                    values.append(json.loads(line, parse_int=whole_number))
        except ProgramOverError as over:
            text = f"{self._name}: {over.text}, with {len(values)} of {len(calls)} answers"
            if over.kind == "time":
                text += "; does it read to the end of its input, and flush what it prints?"
            return Failure(over.kind, text, call=len(values))
        except (ValueError, RecursionError):
            told = shortened(one_line(line.decode("utf-8", "replace")), 80)
            told = f"{self._name}: answer {len(values) + 1} is no JSON: {told}"
            remedy = (
                f"answer to {told_call(calls[len(values)])}; print other things to standard error"
            )
            return Failure("answer", f"{told}; {remedy}", call=len(values))
        return None


def _words(command: str) -> list[str]:
    try:
        words = shlex.split(command, posix=sys.platform != "win32")
    except ValueError as error:
        raise LucidaError("--command", f"{command!r}: {error}", "close the quotes") from None
    words[:1] = [word.strip("\"'") for word in words[:1]]
    if not words or not words[0] or "\0" in command:
        remedy = 'name a program: --command "julia rays.jl"'
        raise LucidaError("--command", f"{command!r} is no command", remedy)
    return words


def _line(call: Call) -> str:
    return json.dumps({"function": call.function, **dict(call.arguments)}) + "\n"
