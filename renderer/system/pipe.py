"""Send values with large arrays through a pipe between two processes of this program.

A short pickle holds everything but the arrays; their bytes follow it. Use this only for streams of
this program: unpickling runs whatever code the sender chose.
"""

from __future__ import annotations

import pickle
from typing import IO, Any

_LENGTH_BYTES = 8


def write_value(file: IO[bytes], value: Any) -> None:
    """Write a value. An array that is in it several times is sent once, and arrives as one."""
    arrays: list[memoryview] = []
    body = pickle.dumps(value, 5, buffer_callback=lambda array: arrays.append(array.raw()))
    head = pickle.dumps((body, [array.nbytes for array in arrays]))
    file.write(len(head).to_bytes(_LENGTH_BYTES, "little") + head)
    for array in arrays:
        file.write(array)
    file.flush()


def read_value(file: IO[bytes]) -> Any:
    """Return the next value, with read-only arrays. Raise EOFError if the stream is cut."""
    length = int.from_bytes(_read(file, _LENGTH_BYTES), "little")
    body, sizes = pickle.loads(_read(file, length))
    return pickle.loads(body, buffers=[_read(file, size) for size in sizes])


def _read(file: IO[bytes], size: int) -> bytes:
    data = file.read(size)  # without Python's lock
    if len(data) < size:
        raise EOFError
    return data
