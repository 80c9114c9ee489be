"""The output of a program, read as it arrives so that the program never blocks, and shortened."""

from __future__ import annotations

import threading
from typing import IO


class CapturedOutput:
    """A thread that reads a pipe to its end, and then closes it.

    most: the number of characters to keep, from the beginning and from the end.
    mark: a text that the program prints, if it can, at the end of a run's output; never shown.
    """

    def __init__(self, pipe: IO[bytes], most: int, mark: bytes) -> None:
        self._pipe, self._most, self._mark = pipe, most, mark
        self._changed = threading.Condition()
        self._first, self._last, self._left_out = bytearray(), bytearray(), 0
        self._before = b""  # a mark may be split between two reads
        self._marks, self._ended = 0, False
        threading.Thread(target=self._read, daemon=True).start()

    def wait(self, marks: int, seconds: float) -> None:
        """Wait until this many marks have arrived in total, or until the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._ended or self._marks >= marks, seconds)

    def wait_for_end(self, seconds: float) -> bool:
        """Return True once nobody can write any more: all processes that had the pipe have
        ended.
        """
        with self._changed:
            return self._changed.wait_for(lambda: self._ended, seconds)

    def take(self) -> str:
        """Return the output since the last call."""
        with self._changed:
            first, last, left_out = bytes(self._first), bytes(self._last), self._left_out
            self._first, self._last, self._left_out = bytearray(), bytearray(), 0
        half, about = self._most // 2, "about "
        parts = [first, last] if left_out else [first + last]
        texts = [part.replace(self._mark, b"").decode("utf-8", "replace") for part in parts]
        if not left_out:
            if len(texts[0]) <= self._most:
                return texts[0]
            left_out, about = len(texts[0]) - 2 * half, ""
        left = f"... {about}{left_out:,} characters left out ..."
        return f"{texts[0][:half]}\n{left}\n{texts[-1][-half:]}"

    def _read(self) -> None:
        bound = 4 * self._most + len(self._mark)  # in bytes, up to four per character
        with self._pipe:
            while chunk := self._pipe.read1(1 << 16):  # type: ignore[attr-defined]
                with self._changed:
                    room = max(bound - len(self._first), 0)
                    self._first += chunk[:room]
                    self._last += chunk[room:]
                    if len(self._last) > 2 * bound:
                        self._left_out += len(self._last) - bound
                        del self._last[:-bound]
                    seen = self._before + chunk
                    self._marks += seen.count(self._mark)
                    self._before = seen[1 - len(self._mark) :]
                    self._changed.notify_all()
        with self._changed:
            self._ended = True
            self._changed.notify_all()
