"""Explicit SIMD inside kernels: vectors of 16 lanes, one for each pixel, triangle or box.

numba has no vector types; LLVM, below it, has. This module teaches numba four types (F32, F64, I32
and MASK, 16 lanes each), their operators, and the functions below, so that a kernel can write
`fma(ex, x, fma(ey, y, e1)) >= 0` for 16 pixels at once. LLVM maps a vector to one AVX-512
register, to two of AVX or to four of SSE or NEON: only its generic operations are used, no
instruction of any one processor.

No fast-math flags: nothing is reassociated, which watertight intersection relies on. Only fma()
is fused, and only on processors that can: see there.

Knows nothing of rays. Kernels name these functions at module level, so that they can be cached.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError
from numba.core.types.misc import CPointer
from numba.extending import intrinsic

from renderer.trace.simd_types import (
    ELEMENT,
    F32,
    F64,
    I1,
    I32,
    INT32,
    INT64,
    KIND_OF,
    LANES,
    MASK,
    SCALAR,
    VECTOR,
    VectorType,
    address_of,
    array_kind,
    call_llvm,
    common_kind,
    element_address,
    llvm_vector,
    repeated,
    shuffled,
    undefined,
    widened,
)

# Vectors from numbers and from memory. Indices are not checked.


@intrinsic
def splat(typing, x):
    """A vector with the float32, float64 or int32 number x in each lane."""
    if x not in KIND_OF:
        raise TypingError(f"no vectors of {x}")

    def codegen(context, builder, sig, args):
        return repeated(builder, args[0])

    return VECTOR[KIND_OF[x]](x), codegen


def _constant(values: list[float]) -> Any:
    def codegen(context, builder, sig, args):
        return ir.Constant(llvm_vector("f32"), values)

    return F32(), codegen


@intrinsic
def lane_column(typing):
    """0 1 2 3 0 1 2 3 ...: the column of each lane in a square of 4 x 4."""
    return _constant([lane % 4 for lane in range(LANES)])


@intrinsic
def lane_row(typing):
    """0 0 0 0 1 1 1 1 ...: the row of each lane in a square of 4 x 4."""
    return _constant([lane // 4 for lane in range(LANES)])


@intrinsic
def pointer(typing, array):
    """The address of a contiguous array, which is indexed like the flat array.

    Inside kernels, arrays are handed on as pointers: an array is seven numbers and a count of
    references, which a function per stage makes slow to compile and to run. An array that the
    kernel made is freed after the last use of its name: take its pointer in the loop that uses it.
    """
    if not isinstance(array, types.Array) or array.layout != "C":
        raise TypingError(f"a contiguous array is needed, not {array}")

    def codegen(context, builder, sig, args):
        return address_of(context, builder, sig.args[0], args[0])

    return CPointer(array.dtype)(array), codegen


@intrinsic
def shifted(typing, array, index):
    """The pointer to array[index], for a pointer."""
    array_kind(array)

    def codegen(context, builder, sig, args):
        return element_address(context, builder, sig, args)

    return array(array, index), codegen


@intrinsic
def load(typing, array, index):
    """array[index : index + 16]."""
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
    """array[index : index + 16] = vector."""
    if array_kind(array) != vector.kind:
        raise TypingError(f"{vector} does not fit into {array}")

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        builder.store(args[2], builder.bitcast(at, args[2].type.as_pointer()), align=4)
        return context.get_dummy_value()

    return types.void(array, index, vector), codegen


@intrinsic
def stream(typing, array, index, vector):
    """store(), past the caches: for lines of 64 bytes, written whole, that are not read soon.

    Spares reading the line before, and keeps what else is in the caches. The address must be a
    multiple of 64 bytes; is_line() tells.
    """
    if array_kind(array) != vector.kind:
        raise TypingError(f"{vector} does not fit into {array}")

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        stored = builder.store(args[2], builder.bitcast(at, args[2].type.as_pointer()), align=64)
        one = builder.module.add_metadata([ir.Constant(INT32, 1)])
        stored.set_metadata("nontemporal", one)
        return context.get_dummy_value()

    return types.void(array, index, vector), codegen


@intrinsic
def is_line(typing, array, index):
    """Whether array[index] begins a cache line of 64 bytes."""

    def codegen(context, builder, sig, args):
        at = builder.ptrtoint(element_address(context, builder, sig, args), INT64)
        return builder.icmp_unsigned("==", builder.and_(at, INT64(63)), INT64(0))

    return types.boolean(array, index), codegen


@intrinsic
def gather(typing, array, index, mask):
    """array[index[lane]] in the lanes of the mask; 0 in the others, whose index may be any."""
    return _gather(array_kind(array), array, index, mask)


def _gather(kind: str, array: Any, index: Any, mask: Any) -> Any:
    if kind == "f64" or index != I32 or mask != MASK:
        raise TypingError("gather takes 32-bit elements, an I32 and a MASK")

    def codegen(context, builder, sig, args):
        wide, pointers = ir.VectorType(INT64, LANES), ir.VectorType(ir.PointerType(), LANES)
        data = address_of(context, builder, sig.args[0], args[0])
        first = repeated(builder, builder.ptrtoint(data, INT64))
        offset = builder.shl(builder.sext(args[1], wide), ir.Constant(wide, [2] * LANES))
        address = builder.inttoptr(builder.add(first, offset), pointers)
        zero = ir.Constant(llvm_vector(kind), [0] * LANES)
        name = f"llvm.masked.gather.v{LANES}{kind}.v{LANES}p0"
        return call_llvm(builder, name, zero.type, [address, ir.Constant(INT32, 4), args[2], zero])

    return VECTOR[kind](array, index, mask), codegen


@intrinsic
def fetch(typing, array, index, mask):
    """A vector of array[index]: gathered for an I32 of indices, repeated for a number."""
    kind = array_kind(array)
    if index == I32:
        return _gather(kind, array, index, mask)

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        return repeated(builder, builder.load(at, typ=ELEMENT[kind]))

    return VECTOR[kind](array, index, mask), codegen


@intrinsic
def fetch_index(typing, array, index, mask):
    """array[index]: gathered for an I32 of indices, one int32 for a number."""
    if index == I32:
        return _gather(array_kind(array), array, index, mask)

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        return builder.load(at, typ=INT32)

    return types.int32(array, index, mask), codegen


@intrinsic
def prefetch(typing, array, index):
    """Asks for the cache line of array[index], which will be read soon; any index is allowed."""

    def codegen(context, builder, sig, args):
        at = element_address(context, builder, sig, args)
        read, keep, data = (ir.Constant(INT32, value) for value in (0, 3, 1))
        call_llvm(builder, "llvm.prefetch.p0", ir.VoidType(), [at, read, keep, data])
        return context.get_dummy_value()

    return types.void(array, index), codegen


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
    """Stores a number a pixel."""
    if array_kind(array) != vector.kind:
        raise TypingError(f"{vector} does not fit into {array}")

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
    """Stores three numbers a pixel, interleaved."""
    if array_kind(array) != common_kind(x, y, z):
        raise TypingError(f"{x} does not fit into {array}")

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


# Functions of vectors, lane by lane. Numbers may stand for vectors, but not for all of them.


def _function(name: str, count: int) -> Callable:
    """The typing function of an intrinsic that is LLVM's own function `name`."""

    def build(*fe_types: Any) -> Any:
        kind = common_kind(*fe_types)
        vector = VECTOR[kind]

        def codegen(context, builder, sig, args):
            values = [
                widened(context, builder, a, t, kind) for a, t in zip(args, sig.args, strict=True)
            ]
            return call_llvm(builder, f"llvm.{name}.v{LANES}{kind}", llvm_vector(kind), values)

        return vector(*fe_types), codegen

    if count == 1:
        return lambda typing, x: build(x)
    return lambda typing, x, y, z: build(x, y, z)


# x * y + z, in one rounding where the processor can and in two where it cannot, alike wherever it
# is written: fma(-x, y, -z) is exactly -fma(x, y, z) in either case.
fma = intrinsic(_function("fmuladd", 3))
vabs = intrinsic(_function("fabs", 1))
vsqrt = intrinsic(_function("sqrt", 1))
vfloor = intrinsic(_function("floor", 1))


@intrinsic
def inverse_root(typing, x):
    """1 / sqrt(x) for x > 0, normal; relative error below 4e-7. NaN or inf for 0.

    By the processor's estimate and one step of Newton's method, where it has one: a root and a
    division take several times as long.
    """
    if x != F32:
        raise TypingError(f"{F32} is needed, not {x}")

    def codegen(context, builder, sig, args):
        flags = ("afn", "arcp", "contract", "reassoc")
        name = f"llvm.sqrt.v{LANES}f32"
        root = call_llvm(builder, name, args[0].type, [args[0]])
        root.fastmath.update(flags)
        one = ir.Constant(args[0].type, [1.0] * LANES)
        return builder.fdiv(one, root, flags=flags)

    return F32(x), codegen


def _extreme(sign: str) -> Callable:
    """The smaller or larger of two; y where either is NaN. One instruction where there is one."""

    def build(typing, x, y):
        kind = common_kind(x, y)

        def codegen(context, builder, sig, args):
            x_, y_ = (
                widened(context, builder, a, t, kind) for a, t in zip(args, sig.args, strict=True)
            )
            return builder.select(builder.fcmp_ordered(sign, x_, y_), x_, y_)

        return VECTOR[kind](x, y), codegen

    return build


vmin = intrinsic(_extreme("<"))
vmax = intrinsic(_extreme(">"))


@intrinsic
def select(typing, mask, x, y):
    """x in the lanes of the mask, y in the others."""
    kind = common_kind(x, y)

    def codegen(context, builder, sig, args):
        x_, y_ = (
            widened(context, builder, a, t, kind)
            for a, t in zip(args[1:], sig.args[1:], strict=True)
        )
        return builder.select(args[0], x_, y_)

    return VECTOR[kind](mask, x, y), codegen


def _conversion(source: VectorType, target: VectorType, instruction: str) -> Callable:
    def build(typing, x):
        if x != source:
            raise TypingError(f"{source} is needed, not {x}")

        def codegen(context, builder, sig, args):
            return getattr(builder, instruction)(args[0], llvm_vector(target.kind))

        return target(x), codegen

    return build


to_f64 = intrinsic(_conversion(F32, F64, "fpext"))
to_f32 = intrinsic(_conversion(F64, F32, "fptrunc"))
i32_of = intrinsic(_conversion(F32, I32, "fptosi"))  # towards 0; the value must fit
f32_of = intrinsic(_conversion(I32, F32, "sitofp"))
bits_of_f32 = intrinsic(_conversion(F32, I32, "bitcast"))
f32_of_bits = intrinsic(_conversion(I32, F32, "bitcast"))


# From vectors to numbers.


@intrinsic
def bits(typing, mask):
    """A mask as an int64: bit i is lane i."""
    if mask != MASK:
        raise TypingError(f"a mask is needed, not {mask}")

    def codegen(context, builder, sig, args):
        return builder.zext(builder.bitcast(args[0], ir.IntType(LANES)), INT64)

    return types.int64(mask), codegen


@intrinsic
def mask_of(typing, number):
    """The mask whose lane i is bit i of an integer."""

    def codegen(context, builder, sig, args):
        value = context.cast(builder, args[0], sig.args[0], types.int32)
        return builder.bitcast(builder.trunc(value, ir.IntType(LANES)), llvm_vector("mask"))

    return MASK(number), codegen


def _permutation(lanes: list[int]) -> Callable:
    def build(typing, x):
        def codegen(context, builder, sig, args):
            return shuffled(builder, args[0], undefined(args[0].type), lanes)

        return x(x), codegen

    return build


# Lanes in another order: 0 to 7, twice; each quarter of a half in the other's place; 1 2 0 3 within
# each quarter.
lower_half_twice = intrinsic(_permutation([lane % 8 for lane in range(LANES)]))
quarters_swapped = intrinsic(_permutation([lane ^ 4 for lane in range(LANES)]))
next_of_three = intrinsic(_permutation([[1, 2, 0, 3][lane % 4] for lane in range(LANES)]))


def _reduction(sign: str) -> Callable:
    def build(typing, x):
        def codegen(context, builder, sig, args):
            # Fold the vector in halves until one lane is left.
            (value,), lanes = args, LANES
            while lanes > 1:
                lanes //= 2
                nothing = undefined(value.type)
                low = shuffled(builder, value, nothing, list(range(lanes)))
                high = shuffled(builder, value, nothing, list(range(lanes, 2 * lanes)))
                value = builder.select(builder.fcmp_ordered(sign, low, high), low, high)
            return builder.extract_element(value, ir.Constant(INT32, 0))

        return SCALAR[common_kind(x)](x), codegen

    return build


smallest = intrinsic(_reduction("<"))
largest = intrinsic(_reduction(">"))


@intrinsic
def lowest_bit(typing, number):
    """The index, int64, of the lowest bit set in an integer whose low 32 bits are not 0."""

    def codegen(context, builder, sig, args):
        value = context.cast(builder, args[0], sig.args[0], types.int32)
        index = call_llvm(builder, "llvm.cttz.i32", INT32, [value, ir.Constant(I1, 1)])
        return builder.zext(index, INT64)

    return types.int64(number), codegen


@intrinsic
def lane_of(typing, vector, lane):
    """One lane of a vector, by its index."""
    scalar = SCALAR[vector.kind]

    def codegen(context, builder, sig, args):
        index = context.cast(builder, args[1], sig.args[1], types.int32)
        return builder.extract_element(args[0], index)

    return scalar(vector, lane), codegen
