"""Loads from memory at an index of each lane's own, and prefetches (memory.py has whole vectors).

Indices are not checked.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError
from numba.extending import intrinsic

from renderer.trace.simd.types import (
    I32,
    INT32,
    INT64,
    LANES,
    MASK,
    VECTOR,
    address_of,
    array_kind,
    call_llvm,
    element_address,
    llvm_vector,
    repeated,
    shuffled,
)


def _addresses(context, builder, sig, args):
    """Return the addresses of array[index[lane]], for an intrinsic's array and I32 arguments."""
    wide, pointers = ir.VectorType(INT64, LANES), ir.VectorType(ir.PointerType(), LANES)
    data = address_of(context, builder, sig.args[0], args[0])
    first = repeated(builder, builder.ptrtoint(data, INT64))
    offset = builder.shl(builder.sext(args[1], wide), ir.Constant(wide, [2] * LANES))
    return builder.inttoptr(builder.add(first, offset), pointers)


@intrinsic
def gather(typing, array, index, mask):
    """Return array[index[lane]] in the lanes of the mask; 0 in the others, whose index may be
    anything.
    """
    kind = array_kind(array)
    if kind == "f64" or index != I32 or mask != MASK:
        raise TypingError("gather takes 32-bit elements, an I32 and a MASK")

    def codegen(context, builder, sig, args):
        address = _addresses(context, builder, sig, args)
        zero = ir.Constant(llvm_vector(kind), [0] * LANES)
        name = f"llvm.masked.gather.v{LANES}{kind}.v{LANES}p0"
        return call_llvm(builder, name, zero.type, [address, ir.Constant(INT32, 4), args[2], zero])

    return VECTOR[kind](array, index, mask), codegen


def _lane_addresses(builder: Any, first: Any, index: Any) -> list:
    """Return the addresses of first[index[lane]], lane by lane; first: the address of 32-bit
    integers.
    """
    lanes = [builder.extract_element(index, ir.Constant(INT32, lane)) for lane in range(LANES)]
    return [builder.gep(first, [builder.sext(k, INT64)], source_etype=INT32) for k in lanes]


@intrinsic
def gather_fours(typing, array, index, stride):
    """Return array[i], array[i + 1], array[i + stride], array[i + stride + 1] of an int32 array,
    with i = index[lane], in all lanes: four I32.

    Pairs are loaded one by one, which is faster than the processors' gather instructions.
    """

    def codegen(context, builder, sig, args):
        data = address_of(context, builder, sig.args[0], args[0])
        step = context.cast(builder, args[2], sig.args[2], types.intp)
        pair, fours = ir.VectorType(INT32, 2), []
        for first in (data, builder.gep(data, [step], source_etype=INT32)):
            parts = []
            for at in _lane_addresses(builder, first, args[1]):
                loaded = builder.load(builder.bitcast(at, pair.as_pointer()), typ=pair)
                loaded.align = 4
                parts.append(loaded)
            while len(parts) > 2:
                every = list(range(2 * parts[0].type.count))
                pairs = zip(parts[::2], parts[1::2], strict=True)
                parts = [shuffled(builder, a, b, every) for a, b in pairs]
            a, b = parts
            fours += [shuffled(builder, a, b, list(range(k, 2 * LANES, 2))) for k in (0, 1)]
        return context.make_tuple(builder, sig.return_type, fours)

    four = types.UniTuple(I32, 4)  # type: ignore[attr-defined]
    return four(array, index, stride), codegen


@intrinsic
def prefetch(typing, array, index):
    """Prefetch the cache line of array[index], which will be read soon; any index is allowed."""

    def codegen(context, builder, sig, args):
        at = builder.bitcast(element_address(context, builder, sig, args), INT32.as_pointer())
        read, keep, data = (ir.Constant(INT32, value) for value in (0, 3, 1))
        call_llvm(builder, "llvm.prefetch.p0", ir.VoidType(), [at, read, keep, data])
        return context.get_dummy_value()

    return types.void(array, index), codegen


@intrinsic
def prefetch_lanes(typing, array, index):
    """Prefetch array[index[lane]] of an int32 array, for each lane."""

    def codegen(context, builder, sig, args):
        data = address_of(context, builder, sig.args[0], args[0])
        hints = [ir.Constant(INT32, value) for value in (0, 3, 1)]
        for at in _lane_addresses(builder, data, args[1]):
            call_llvm(builder, "llvm.prefetch.p0", ir.VoidType(), [at, *hints])
        return context.get_dummy_value()

    return types.void(array, index), codegen
