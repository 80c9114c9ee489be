"""Work in a process of its own, with a time limit. Needs fork."""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import select
import signal
import sys
import time
from collections.abc import Callable
from typing import Any


def forked(work: Callable[[], Any], limit_s: float) -> Any:
    """Return a function's result from a process of its own, through JSON.

    Return None if it fails or takes longer. Processes that it started end with it.
    """
    reading, writing = os.pipe()
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        told = os.dup(2)  # work may close its own
        try:
            os.setpgid(0, 0)
            _end_with_parent()
            os.close(reading)
            answer = json.dumps(work()).encode()
            with os.fdopen(writing, "wb") as pipe:
                pipe.write(answer)
            os._exit(0)
        except BaseException as error:
            os.write(told, f"{type(error).__name__}: {error}\n".encode())
            os._exit(1)
    os.close(writing)
    data = _read(reading, time.monotonic() + limit_s)
    for end in (os.killpg, os.kill):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            end(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return json.loads(data) if data else None


def _end_with_parent() -> None:
    """This process ends when the one that started it does, however that ends. On Linux; elsewhere
    it goes on to its own end."""
    with contextlib.suppress(OSError, AttributeError, TypeError):
        ctypes.CDLL(None).prctl(1, int(signal.SIGKILL))  # PR_SET_PDEATHSIG


def _read(reading: int, end_s: float) -> bytes:
    """All until the other end is closed; nothing where that takes longer."""
    data = b""
    with os.fdopen(reading, "rb", buffering=0) as pipe:
        while True:
            if not select.select([pipe], [], [], max(0.0, end_s - time.monotonic()))[0]:
                return b""
            if not (part := pipe.read(1 << 16)):
                return data
            data += part
