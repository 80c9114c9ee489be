"""Load from memory at a separate index for each lane, and prefetch (memory.py has whole vectors).

Indices are not checked.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError

from lucida.renderer.trace.compile.emit import instruction, target

from .types import (
    I32,
    INT32,
    INT64,
    LANES,
    MASK,
    VECTOR,
    array_kind,
    call_llvm,
    element_address,
    first_address,
    llvm_vector,
    repeated,
    shuffled,
)


@instruction
def gather(array, index, mask):
    """Return array[index[lane]] in the lanes of the mask; 0 in the others, whose index may be
    anything.
    """
    kind = array_kind(array.kind)
    if kind == "f64" or index.kind != I32 or mask.kind != MASK:
        raise TypingError("gather takes 32-bit elements, an I32 and a MASK")

    def emit(builder):
        wide, pointers = ir.VectorType(INT64, LANES), ir.VectorType(ir.PointerType(), LANES)
        first = repeated(builder, builder.ptrtoint(first_address(builder, array), INT64))
        offset = builder.shl(builder.sext(index.llvm, wide), ir.Constant(wide, [2] * LANES))
        address = builder.inttoptr(builder.add(first, offset), pointers)
        zero = ir.Constant(llvm_vector(kind), [0] * LANES)
        arguments = [address, ir.Constant(INT32, 4), mask.llvm, zero]
        name = f"llvm.masked.gather.v{LANES}{kind}.v{LANES}p0"
        return call_llvm(builder, name, zero.type, arguments)

    return VECTOR[kind], emit


def _lane_addresses(builder: Any, first: Any, index: Any) -> list:
    """Return the addresses of first[index[lane]], lane by lane. first: the address of 32-bit
    integers.
    """
    lanes = [builder.extract_element(index.llvm, ir.Constant(INT32, k)) for k in range(LANES)]
    return [builder.gep(first, [builder.sext(k, INT64)], source_etype=INT32) for k in lanes]


@instruction
def gather_fours(array, index, stride):
    """Return array[i], array[i + 1], array[i + stride], array[i + stride + 1] of an int32 array,
    with i = index[lane], in all lanes: four I32.

    Pairs are loaded one by one, which is faster than the processors' gather instructions.
    """
    four = types.UniTuple(I32, 4)  # type: ignore[attr-defined]

    def emit(builder):
        pair, fours = ir.VectorType(INT32, 2), []
        for first in (first_address(builder, array), element_address(builder, array, stride)):
            parts = []
            for at in _lane_addresses(builder, first, index):
                loaded = builder.load(builder.bitcast(at, pair.as_pointer()), typ=pair)
                loaded.align = 4
                parts.append(loaded)
            while len(parts) > 2:
                every = list(range(2 * parts[0].type.count))
                pairs = zip(parts[::2], parts[1::2], strict=True)
                parts = [shuffled(builder, a, b, every) for a, b in pairs]
            a, b = parts
            fours += [shuffled(builder, a, b, list(range(k, 2 * LANES, 2))) for k in (0, 1)]
        return target().context.make_tuple(builder, four, fours)

    return four, emit


def _prefetch(builder: Any, addresses: list) -> None:
    hints = [ir.Constant(INT32, value) for value in (0, 3, 1)]  # read, keep, data
    for at in addresses:
        call_llvm(builder, "llvm.prefetch.p0", ir.VoidType(), [at, *hints])


@instruction
def prefetch(array, index):
    """Prefetch the cache line of array[index], which will be read soon; any index is allowed."""

    def emit(builder):
        at = builder.bitcast(element_address(builder, array, index), INT32.as_pointer())
        _prefetch(builder, [at])

    return types.void, emit


@instruction
def prefetch_lanes(array, index):
    """Prefetch array[index[lane]] of an int32 array, for each lane."""

    def emit(builder):
        _prefetch(builder, _lane_addresses(builder, first_address(builder, array), index))

    return types.void, emit
