"""A student's program: one child process, whose answers are lines of text, read here as data."""

from __future__ import annotations

import contextlib
import os
import queue
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from pathlib import Path

from lucida.app.checking.kinds.kind import text_of
from lucida.app.checking.tasks import Call, Kind, Limits, Run
from lucida.app.ui.explaining.symbols import arguments
from lucida.renderer.system.errors import LucidaError, one_line, shortened

from .account import Account

_MOST_ANSWERS = 1 << 28  # bytes of one request's answers
_LARGEST_FILE = 1 << 26  # bytes; its printed text is a file, too
_MOST_PROCESSES = 256  # of a user of its own
_ENDING_S = 1.0  # for a program to end once it has closed its answers
# Libraries' threads only cost time in such small calls. No window may open.
_ENVIRONMENT = {
    **dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1"),
    "MALLOC_ARENA_MAX": "2",
    "MPLBACKEND": "Agg",
}

DISHONEST = (
    "The program has your rights: a dishonest one could read the right answers, change its "
    "results, end this check or leave processes behind. "
    "Run strangers' programs in a container, or as root with --as USER."
)


class ProgramOverError(Exception):
    """No more answers will follow. kind, text: see Failure; the text follows the program's name."""

    def __init__(self, kind: Kind, text: str) -> None:
        super().__init__(text)
        self.kind, self.text = kind, text


class StudentProgram:
    """A running program, in a process group of its own. Raises OSError if it cannot be started.

    Exit status 126 or 127 means that there is no such program, or that it is not executable.

    folder: its working directory.
    account: the user that it runs as; None for this process's own.
    stopped: True after stop().
    """

    def __init__(
        self, command: Sequence[str], folder: Path | str, limits: Limits, account: Account | None
    ) -> None:
        self._limits, self._account = limits, account
        self.stopped = self._too_long = self._ended = self._survived = False
        self._received = self._told = 0
        self._ending = threading.Lock()
        kept = dict(os.environ)
        if account is not None:
            kept = {name: kept[name] for name in ("PATH", "LANG") if name in kept}
        with tempfile.TemporaryDirectory(prefix="lucida-") as scratch:
            path = Path(scratch) / "printed"
            with path.open("wb") as printed:
                self._process = subprocess.Popen(
                    _limited(command, limits, account is not None),
                    cwd=folder,
                    env=kept | _ENVIRONMENT,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=printed,
                    start_new_session=True,
                    creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
                    **(account.options if account is not None else {}),
                )
            self._printed = path.open("rb")
        self._lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._requests: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        threading.Thread(target=self._read, daemon=True).start()
        threading.Thread(target=self._write, daemon=True).start()

    def send(self, data: bytes, last: bool = False) -> None:
        """Queue data for the program, without waiting. last: close its input afterwards."""
        self._received = 0
        self._requests.put(data)
        if last:
            self._requests.put(None)

    def line(self, end_s: float) -> bytes:
        """Wait for the next answer until time.monotonic() is end_s. Raises ProgramOverError."""
        try:
            line = self._lines.get(timeout=max(0.0, end_s - time.monotonic()))
        except queue.Empty:
            self.end()
            text = f"the time limit of {self._limits.seconds:g} s is over"
            raise ProgramOverError("time", text) from None
        if line:
            return line.rstrip(b"\r\n")
        self._lines.put(line)  # for the next call
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(_ENDING_S)
        how = _told_status(self._process.poll())
        self.end()
        if self.stopped or self._too_long:
            how = "was stopped" if self.stopped else "answered too much"
        raise ProgramOverError("ended", f"it {how}")

    def output(self) -> str:
        """Return the text printed since the last call, or the end of a long one."""
        if self._printed.closed:
            return ""
        size, begin = os.fstat(self._printed.fileno()).st_size, self._told
        self._told, left_out = size, max(0, size - begin - self._limits.output)
        self._printed.seek(begin + left_out)
        text = self._printed.read(size - begin - left_out).decode("utf-8", "replace")
        return f"... {left_out:,} bytes left out ...\n{text}" if left_out else text

    def stop(self) -> None:
        """End the program, from any thread. `line` then raises ProgramOverError."""
        self.stopped = True
        self.end()

    def end(self) -> bool:
        """Kill the program with its process group, and all processes of its own user.

        Return False if some of that user's are still running.
        """
        with self._ending:
            if not self._ended:
                self._ended = True
                if sys.platform == "win32":
                    self._process.kill()
                else:
                    with contextlib.suppress(OSError):  # all processes have ended
                        os.killpg(self._process.pid, signal.SIGKILL)
                self._survived = self._account is not None and not self._account.kill()
                self._process.wait()
                self._requests.put(None)
            return not self._survived

    def close(self) -> bool:
        """End the program, and discard its output. Return end()'s result."""
        has_ended = self.end()
        self._printed.close()
        return has_ended

    def _read(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as pipe:
            while line := pipe.readline(_MOST_ANSWERS):
                self._received += len(line)
                if self._received > _MOST_ANSWERS:
                    self._too_long = True
                    break
                self._lines.put(line)
        self._lines.put(b"")

    def _write(self) -> None:
        assert self._process.stdin is not None
        with contextlib.suppress(OSError), self._process.stdin as pipe:  # it may have ended
            while (data := self._requests.get()) is not None:
                pipe.write(data)
                pipe.flush()


class ProgramStudent:
    """Base class of students whose answers come from a program, one at a time.

    limits: the limits of each run.
    account: the user that the program runs as; None for this process's own.
    survived: True if something that it started may still be running.
    """

    def __init__(self, name: str, limits: Limits | None, account: Account | None) -> None:
        self._name, self.limits, self._account = name, limits or Limits(), account
        self.survived = self._closed = False
        self._turn = threading.Lock()  # allows one run at a time
        self._change = threading.Lock()
        self._program: StudentProgram | None = None

    def functions(self) -> frozenset[str] | None:
        """Return the names of its functions; None if they cannot be known. Raises LucidaError if it
        cannot be run at all.
        """
        raise NotImplementedError

    def call(self, calls: Sequence[Call]) -> Run:
        """Run all calls in order, and block until they are done. It may be called again; the time
        limit applies to each run.
        """
        raise NotImplementedError

    def stop(self) -> None:
        """Stop the current run, from any thread: `call` returns soon, with a failure."""
        with self._change:
            program = self._program
        if program:
            program.stop()

    def close(self) -> None:
        """End its process, and everything that it started."""
        self._closed = True
        self.stop()
        with self._turn:
            self._end()

    def _begin(self, command: Sequence[str], folder: str, limits: Limits) -> StudentProgram:
        """Start the program. Raises LucidaError."""
        if shutil.which(command[0]) is None:
            remedy = "is it installed, executable, and on the PATH?"
            raise LucidaError("", "there is no such program", remedy, command[0])
        with self._change:
            try:
                self._program = StudentProgram(command, folder, limits, self._account)
            except OSError as error:
                problem = f"cannot be started: {error.strerror}"
                raise LucidaError("", problem, "", command[0]) from None
            return self._program

    def _end(self) -> None:
        with self._change:
            program, self._program = self._program, None
        if program:
            self.survived |= not program.close()


def _limited(command: Sequence[str], limits: Limits, has_account: bool) -> Sequence[str]:
    """Wrap the command in a shell that limits it and its child processes."""
    if sys.platform == "win32":
        return command
    orders = [
        "ulimit -c 0",
        f"ulimit -f {_LARGEST_FILE >> 9}",  # blocks of 512 bytes
        f"ulimit -d {limits.memory_mb << 10}",  # KiB; ignores reserved memory, as of Node.js
    ]
    if has_account:  # otherwise, all processes of this process's user would count
        orders.append(f"ulimit -u {_MOST_PROCESSES} || ulimit -p {_MOST_PROCESSES}")  # bash, dash
    script = "".join(f"{{ {order}; }} 2>/dev/null; " for order in orders)
    return ["/bin/sh", "-c", f'{script}exec "$@"', "sh", *command]


def told_call(call: Call, longest: int = 80) -> str:
    """Return the call in one line: viewing_ray(i=3, j=4, camera={eye: (0, 0, 5), ...}).

    longest: the number of characters of a value.
    """
    given = (
        f"{name}={shortened(arguments(text_of(value), call.notation), longest)}"
        for name, value in ((arguments(n, call.notation), v) for n, v in call.arguments)
    )
    return one_line(f"{call.function}({', '.join(given)})")


def _told_status(status: int | None) -> str:
    """Describe the end of a program from its exit status; -9 means signal 9."""
    if status is None:
        return "closed what it answers through"
    if status >= 0:
        return f"ended with exit status {status}"
    return f"was ended by signal {-status} ({signal.strsignal(-status)})"


def whole_number(text: str) -> int | float:
    """Parse an integer of an answer. Integers of 18 or more characters become floats."""
    return int(text) if len(text) < 18 else float(text)
