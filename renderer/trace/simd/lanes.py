"""Explicit SIMD inside kernels: vectors of 16 lanes, one for each pixel, triangle or box.

numba has no vector types, but LLVM below it has. This module adds four types to numba (F32, F64,
I32 and MASK, 16 lanes each), their operators, and the functions below, so that a kernel can write
`fma(ex, x, fma(ey, y, e1)) >= 0` for 16 pixels at once. LLVM maps a vector to one AVX-512
register, to two of AVX or to four of SSE or NEON: only its generic operations are used, no
processor-specific intrinsics.

No fast-math flags: nothing is reassociated, which watertight intersection relies on. Only fma()
is fused, and only on processors that support it: see there.

Kernels refer to these functions at module level, so that they can be cached.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.errors import TypingError
from numba.extending import intrinsic

from renderer.trace.simd.types import (
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
    call_llvm,
    common_kind,
    llvm_vector,
    repeated,
    shuffled,
    undefined,
    widened,
)

# Vectors from numbers.


@intrinsic
def splat(typing, x):
    """Return a vector with the float32, float64 or int32 number x in each lane."""
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
    """Return 0 1 2 3 0 1 2 3 ...: the column of each lane in a square of 4 x 4."""
    return _constant([lane % 4 for lane in range(LANES)])


@intrinsic
def lane_row(typing):
    """Return 0 0 0 0 1 1 1 1 ...: the row of each lane in a square of 4 x 4."""
    return _constant([lane // 4 for lane in range(LANES)])


# Functions of vectors, lane by lane. Numbers are accepted for some vectors, but not for all.


def _function(name: str, count: int) -> Callable:
    """Return the typing function of an intrinsic that maps to LLVM's function `name`."""

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


# x * y + z, with one rounding if the processor supports it, otherwise with two; consistently in all
# code: fma(-x, y, -z) is exactly -fma(x, y, z) in either case.
fma = intrinsic(_function("fmuladd", 3))
vabs = intrinsic(_function("fabs", 1))
vsqrt = intrinsic(_function("sqrt", 1))
vfloor = intrinsic(_function("floor", 1))


@intrinsic
def inverse_root(typing, x):
    """Return 1 / sqrt(x) for x > 0, normal; relative error below 4e-7. NaN or inf for 0.

    Uses the processor's estimate and one step of Newton's method, if there is an estimate: a square
    root and a division take several times as long.
    """

    def codegen(context, builder, sig, args):
        flags = ("afn", "arcp", "contract", "reassoc")
        name = f"llvm.sqrt.v{LANES}f32"
        root = call_llvm(builder, name, args[0].type, [args[0]])
        root.fastmath.update(flags)
        one = ir.Constant(args[0].type, [1.0] * LANES)
        return builder.fdiv(one, root, flags=flags)

    return F32(x), codegen


def _extreme(sign: str) -> Callable:
    """Return the typing function of the minimum or maximum; y if either is NaN. A single
    instruction on processors that have one.
    """

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
def larger(typing, x, y):
    """Return vmax() of two F32 without NaN.

    If vmax() updates a vector in memory, LLVM stores single lanes, which are slow to load again.
    This function avoids that.
    """

    def codegen(context, builder, sig, args):
        name, vector = f"llvm.maxnum.v{LANES}f32", llvm_vector("f32")
        function = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(vector, [vector, vector]), name
        )
        return builder.call(function, args, fastmath=("nnan", "nsz"))

    return F32(x, y), codegen


@intrinsic
def select(typing, mask, x, y):
    """Return x in the lanes of the mask, y in the others."""
    kind = common_kind(x, y)

    def codegen(context, builder, sig, args):
        x_, y_ = (
            widened(context, builder, a, t, kind)
            for a, t in zip(args[1:], sig.args[1:], strict=True)
        )
        return builder.select(args[0], x_, y_)

    return VECTOR[kind](mask, x, y), codegen


def _conversion(target: VectorType, instruction: str) -> Callable:
    def build(typing, x):

        def codegen(context, builder, sig, args):
            return getattr(builder, instruction)(args[0], llvm_vector(target.kind))

        return target(x), codegen

    return build


@intrinsic
def to_f64(typing, x):
    """Return an F32 as an F64; an F64 unchanged."""

    def codegen(context, builder, sig, args):
        return builder.fpext(args[0], llvm_vector("f64")) if sig.args[0] == F32 else args[0]

    return F64(x), codegen


to_f32 = intrinsic(_conversion(F32, "fptrunc"))
i32_of = intrinsic(_conversion(I32, "fptosi"))  # rounds towards 0; the value must fit
f32_of = intrinsic(_conversion(F32, "sitofp"))
f64_of = intrinsic(_conversion(F64, "sitofp"))
bits_of_f32 = intrinsic(_conversion(I32, "bitcast"))
f32_of_bits = intrinsic(_conversion(F32, "bitcast"))


# From vectors to numbers.


@intrinsic
def bits(typing, mask):
    """Return a mask as an int64: bit i is lane i."""

    def codegen(context, builder, sig, args):
        return builder.zext(builder.bitcast(args[0], ir.IntType(LANES)), INT64)

    return types.int64(mask), codegen


@intrinsic
def mask_of(typing, number):
    """Return the mask whose lane i is bit i of an integer."""

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


# Permutations: swap the quarters of each half; 1 2 0 3 within each quarter; the first, or the last,
# lane of each quarter in all its lanes.
quarters_swapped = intrinsic(_permutation([lane ^ 4 for lane in range(LANES)]))
next_of_three = intrinsic(_permutation([lane + (1, 1, -2, 0)[lane % 4] for lane in range(LANES)]))
first_of_four = intrinsic(_permutation([lane & ~3 for lane in range(LANES)]))
last_of_four = intrinsic(_permutation([lane | 3 for lane in range(LANES)]))


@intrinsic
def lower_halves(typing, x, y):
    """Return lanes 0 to 7 of x, then lanes 0 to 7 of y."""

    def codegen(context, builder, sig, args):
        lanes = [lane + (LANES // 2) * (lane >= LANES // 2) for lane in range(LANES)]
        return shuffled(builder, args[0], args[1], lanes)

    return x(x, y), codegen


@intrinsic
def smallest(typing, x):
    """Return the least of a vector's lanes."""

    def codegen(context, builder, sig, args):
        # Fold the vector in half until one lane is left.
        (value,), lanes = args, LANES
        while lanes > 1:
            lanes //= 2
            nothing = undefined(value.type)
            low = shuffled(builder, value, nothing, list(range(lanes)))
            high = shuffled(builder, value, nothing, list(range(lanes, 2 * lanes)))
            value = builder.select(builder.fcmp_ordered("<", low, high), low, high)
        return builder.extract_element(value, ir.Constant(INT32, 0))

    return SCALAR[common_kind(x)](x), codegen


@intrinsic
def lowest_bit(typing, number):
    """Return the index, int64, of the lowest bit set in an integer whose low 32 bits are not 0."""

    def codegen(context, builder, sig, args):
        value = context.cast(builder, args[0], sig.args[0], types.int32)
        index = call_llvm(builder, "llvm.cttz.i32", INT32, [value, ir.Constant(I1, 1)])
        return builder.zext(index, INT64)

    return types.int64(number), codegen


@intrinsic
def lane_of(typing, vector, lane):
    """Return one lane of a vector, by its index."""
    scalar = SCALAR[vector.kind]

    def codegen(context, builder, sig, args):
        index = context.cast(builder, args[1], sig.args[1], types.int32)
        return builder.extract_element(args[0], index)

    return scalar(vector, lane), codegen
