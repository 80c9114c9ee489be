"""A program that runs a student's code: start it, feed it, watch it, and end it with all it
started.

A supervisor, in a separate process, starts the program and outlives everything that the program
starts, on Linux even daemons. It also ends them if this process is killed. Windows has no
supervisor: there, this process ends the program's tree of processes.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import queue
import shutil
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any, Literal

from app.checking.running.captured import CapturedOutput
from app.checking.running.isolation import Plan, interpreter
from app.checking.running.memory import kill_tree, memory_of

# Runs the Python code at the start of its input, after its length. This keeps our paths out of the
# command line.
RUN_INPUT = """\
import io
file = io.FileIO(0, closefd=False)
length, source = int(file.read(8)), b""
while len(source) < length:
    source += file.read(length - len(source))
exec(compile(source, "<lucida>", "exec"), {"__name__": "__main__", "__file__": "<lucida>"})
"""
_WAIT = 0.1  # seconds at most between checks of the program
_LOOK = 0.2 if sys.platform == "linux" else 1.0  # seconds between checks of its memory
_GATHER = 0.002  # seconds between reads, to read many answers at once
_CHASE = 15.0  # seconds at most to end processes that keep starting others
_ENDING = 5.0  # seconds at most for a process to end after closing its pipes
_FAREWELL = 1.0  # seconds for the remaining answers and output to arrive
_MOST_ANSWERS = 1 << 28  # bytes


def as_input(source: bytes) -> bytes:
    """Return Python code in the form that RUN_INPUT reads."""
    return b"%8d" % len(source) + source


_Why = Literal["time", "memory", "ended", "stopped", "length"]


class ProgramOverError(Exception):
    """No more answers will come.

    why: time, memory, ended, stopped or length.
    status: the exit status if it ended by itself; None if it was still running but had closed its
    answers.
    """

    def __init__(
        self,
        why: _Why,
        status: int | None = None,
    ) -> None:
        super().__init__(why)
        self.why, self.status = why, status


class StudentProgram:
    """A running program. Raises OSError if it cannot be started."""

    def __init__(self, plan: Plan, output: int) -> None:
        self.mark = f"\0{os.urandom(8).hex()}\0"
        self._scratch = plan.orders.get("scratch", "")
        self._in_bubblewrap = "bubblewrap" in plan.orders
        self._ended, self._survived, self._stopped, self._closed = False, False, False, False
        self._status: int | None = None
        try:
            answers, printed = self._start(plan.orders)
        except BaseException:
            self._remove_scratch()
            raise
        self.output = CapturedOutput(printed, output, self.mark.encode())
        self._chunks: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._requests: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._pending: list[bytes] = []
        self._lines: deque[bytes] = deque()
        self._received = 0
        self._ending = threading.Lock()
        threading.Thread(target=self._read, args=(answers,), daemon=True).start()
        threading.Thread(target=self._write, args=(self._input,), daemon=True).start()

    def _start(self, orders: dict[str, Any]) -> tuple[IO[bytes], IO[bytes]]:
        """Start the program, and return the pipes of its answers and of its output."""
        if sys.platform == "win32":
            self._process = subprocess.Popen(
                orders["command"],
                cwd=orders["folder"],
                env=orders["environment"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                creationflags=subprocess.CREATE_NO_WINDOW | subprocess.CREATE_NEW_PROCESS_GROUP,
            )
            pipes = (self._process.stdin, self._process.stdout, self._process.stderr)
            self._input, answers, printed = pipes
            assert self._input and answers and printed
            return answers, printed
        (read, to), (answers_from, write), (printed_from, also) = (os.pipe() for _ in range(3))
        theirs, ours = (read, write, also), (to, answers_from, printed_from)
        try:
            self._process = subprocess.Popen(
                [interpreter() or "python3", "-I", "-S", "-B", "-c", RUN_INPUT],
                cwd="/",
                env={},
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                pass_fds=theirs,
                start_new_session=True,
            )
            control = self._process.stdin
            assert control and self._process.stdout
            source = Path(__file__).with_name("supervisor.py").read_bytes()
            control.write(as_input(source))
            control.write(json.dumps({**orders, "files": theirs}).encode() + b"\n")
            control.flush()
            said = self._process.stdout.readline().strip().decode()
            if said != "started":
                self._end_processes()
                self._process.stdout.close()
                number = int(said or errno.ECHILD)
                raise OSError(number, os.strerror(number))
        except BaseException:
            for file in ours:
                os.close(file)
            raise
        finally:
            for file in theirs:
                os.close(file)
        threading.Thread(target=self._hear_status, daemon=True).start()
        self._input = os.fdopen(to, "wb")
        return os.fdopen(answers_from, "rb"), os.fdopen(printed_from, "rb")

    def _hear_status(self) -> None:
        """Wait for the supervisor to report the program's end."""
        assert self._process.stdout
        with self._process.stdout as pipe:
            said = pipe.readline()
        if said.strip():
            status = int(said)
            self._status = 128 - status if self._in_bubblewrap and status > 128 else status

    def send(self, data: bytes | None) -> None:
        """Queue data for the program, without waiting. None ends its input."""
        self._requests.put(data)

    def lines(self, end: float, memory_mb: int) -> Iterator[bytes]:
        """Yield its answers on demand. end: in time.monotonic's seconds. Raises
        ProgramOverError.
        """
        why: _Why | None = None
        look = 0.0
        gone: float | None = None
        while True:
            while self._lines:
                yield self._lines.popleft()
            now = time.monotonic()
            if why is None:
                if self._stopped:
                    why = "stopped"
                elif now >= end:
                    why = "time"
                elif self._received > _MOST_ANSWERS:
                    why = "length"
                elif now >= look:
                    look = now + _LOOK
                    if memory_of(self._process.pid) > memory_mb << 20:
                        why = "memory"
                if why:  # answers so far count, and show how far it came
                    self.end()  # may take long
                    end = time.monotonic() + _FAREWELL
            if self._closed or (why and now >= end and self._chunks.empty()):
                raise ProgramOverError(why or "ended", None if why else self._final_status())
            try:
                chunk = self._chunks.get(timeout=max(0, min(_WAIT, end - now)))
            except queue.Empty:
                status = None if why else self._status_now()
                gone = None if status is None else gone or now
                if gone and now > gone + _FAREWELL:  # its children keep the answers' pipe open
                    raise ProgramOverError("ended", status) from None
                continue
            self._closed = not chunk
            self._received += len(chunk)
            if why and self._closed:
                self._pending.clear()  # an unfinished line
            self._split(chunk)

    def stop(self) -> None:
        """End the program, from any thread. `lines` then raises ProgramOverError."""
        self._stopped = True
        self.end()

    def end(self) -> bool:
        """Kill the program and all that it started. Return False if some of it may still be
        running.
        """
        with self._ending:
            if not self._ended:
                self._ended = True
                self._survived = not self._end_processes()
                self._requests.put(None)
                self.output.wait_for_end(_FAREWELL)
                self._remove_scratch()
            return not self._survived

    def _end_processes(self) -> bool:
        if sys.platform == "win32":
            kill_tree(self._process.pid)
            self._process.wait()
            return True
        assert self._process.stdin
        with contextlib.suppress(OSError):  # already ended
            self._process.stdin.close()
        try:
            return self._process.wait(_CHASE) == 0
        except subprocess.TimeoutExpired:
            kill_tree(self._process.pid)
            self._process.wait()
            return False

    def _remove_scratch(self) -> None:
        if self._scratch:  # the supervisor has removed it, unless it was killed
            with contextlib.suppress(RecursionError):  # folders in one another
                shutil.rmtree(self._scratch, ignore_errors=True)

    def _split(self, chunk: bytes) -> None:
        *lines, rest = chunk.split(b"\n")
        for line in lines:
            self._lines.append(b"".join([*self._pending, line]))
            self._pending = []
        if rest:
            self._pending.append(rest)
        elif not chunk and self._pending:  # a last line without a line break
            self._lines.append(b"".join(self._pending))
            self._pending = []

    def _final_status(self) -> int | None:
        """Return the exit status, once the program has ended."""
        end = time.monotonic() + _ENDING
        while (status := self._status_now()) is None and time.monotonic() < end:
            time.sleep(0.002)
        return status

    def _status_now(self) -> int | None:
        return self._process.poll() if sys.platform == "win32" else self._status

    def _read(self, pipe: IO[bytes]) -> None:
        with pipe:
            while chunk := pipe.read1(1 << 16):  # type: ignore[attr-defined]
                self._chunks.put(chunk)
                time.sleep(_GATHER)
        self._chunks.put(b"")

    def _write(self, pipe: IO[bytes]) -> None:
        with contextlib.suppress(OSError), pipe:  # it may have stopped reading
            while (data := self._requests.get()) is not None:
                pipe.write(data)
                pipe.flush()
