"""Explicit SIMD inside kernels: vectors of 16 lanes, one for each pixel, triangle or box.

numba has no vector types, but LLVM below it has. This module adds four types to numba (F32, F64,
I32 and MASK, 16 lanes each), their operators, and the functions below, so that a kernel can write
`fma(ex, x, fma(ey, y, e1)) >= 0` for 16 pixels at once. LLVM maps a vector to one AVX-512
register, to two of AVX or to four of SSE or NEON, because only its generic operations are used, and
no processor-specific intrinsics.

There are no fast-math flags, because watertight intersection relies on the order of operations.
Only fma() is fused, and only on processors that support it.

Kernels refer to these functions at module level, so that they can be cached.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError

from lucida.renderer.trace.compile.emit import i32, instruction, target

from .types import (
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


@instruction
def splat(x):
    """Return a vector with the float32, float64 or int32 number x in each lane."""
    if x.kind not in KIND_OF:
        raise TypingError(f"no vectors of {x.kind}")
    return VECTOR[KIND_OF[x.kind]], lambda builder: repeated(builder, x.llvm)


def _constant(values: list[float]) -> Any:
    return F32, lambda builder: ir.Constant(llvm_vector("f32"), values)


@instruction
def lane_column():
    """Return 0 1 2 3 0 1 2 3 ...: the column of each lane in a square of 4 x 4."""
    return _constant([lane % 4 for lane in range(LANES)])


@instruction
def lane_row():
    """Return 0 0 0 0 1 1 1 1 ...: the row of each lane in a square of 4 x 4."""
    return _constant([lane // 4 for lane in range(LANES)])


# Functions of vectors, lane by lane. Numbers are accepted for some vectors, but not for all.


def _of_vectors(emit: Callable, *values: Any) -> Any:
    """Return emit(builder, *vectors), after converting numbers to vectors; and its type."""
    kind = common_kind(*(value.kind for value in values))

    def emit_widened(builder):
        context = target().context
        return emit(builder, *(widened(context, builder, v.llvm, v.kind, kind) for v in values))

    return VECTOR[kind], emit_widened


def _function(name: str, *values: Any) -> Any:
    """Return the call of LLVM's function `name`."""

    def emit(builder, *vectors):
        kind = common_kind(*(value.kind for value in values))
        return call_llvm(builder, f"llvm.{name}.v{LANES}{kind}", vectors[0].type, list(vectors))

    return _of_vectors(emit, *values)


@instruction
def fma(x, y, z):
    """Return x * y + z, with one rounding if the processor supports it, otherwise with two.

    It is consistent in all code: fma(-x, y, -z) is exactly -fma(x, y, z) in either case.
    """
    return _function("fmuladd", x, y, z)


vabs = instruction(lambda x: _function("fabs", x))
vsqrt = instruction(lambda x: _function("sqrt", x))
vfloor = instruction(lambda x: _function("floor", x))


@instruction
def inverse_root(x):
    """Return 1 / sqrt(x) for x > 0, normal; relative error below 4e-7. NaN or inf for 0.

    Uses the processor's estimate and one step of Newton's method, if there is an estimate: a square
    root and a division take several times as long.
    """

    def emit(builder):
        flags = ("afn", "arcp", "contract", "reassoc")
        root = call_llvm(builder, f"llvm.sqrt.v{LANES}f32", x.llvm.type, [x.llvm])
        root.fastmath.update(flags)
        one = ir.Constant(x.llvm.type, [1.0] * LANES)
        return builder.fdiv(one, root, flags=flags)

    return F32, emit


def _extreme(sign: str, x: Any, y: Any) -> Any:
    """Return the code of the minimum or maximum; y if either is NaN. It is a single
    instruction on processors that have one.
    """
    return _of_vectors(lambda b, x, y: b.select(b.fcmp_ordered(sign, x, y), x, y), x, y)


vmin = instruction(lambda x, y: _extreme("<", x, y))
vmax = instruction(lambda x, y: _extreme(">", x, y))


@instruction
def larger(x, y):
    """Return vmax() of two F32 without NaN.

    If vmax() updates a vector in memory, LLVM stores single lanes, which are slow to load again.
    This function avoids that.
    """

    def emit(builder):
        vector = llvm_vector("f32")
        largest = call_llvm(builder, f"llvm.maxnum.v{LANES}f32", vector, [x.llvm, y.llvm])
        largest.fastmath.update(("nnan", "nsz"))
        return largest

    return F32, emit


@instruction
def select(mask, x, y):
    """Return x in the lanes of the mask, y in the others."""
    return _of_vectors(lambda builder, x, y: builder.select(mask.llvm, x, y), x, y)


def _conversion(target: VectorType, name: str) -> Any:
    def define(x):
        return target, lambda builder: getattr(builder, name)(x.llvm, llvm_vector(target.kind))

    return instruction(define)


@instruction
def to_f64(x):
    """Return an F32 as an F64; an F64 unchanged."""
    wide = llvm_vector("f64")
    return F64, lambda builder: builder.fpext(x.llvm, wide) if x.kind == F32 else x.llvm


to_f32 = _conversion(F32, "fptrunc")
i32_of = _conversion(I32, "fptosi")  # rounds towards 0; the value must fit
f32_of = _conversion(F32, "sitofp")
f64_of = _conversion(F64, "sitofp")
bits_of_f32 = _conversion(I32, "bitcast")
f32_of_bits = _conversion(F32, "bitcast")


# From vectors to numbers.


@instruction
def bits(mask):
    """Return a mask as an int64: bit i is lane i."""
    narrow = ir.IntType(LANES)
    return types.int64, lambda builder: builder.zext(builder.bitcast(mask.llvm, narrow), INT64)


@instruction
def mask_of(number):
    """Return the mask whose lane i is bit i of an integer."""
    number, narrow = i32(number), ir.IntType(LANES)
    mask = llvm_vector("mask")
    return MASK, lambda builder: builder.bitcast(builder.trunc(number.llvm, narrow), mask)


def _permutation(lanes: list[int]) -> Any:
    def define(x):
        return x.kind, lambda builder: shuffled(builder, x.llvm, undefined(x.llvm.type), lanes)

    return instruction(define)


# Permutations that swap the quarters of each half, reorder each quarter to 1 2 0 3, and repeat the
# first, or the last, lane of each quarter.
quarters_swapped = _permutation([lane ^ 4 for lane in range(LANES)])
next_of_three = _permutation([lane + (1, 1, -2, 0)[lane % 4] for lane in range(LANES)])
first_of_four = _permutation([lane & ~3 for lane in range(LANES)])
last_of_four = _permutation([lane | 3 for lane in range(LANES)])


@instruction
def lower_halves(x, y):
    """Return lanes 0 to 7 of x, then lanes 0 to 7 of y."""
    lanes = [lane + (LANES // 2) * (lane >= LANES // 2) for lane in range(LANES)]
    return x.kind, lambda builder: shuffled(builder, x.llvm, y.llvm, lanes)


@instruction
def smallest(x):
    """Return the least of a vector's lanes."""

    def emit(builder):
        # Fold the vector in half until one lane is left.
        value, lanes = x.llvm, LANES
        while lanes > 1:
            lanes //= 2
            nothing = undefined(value.type)
            low = shuffled(builder, value, nothing, list(range(lanes)))
            high = shuffled(builder, value, nothing, list(range(lanes, 2 * lanes)))
            value = builder.select(builder.fcmp_ordered("<", low, high), low, high)
        return builder.extract_element(value, ir.Constant(INT32, 0))

    return SCALAR[x.kind.kind], emit


@instruction
def lowest_bit(number):
    """Return the index, int64, of the lowest bit set in an integer whose low 32 bits are not 0."""
    number, never_0 = i32(number), ir.Constant(I1, 1)

    def emit(builder):
        index = call_llvm(builder, "llvm.cttz.i32", INT32, [number.llvm, never_0])
        return builder.zext(index, INT64)

    return types.int64, emit


@instruction
def lane_of(vector, lane):
    """Return one lane of a vector, by its index."""
    lane = i32(lane)
    return SCALAR[vector.kind.kind], lambda builder: builder.extract_element(vector.llvm, lane.llvm)
