"""A program that runs what a student wrote: started, fed, watched, and ended with all it started.

Each has a session of its own and, in its environment, a name that what it starts inherits. On Linux
whatever bears that name or holds its output is ended with it, also what has left the session;
elsewhere its session, on Windows its tree. It ends too where this process is killed: its keeper
sees to that, which waits for what this process never sends.
"""

from __future__ import annotations

import contextlib
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, Literal

from app.checking.running.captured import CapturedOutput
from app.checking.running.memory import memory_of

_NAME = "LUCIDA_STUDENT"
_WAIT = 0.1  # seconds at most that nobody looks how it is
_LOOK = (
    0.1 if sys.platform == "linux" else 1.0
)  # the same of its memory, which another program says
_GATHER = 0.002  # seconds: answers are read many at once, not each as it comes
_KEEPER = 'read -r nothing; kill -s KILL -- "-$0"'
_CHASE = 5.0  # seconds at most that processes are looked for which go on starting others
_ENDING = 5.0  # seconds at most that a process takes to end which has closed all
_FAREWELL = 1.0  # seconds that a program which closed its answers may take to end
_MOST_ANSWERS = 1 << 28  # bytes


_Why = Literal["time", "memory", "ended", "stopped", "length"]


class ProgramOverError(Exception):
    """No more answers come. why: time, memory, ended (by itself: status, or None where it still ran
    and had closed its answers), stopped, length."""

    def __init__(
        self,
        why: _Why,
        status: int | None = None,
    ) -> None:
        super().__init__(why)
        self.why, self.status = why, status


class StudentProgram:
    """Raises OSError where it cannot be started."""

    def __init__(
        self,
        command: Sequence[str] | str,
        folder: Path | None,
        environment: Mapping[str, str],
        output: int,
    ) -> None:
        name = os.urandom(16).hex()
        self.mark = f"\0{os.urandom(8).hex()}\0"
        self._bears = f"{_NAME}={name}".encode()
        flags = 0
        if sys.platform == "win32":
            flags = subprocess.CREATE_NO_WINDOW | subprocess.CREATE_NEW_PROCESS_GROUP
        self._process = subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, **environment, _NAME: name},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
            creationflags=flags,
        )
        self._keeper = _started_keeper(self._process.pid)
        pipes = (self._process.stdin, self._process.stdout, self._process.stderr)
        self._input, answers, printed = pipes
        assert self._input and answers and printed
        self._pipes = {f"pipe:[{os.fstat(pipe.fileno()).st_ino}]" for pipe in (answers, printed)}
        self.output = CapturedOutput(printed, output, self.mark.encode())
        self._chunks: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._requests: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._pending: list[bytes] = []
        self._lines: deque[bytes] = deque()
        self._received = 0
        self._ending = threading.Lock()
        self._ended, self._stopped, self._closed = False, False, False
        threading.Thread(target=self._read, args=(answers,), daemon=True).start()
        threading.Thread(target=self._write, args=(self._input,), daemon=True).start()

    def send(self, data: bytes | None) -> None:
        """Without waiting. None: the end of its input."""
        self._requests.put(data)

    def lines(self, end: float, memory_mb: int) -> Iterator[bytes]:
        """What it answers, for as long as it is asked for. end: in time.monotonic's seconds. Raises
        ProgramOverError."""
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
                if why:  # what it has answered counts, and tells how far it came
                    self.end()  # which may take long
                    end = time.monotonic() + _FAREWELL
            if self._closed or (why and now >= end and self._chunks.empty()):
                raise ProgramOverError(why or "ended", None if why else self._status())
            try:
                chunk = self._chunks.get(timeout=max(0, min(_WAIT, end - now)))
            except queue.Empty:
                status = None if why else self._status_now()
                gone = None if status is None else gone or now
                if gone and now > gone + _FAREWELL:  # what it has started holds its answers open
                    raise ProgramOverError("ended", status) from None
                continue
            self._closed = not chunk
            self._received += len(chunk)
            if why and self._closed:
                self._pending.clear()  # a line that it did not come to the end of
            self._split(chunk)

    def stop(self) -> None:
        """Ends it, from any thread: `lines` says so."""
        self._stopped = True
        self.end()

    def end(self) -> None:
        """Kills it and all that it started."""
        with self._ending:
            if not self._ended:
                self._ended = True
                if self._keeper:
                    self._keeper.kill()
                    self._keeper.communicate()
                self._kill()
                self._process.wait()
                self._requests.put(None)
                self.output.wait_for_end(_FAREWELL)

    def _split(self, chunk: bytes) -> None:
        *lines, rest = chunk.split(b"\n")
        for line in lines:
            self._lines.append(b"".join([*self._pending, line]))
            self._pending = []
        if rest:
            self._pending.append(rest)
        elif not chunk and self._pending:  # a last line without its end
            self._lines.append(b"".join(self._pending))
            self._pending = []

    def _status(self) -> int | None:
        """Its exit status, once it has ended."""
        end = time.monotonic() + _ENDING
        while (status := self._status_now()) is None and time.monotonic() < end:
            time.sleep(0.002)
        return status

    def _status_now(self) -> int | None:
        """Its number does not go to another process before it is killed: it is not waited for."""
        if sys.platform == "win32" or not hasattr(os, "waitid"):
            return self._process.poll()
        try:
            found = os.waitid(os.P_PID, self._process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG)
        except ChildProcessError:  # `end` was faster
            return self._process.returncode
        if found is None:
            return None
        return found.si_status if found.si_code == os.CLD_EXITED else -found.si_status

    def _kill(self) -> None:
        if sys.platform == "win32":
            command = ["taskkill", "/T", "/F", "/PID", str(self._process.pid)]
            with contextlib.suppress(OSError):
                subprocess.run(command, capture_output=True, check=False)
            self._process.kill()
            return
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            self._process.kill()
        if sys.platform == "linux":
            # What forks and ends, again and again, is seldom there when one looks: as long as
            # somebody holds the pipe of the output, there is one.
            end, others = time.monotonic() + _CHASE, set[str]()
            self._kill_holders()
            while self._kill_bearers(others) or not self.output.wait_for_end(0.0):
                if time.monotonic() > end:
                    break
                self._kill_holders()

    def _kill_bearers(self, others: set[str]) -> bool:
        """others: processes that were looked at, which this adds to: the next look is quick."""
        found = False
        for process in set(filter(str.isdigit, os.listdir("/proc"))) - others:
            try:
                if self._bears in Path(f"/proc/{process}/environ").read_bytes():
                    os.kill(int(process), signal.SIGKILL)
                    found = True
                else:
                    others.add(process)
            except OSError:
                others.add(process)
        return found

    def _kill_holders(self) -> None:
        """Those that have left the session and lost the name, and still hold what it answers or
        prints through. Copies of this process that are about to become a program hold it too."""
        own = Path("/proc/self/cmdline").read_bytes()
        for process in filter(str.isdigit, os.listdir("/proc")):
            with contextlib.suppress(OSError):
                files = Path(f"/proc/{process}/fd").iterdir()
                held = {os.readlink(file) for file in files}
                if held & self._pipes and Path(f"/proc/{process}/cmdline").read_bytes() != own:
                    os.kill(int(process), signal.SIGKILL)

    def _read(self, pipe: IO[bytes]) -> None:
        with pipe:
            while chunk := pipe.read1(1 << 16):  # type: ignore[attr-defined]
                self._chunks.put(chunk)
                time.sleep(_GATHER)
        self._chunks.put(b"")

    def _write(self, pipe: IO[bytes]) -> None:
        with contextlib.suppress(OSError), pipe:  # it may read no more
            while (data := self._requests.get()) is not None:
                pipe.write(data)
                pipe.flush()


def _started_keeper(process: int) -> subprocess.Popen[bytes] | None:
    if sys.platform == "win32":
        return None
    try:
        return subprocess.Popen(
            ["/bin/sh", "-c", _KEEPER, str(process)],
            cwd="/",
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
    except OSError:
        return None
