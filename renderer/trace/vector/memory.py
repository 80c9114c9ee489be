"""Loads and stores of vectors of 16 lanes, for kernels in explicit SIMD (lanes.py).

This module has addresses, whole vectors, and squares of an image; gather.py has gathers. Only
LLVM's generic operations are used. Indices are not checked.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError

from lucida.renderer.trace.compile.emit import BaseTuple, emitted, instruction, target

from .types import (
    ELEMENT,
    INT32,
    INT64,
    LANES,
    VECTOR,
    CPointer,
    array_kind,
    element_address,
    first_address,
    llvm_vector,
    shuffled,
    undefined,
)


@instruction
def pointer(array):
    """Return the address of a contiguous array, which is indexed like the flattened array.

    Kernels pass arrays as pointers, because an array is seven numbers and a reference count, which
    make functions slow to compile and to run. numba frees an array made in the kernel after the
    last use of its name, so take its pointer in the loop that uses it.
    """
    return contiguous(array.kind), lambda builder: first_address(builder, array)


def contiguous(array: Any) -> Any:
    """Return the type of the pointer to an array. Raise TypingError if it is not in C order."""
    if not isinstance(array, types.Array) or array.layout != "C":
        raise TypingError(f"a contiguous array is needed, not {array}")
    return CPointer(array.dtype)


@emitted
def pointers(data):
    """Return a tuple with pointers in place of its arrays, and of those of the tuples in it."""
    kind = getattr(data, "kind", None)
    if isinstance(kind, BaseTuple):
        parts = [pointers(part) for part in data]
        return kind.instance_class(*parts) if hasattr(kind, "fields") else tuple(parts)
    return pointer(data) if isinstance(kind, types.Array) else data


@instruction
def shifted(array, index):
    """Return the pointer to array[index]. array: a pointer."""
    array_kind(array.kind)
    return array.kind, lambda builder: element_address(builder, array, index)


def divider(record: Any, floats: Iterable[int], ints: Iterable[int]) -> Any:
    """Return a function for kernels that divides two pointers, to float32 and to int32, into the
    fields of a NamedTuple, with these sizes.
    """
    sizes = [list(floats), list(ints)]

    @emitted
    def divided(floats, ints):
        return record(
            *(
                shifted(memory, begin)
                for memory, own in zip((floats, ints), sizes, strict=True)
                for begin in accumulate(own[:-1], initial=0)
            )
        )

    return divided


def check_fits(array: Any, vector: Any) -> None:
    if array_kind(array.kind) != vector.kind.kind:
        raise TypingError(f"{vector.kind} does not fit into {array.kind}")


def stack_room(kind: Any, count: int) -> Any:
    """Return a function for kernels that allocates `count` numbers of a numba type on the stack.

    It returns a pointer, aligned to cache lines and valid until the kernel returns. An array would
    take longer to compile.
    """

    @instruction
    def room():
        def emit(builder):
            element = target().context.get_value_type(kind)
            with builder.goto_entry_block():
                at = builder.alloca(ir.ArrayType(element, count))
                at.align = 64
            return builder.bitcast(at, element.as_pointer())

        return CPointer(kind), emit

    return room


@instruction
def as_int32(array):
    """Return a pointer to 32-bit numbers as a pointer to int32 in the same memory."""
    return CPointer(types.int32), lambda b: b.bitcast(array.llvm, INT32.as_pointer())


@instruction
def as_float64(array):
    """Return a pointer to int32, aligned to 8 bytes, as a pointer to float64."""
    return CPointer(types.float64), lambda b: b.bitcast(array.llvm, ELEMENT["f64"].as_pointer())


def _load(builder: Any, array: Any, index: Any, vector: Any) -> Any:
    at = builder.bitcast(element_address(builder, array, index), vector.as_pointer())
    value = builder.load(at, typ=vector)
    value.align = 4
    return value


def _store(builder: Any, array: Any, index: Any, vector: Any, align: int = 4) -> Any:
    at = element_address(builder, array, index)
    return builder.store(vector, builder.bitcast(at, vector.type.as_pointer()), align=align)


@instruction
def load(array, index):
    """Return array[index : index + 16]."""
    kind = array_kind(array.kind)
    return VECTOR[kind], lambda builder: _load(builder, array, index, llvm_vector(kind))


@instruction
def store(array, index, vector):
    """Set array[index : index + 16] = vector."""
    check_fits(array, vector)
    return types.void, lambda builder: _store(builder, array, index, vector.llvm)


@instruction
def load_half(array, index):
    """Return array[index : index + 8], twice."""
    kind = array_kind(array.kind)
    half = llvm_vector(kind, LANES // 2)

    def emit(builder):
        lanes = [lane % (LANES // 2) for lane in range(LANES)]
        return shuffled(builder, _load(builder, array, index, half), undefined(half), lanes)

    return VECTOR[kind], emit


@instruction
def store_half(array, index, vector):
    """Set array[index : index + 8] to the lower half of a vector."""
    check_fits(array, vector)

    def emit(builder):
        lanes = list(range(LANES // 2))
        half = shuffled(builder, vector.llvm, undefined(vector.llvm.type), lanes)
        _store(builder, array, index, half)

    return types.void, emit


@instruction
def stream(array, index, vector):
    """Store a vector past the caches, for whole lines of 64 bytes that are not read soon.

    This saves reading the line first, and does not evict other data. The address must be a multiple
    of 64 bytes; see is_line().
    """
    check_fits(array, vector)

    def emit(builder):
        one = builder.module.add_metadata([ir.Constant(INT32, 1)])
        stored = _store(builder, array, index, vector.llvm, align=64)
        stored.set_metadata("nontemporal", one)

    return types.void, emit


@instruction
def is_line(array, index):
    """Return True if array[index] begins a cache line of 64 bytes."""

    def emit(builder):
        at = builder.ptrtoint(element_address(builder, array, index), INT64)
        return builder.icmp_unsigned("==", builder.and_(at, INT64(63)), INT64(0))

    return types.boolean, emit


# Store squares of 4 x 4 pixels in images: row r of the square goes to array[index + r * stride].


@instruction
def store_square(array, index, stride, vector):
    """Store one number per pixel."""
    check_fits(array, vector)
    rows = [[4 * row + column for column in range(4)] for row in range(4)]
    nothing = undefined(llvm_vector(vector.kind.kind))
    return types.void, lambda b: _store_rows(b, array, index, stride, vector.llvm, nothing, rows)


@instruction
def store_square3(array, index, stride, x, y, z):
    """Store three numbers per pixel, interleaved."""
    check_fits(array, x)

    def emit(builder):
        both = list(range(2 * LANES))
        xy = shuffled(builder, x.llvm, y.llvm, both)
        zz = shuffled(builder, z.llvm, z.llvm, both)
        rows = [[4 * row + c + LANES * k for c in range(4) for k in range(3)] for row in range(4)]
        _store_rows(builder, array, index, stride, xy, zz, rows)

    return types.void, emit


def _store_rows(
    builder: Any, array: Any, index: Any, stride: Any, a: Any, b: Any, rows: list
) -> None:
    """Store lanes of two vectors as the rows of a square."""
    for row, lanes in enumerate(rows):
        _store(builder, array, index + stride * row, shuffled(builder, a, b, lanes))
