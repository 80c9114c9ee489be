"""Loads and stores of vectors of 16 lanes, for kernels in explicit SIMD (lanes.py).

Addresses, whole vectors, and squares of an image; gather.py has gathers. Only LLVM's generic
operations are used. Indices are not checked.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.errors import TypingError
from numba.extending import intrinsic

from renderer.trace.simd.types import (
    ELEMENT,
    INT32,
    INT64,
    LANES,
    VECTOR,
    BaseTuple,
    CPointer,
    address_of,
    array_kind,
    element_address,
    llvm_vector,
    shuffled,
    undefined,
)


@intrinsic
def pointer(typing, array):
    """Return the address of a contiguous array, which is indexed like the flattened array.

    Inside kernels, arrays are passed as pointers: an array is seven numbers and a reference count,
    which make a function per stage slow to compile and to run. numba frees an array made in the
    kernel after the last use of its name, so take its pointer in the loop that uses it.
    """

    def codegen(context, builder, sig, args):
        return address_of(context, builder, sig.args[0], args[0])

    return contiguous(array)(array), codegen


def contiguous(array: Any) -> Any:
    """Return the type of the pointer to an array. Raise TypingError if it is not in C order."""
    if not isinstance(array, types.Array) or array.layout != "C":
        raise TypingError(f"a contiguous array is needed, not {array}")
    return CPointer(array.dtype)


@intrinsic
def pointers(typing, data):
    """Return a tuple with pointers in place of its arrays, and of those of the tuples in it."""

    def without_arrays(kind):
        if isinstance(kind, BaseTuple):
            return BaseTuple.from_types(
                [without_arrays(each) for each in kind], getattr(kind, "instance_class", None)
            )
        if isinstance(kind, types.Array):
            return contiguous(kind)
        return kind

    def converted(context, builder, kind, value):
        if isinstance(kind, BaseTuple):
            values = cgutils.unpack_tuple(builder, value, len(kind))
            parts = [converted(context, builder, *p) for p in zip(kind, values, strict=True)]
            return context.make_tuple(builder, without_arrays(kind), parts)
        is_array = isinstance(kind, types.Array)
        return address_of(context, builder, kind, value) if is_array else value

    def codegen(context, builder, sig, args):
        return converted(context, builder, sig.args[0], args[0])

    return without_arrays(data)(data), codegen


@intrinsic
def shifted(typing, array, index):
    """Return the pointer to array[index], for a pointer."""
    array_kind(array)

    def codegen(context, builder, sig, args):
        return element_address(context, builder, sig, args)

    return array(array, index), codegen


def divider(record: Any, floats: Iterable[int], ints: Iterable[int]) -> Any:
    """Return a function for kernels that divides two pointers, to float32 and to int32, into the
    fields of a NamedTuple, with these sizes.
    """
    sizes = [list(floats), list(ints)]

    @intrinsic
    def divided(typing, floats, ints):
        kinds = [kind for kind, own in zip((floats, ints), sizes, strict=True) for _ in own]
        fields = BaseTuple.from_types(kinds, record)

        def codegen(context, builder, sig, args):
            parts = [
                builder.gep(memory, [INT64(begin)], source_etype=kind)
                for memory, kind, own in zip(args, (ELEMENT["f32"], INT32), sizes, strict=True)
                for begin in accumulate(own[:-1], initial=0)
            ]
            return context.make_tuple(builder, fields, parts)

        return fields(floats, ints), codegen

    return divided


def check_fits(array: Any, vector: Any) -> None:
    if array_kind(array) != vector.kind:
        raise TypingError(f"{vector} does not fit into {array}")


def stack_room(kind: Any, count: int) -> Any:
    """Return a function for kernels that allocates `count` numbers of a numba type on the stack.

    It returns a pointer, aligned to cache lines and valid until the kernel returns. An array would
    take longer to compile.
    """

    @intrinsic
    def room(typing):
        def codegen(context, builder, sig, args):
            element = context.get_value_type(kind)
            with builder.goto_entry_block():
                at = builder.alloca(ir.ArrayType(element, count))
                at.align = 64
            return builder.bitcast(at, element.as_pointer())

        return CPointer(kind)(), codegen

    return room


@intrinsic
def as_int32(typing, array):
    """Return a pointer to 32-bit numbers as a pointer to int32, to the same memory."""

    def codegen(context, builder, sig, args):
        return builder.bitcast(args[0], INT32.as_pointer())

    return CPointer(types.int32)(array), codegen


@intrinsic
def as_float64(typing, array):
    """Return a pointer to int32, aligned to 8 bytes, as a pointer to float64."""

    def codegen(context, builder, sig, args):
        return builder.bitcast(args[0], ELEMENT["f64"].as_pointer())

    return CPointer(types.float64)(array), codegen


@intrinsic
def load(typing, array, index):
    """Return array[index : index + 16]."""
    kind = array_kind(array)

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        at = builder.bitcast(at, llvm_vector(kind).as_pointer())
        value = builder.load(at, typ=llvm_vector(kind))
        value.align = 4
        return value

    return VECTOR[kind](array, index), codegen


@intrinsic
def store(typing, array, index, vector):
    """Set array[index : index + 16] = vector."""
    check_fits(array, vector)

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        builder.store(args[2], builder.bitcast(at, args[2].type.as_pointer()), align=4)
        return context.get_dummy_value()

    return types.void(array, index, vector), codegen


@intrinsic
def load_half(typing, array, index):
    """Return array[index : index + 8], twice."""
    kind = array_kind(array)

    def codegen(context, builder, sig, args):
        half = llvm_vector(kind, LANES // 2)
        at = element_address(context, builder, sig, args)
        value = builder.load(builder.bitcast(at, half.as_pointer()), typ=half)
        value.align = 4
        lanes = [lane % (LANES // 2) for lane in range(LANES)]
        return shuffled(builder, value, undefined(half), lanes)

    return VECTOR[kind](array, index), codegen


@intrinsic
def store_half(typing, array, index, vector):
    """Set array[index : index + 8] to the lower half of a vector."""
    check_fits(array, vector)

    def codegen(context, builder, sig, args):
        half = shuffled(builder, args[2], undefined(args[2].type), list(range(LANES // 2)))
        at = element_address(context, builder, sig, args)
        builder.store(half, builder.bitcast(at, half.type.as_pointer()), align=4)
        return context.get_dummy_value()

    return types.void(array, index, vector), codegen


@intrinsic
def stream(typing, array, index, vector):
    """Like store(), bypassing the caches: for whole lines of 64 bytes that are not read soon.

    This saves reading the line first, and does not evict other data. The address must be a multiple
    of 64 bytes; see is_line().
    """
    check_fits(array, vector)

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        stored = builder.store(args[2], builder.bitcast(at, args[2].type.as_pointer()), align=64)
        one = builder.module.add_metadata([ir.Constant(INT32, 1)])
        stored.set_metadata("nontemporal", one)
        return context.get_dummy_value()

    return types.void(array, index, vector), codegen


@intrinsic
def is_line(typing, array, index):
    """Return True if array[index] begins a cache line of 64 bytes."""

    def codegen(context, builder, sig, args):
        at = builder.ptrtoint(element_address(context, builder, sig, args), INT64)
        return builder.icmp_unsigned("==", builder.and_(at, INT64(63)), INT64(0))

    return types.boolean(array, index), codegen


# Squares of 4 x 4 pixels to images: row r of the square goes to array[index + r * stride].


def _store_rows(context: Any, builder: Any, sig: Any, args: Any, rows: list) -> Any:
    index, stride = (
        context.cast(builder, value, fe_type, types.intp)
        for value, fe_type in zip(args[1:3], sig.args[1:3], strict=True)
    )
    kind = array_kind(sig.args[0])
    first = address_of(context, builder, sig.args[0], args[0])
    for row in rows:
        at = builder.gep(first, [index], source_etype=ELEMENT[kind])
        builder.store(row, builder.bitcast(at, row.type.as_pointer()), align=4)
        index = builder.add(index, stride)
    return context.get_dummy_value()


@intrinsic
def store_square(typing, array, index, stride, vector):
    """Store one number per pixel."""
    check_fits(array, vector)

    def codegen(context, builder, sig, args):
        nothing = undefined(args[3].type)
        rows = [
            shuffled(builder, args[3], nothing, [4 * row + column for column in range(4)])
            for row in range(4)
        ]
        return _store_rows(context, builder, sig, args, rows)

    return types.void(array, index, stride, vector), codegen


@intrinsic
def store_square3(typing, array, index, stride, x, y, z):
    """Store three numbers per pixel, interleaved."""
    check_fits(array, x)

    def codegen(context, builder, sig, args):
        both = list(range(2 * LANES))
        xy = shuffled(builder, args[3], args[4], both)
        zz = shuffled(builder, args[5], args[5], both)
        rows = [
            shuffled(builder, xy, zz, [4 * row + c + LANES * k for c in range(4) for k in range(3)])
            for row in range(4)
        ]
        return _store_rows(context, builder, sig, args, rows)

    return types.void(array, index, stride, x, y, z), codegen
