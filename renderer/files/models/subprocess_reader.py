"""Read large models in a process of their own, which can be killed, and holds no lock.

Reading a text of 100 MB in this process would stop its other threads, such as a window's loop, for
seconds at a time: searching and splitting a text holds Python's lock.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import threading
from pathlib import Path

from lucida.renderer.files.models.models import ModelFile, read_model
from lucida.renderer.system.child import end_child, end_with_parent, interpreter, start_child
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.file_dependencies import note, note_all, noting
from lucida.renderer.system.pipe import read_value, write_value

# From here on a process, which takes some 0.3 s to start, costs less than it brings: text holds the
# lock for some 15 ms a MiB, a frame of a window.
LARGE_BYTES = 1 << 20


class CancelledError(Exception):
    """Nobody is waiting for the model any more."""


class ModelReader:
    """Reads models, the large ones in a process of their own. For one thread; cancel() is for any
    other.

    If no process can be started (a program that is not Python's interpreter, no resources), models
    are read in this one.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.process: subprocess.Popen[bytes] | None = None
        self._cancelled = False

    def read(self, path: Path) -> ModelFile:
        """Return read_model(). Raises CancelledError after cancel() was called, or LucidaError."""
        note(path)
        python = interpreter() if is_large(path) else None
        process = self._start(python, path) if python is not None else None
        model = read_model(path) if process is None else self._receive(process, path)
        self.check()
        return model

    def cancel(self) -> None:
        """Kill the process that reads, if there is one. A model that is read in this process is
        read to its end. Nothing can be read afterwards.
        """
        with self._lock:
            self._cancelled = True
            if self.process is not None:
                self.process.kill()

    def check(self) -> None:
        """Raise CancelledError after cancel() was called."""
        if self._cancelled:
            raise CancelledError

    def _start(self, python: str, path: Path) -> subprocess.Popen[bytes] | None:
        with self._lock:
            self.check()
            with contextlib.suppress(OSError):
                self.process = start_child(python, __name__, str(path), output=True)
            return self.process

    def _receive(self, process: subprocess.Popen[bytes], path: Path) -> ModelFile:
        """Return what the process found, or raise its exception."""
        assert process.stdout is not None
        answer = None
        try:
            answer, noted = read_value(process.stdout)
            note_all(noted)
        except (EOFError, MemoryError):
            pass
        finally:
            with self._lock:
                self.process = None
            status = end_child(process)
        self.check()
        if isinstance(answer, Exception):
            raise answer
        if answer is None:
            raise LucidaError(
                "",
                f"was given up: the process that read it ended ({status})",
                "give a smaller model, or close other programs: memory may have run out",
                str(path),
            )
        model: ModelFile = answer
        return model


def is_large(path: Path) -> bool:
    """Return True if reading a model takes long. False if it is no file, which is reported
    elsewhere.
    """
    try:
        size_bytes = path.stat().st_size
        if path.suffix.lower() == ".gltf":  # its numbers are in files next to it
            size_bytes += sum(file.stat().st_size for file in path.parent.glob("*.bin"))
        return path.is_file() and size_bytes >= LARGE_BYTES
    except (OSError, ValueError):
        return False


def main(path: str) -> None:
    """Run the process: answer with the model, or with the exception, and the files it looked
    for.
    """
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints is no part of the answer
    end_with_parent()
    with contextlib.suppress(OSError):  # Linux ends this process first if memory runs out
        Path("/proc/self/oom_score_adj").write_text("1000")
    answer: ModelFile | Exception
    with noting() as noted:
        try:
            answer = read_model(Path(path))
        except LucidaError as error:
            answer = error
        except Exception as error:  # a bug, which the other process reports
            answer = RuntimeError(f"{type(error).__name__}: {error}")
    write_value(answers, (answer, noted))
    os._exit(0)  # its memory goes back at once
