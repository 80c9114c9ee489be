"""Values with large arrays through a pipe between two processes of this program.

Owns the stream's form: a short pickle of everything but the arrays, then their bytes as they lie
in memory, which are read into place without Python's lock. Knows nothing of what is sent, nor of
processes. Not for streams from elsewhere: a pickle runs what its writer wants.
"""

from __future__ import annotations

import io
import pickle
from typing import IO, Any, NamedTuple

import numpy as np

_LENGTH_BYTES = 8


class _Head(NamedTuple):
    """An array without its numbers."""

    dtype: str
    shape: tuple[int, ...]
    is_final: bool  # nobody may write to it


def write_value(file: IO[bytes], value: Any) -> None:
    """Writes a value; an array that is in it several times goes out once, and comes in as one."""
    body = io.BytesIO()
    packer = _Packer(body, protocol=5)
    packer.dump(value)
    heads = [_Head(a.dtype.str, a.shape, not a.flags.writeable) for a in packer.arrays]
    head = pickle.dumps((heads, body.getvalue()), protocol=5)
    file.write(len(head).to_bytes(_LENGTH_BYTES, "little"))
    file.write(head)
    for array in packer.arrays:
        if array.nbytes:
            file.write(_memory(np.ascontiguousarray(array)))
    file.flush()


def read_value(file: IO[bytes]) -> Any:
    """The next value; its arrays own their memory. Raises EOFError where the stream is cut."""
    length = int.from_bytes(_read(file, bytearray(_LENGTH_BYTES)), "little")
    heads, body = pickle.loads(_read(file, bytearray(length)))
    arrays = []
    for head in heads:
        array = np.empty(head.shape, np.dtype(head.dtype))
        if array.nbytes:
            _read(file, _memory(array))
        array.setflags(write=not head.is_final)
        arrays.append(array)
    return _Unpacker(io.BytesIO(body), arrays).load()


class _Packer(pickle.Pickler):
    def __init__(self, file: io.BytesIO, protocol: int) -> None:
        super().__init__(file, protocol)
        self.arrays: list[np.ndarray] = []
        self._number: dict[int, int] = {}

    def persistent_id(self, value: Any) -> int | None:
        if not isinstance(value, np.ndarray) or value.dtype.hasobject:
            return None
        if id(value) not in self._number:
            self._number[id(value)] = len(self.arrays)
            self.arrays.append(value)
        return self._number[id(value)]


class _Unpacker(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, arrays: list[np.ndarray]) -> None:
        super().__init__(file)
        self._arrays = arrays

    def persistent_load(self, number: int) -> np.ndarray:
        return self._arrays[number]


def _memory(array: np.ndarray) -> memoryview:
    """The bytes of a contiguous array, as they lie."""
    return array.reshape(-1).view(np.uint8).data


def _read(file: IO[bytes], into: Any) -> Any:
    """Fill a buffer, and return it."""
    rest = memoryview(into)
    while rest:
        count = file.readinto(rest)  # type: ignore[attr-defined]
        if not count:
            raise EOFError
        rest = rest[count:]
    return into
