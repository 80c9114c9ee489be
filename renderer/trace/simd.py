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

import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.errors import TypingError
from numba.extending import intrinsic, lower_builtin, models, register_model, type_callable
from numba.np.arrayobj import make_array

LANES = 16

_I1, _I32, _I64 = ir.IntType(1), ir.IntType(32), ir.IntType(64)
_ELEMENT = {"f32": ir.FloatType(), "f64": ir.DoubleType(), "i32": _I32, "mask": _I1}
_SCALAR = {"f32": types.float32, "f64": types.float64, "i32": types.int32}
_KIND_OF = {types.float32: "f32", types.float64: "f64", types.int32: "i32"}


class VectorType(types.Type):
    """numba's type of a vector of 16 lanes. kind: 'f32', 'f64', 'i32' or 'mask' (truth values)."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        super().__init__(name=f"{kind}x{LANES}")

    @property
    def is_float(self) -> bool:
        return self.kind in ("f32", "f64")


F32, F64, I32, MASK = (VectorType(kind) for kind in ("f32", "f64", "i32", "mask"))
_VECTOR = {vector.kind: vector for vector in (F32, F64, I32, MASK)}


@register_model(VectorType)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, fe_type: VectorType) -> None:
        super().__init__(manager, fe_type, _llvm(fe_type.kind))


# How LLVM is spoken to.


def _llvm(kind: str, lanes: int = LANES) -> ir.VectorType:
    return ir.VectorType(_ELEMENT[kind], lanes)


def _undefined(type_: ir.Type) -> ir.Constant:
    return ir.Constant(type_, ir.Undefined)


def _shuffle(builder: Any, x: Any, y: Any, lanes: list[int]) -> Any:
    """The given lanes of x followed by y."""
    mask = ir.Constant(ir.VectorType(_I32, len(lanes)), lanes)
    return builder.shuffle_vector(x, y, mask)


def _splat(builder: Any, scalar: Any) -> Any:
    """A vector with `scalar` in each lane."""
    undefined = _undefined(ir.VectorType(scalar.type, LANES))
    first = builder.insert_element(undefined, scalar, ir.Constant(_I32, 0))
    return _shuffle(builder, first, undefined, [0] * LANES)


def _call(builder: Any, name: str, result: Any, arguments: list) -> Any:
    """Calls one of LLVM's own functions."""
    signature = ir.FunctionType(result, [argument.type for argument in arguments])
    function = cgutils.get_or_insert_function(builder.module, signature, name)
    return builder.call(function, arguments)


def _widened(context: Any, builder: Any, value: Any, fe_type: Any, kind: str) -> Any:
    """A vector as it is; a number cast to the lanes' type and repeated in each."""
    if isinstance(fe_type, VectorType):
        return value
    return _splat(builder, context.cast(builder, value, fe_type, _SCALAR[kind]))


def _address(context: Any, builder: Any, array_type: Any, array: Any) -> Any:
    """The address of an array's first element."""
    if isinstance(array_type, types.CPointer):
        return array
    return make_array(array_type)(context, builder, array).data


def _element(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """The address of array[index], the first two arguments."""
    index = context.cast(builder, args[1], sig.args[1], types.intp)
    kind = _array_kind(sig.args[0])
    address = _address(context, builder, sig.args[0], args[0])
    return builder.gep(address, [index], source_etype=_ELEMENT[kind])


def _kind(*fe_types: Any) -> str:
    """The kind of the vectors among the arguments, which must be one; numbers go with any."""
    kinds = {t.kind for t in fe_types if isinstance(t, VectorType)}
    numbers = all(isinstance(t, VectorType | types.Number) for t in fe_types)
    if len(kinds) != 1 or not numbers:
        raise TypingError(f"vectors of one kind are needed, not {fe_types}")
    return kinds.pop()


def _array_kind(array: Any) -> str:
    """The kind of vector that the elements of an array, or of a pointer's array, make."""
    if not isinstance(array, types.CPointer) and not (
        isinstance(array, types.Array) and array.ndim == 1 and array.layout == "C"
    ):
        raise TypingError(f"a pointer or a contiguous one-dimensional array is needed, not {array}")
    if array.dtype not in _KIND_OF:
        raise TypingError(f"no vectors of {array.dtype}")
    return _KIND_OF[array.dtype]


# Operators, of two vectors or of a vector and a number.


def _operator(function: Callable, emit: Callable, compares: bool = False) -> None:
    """Defines a binary operator; emit(builder, is_float, x, y) makes LLVM's instruction."""

    @type_callable(function)
    def _typing(context):  # type: ignore[no-untyped-def]
        def typer(x, y):  # type: ignore[no-untyped-def]
            vector = x if isinstance(x, VectorType) else y
            if isinstance(vector, VectorType) and all(
                t == vector or isinstance(t, types.Number) for t in (x, y)
            ):
                return MASK if compares else vector
            return None

        return typer

    def lower(context, builder, sig, args):  # type: ignore[no-untyped-def]
        kind = _kind(*sig.args)
        x, y = (_widened(context, builder, a, t, kind) for a, t in zip(args, sig.args, strict=True))
        return emit(builder, kind in ("f32", "f64"), x, y)

    for pair in (
        (VectorType, VectorType),
        (VectorType, types.Number),
        (types.Number, VectorType),
    ):
        lower_builtin(function, *pair)(lower)


_operator(operator.add, lambda b, is_float, x, y: (b.fadd if is_float else b.add)(x, y))
_operator(operator.sub, lambda b, is_float, x, y: (b.fsub if is_float else b.sub)(x, y))
_operator(operator.mul, lambda b, is_float, x, y: (b.fmul if is_float else b.mul)(x, y))
_operator(operator.truediv, lambda b, is_float, x, y: b.fdiv(x, y))
_operator(operator.and_, lambda b, is_float, x, y: b.and_(x, y))
_operator(operator.or_, lambda b, is_float, x, y: b.or_(x, y))
_operator(operator.xor, lambda b, is_float, x, y: b.xor(x, y))
_operator(operator.lshift, lambda b, is_float, x, y: b.shl(x, y))
_operator(operator.rshift, lambda b, is_float, x, y: b.ashr(x, y))


def _comparison(function: Callable, sign: str) -> None:
    """Ordered: false in a lane where an operand is NaN."""

    def emit(builder, is_float, x, y):  # type: ignore[no-untyped-def]
        return (builder.fcmp_ordered if is_float else builder.icmp_signed)(sign, x, y)

    _operator(function, emit, compares=True)


_comparison(operator.lt, "<")
_comparison(operator.le, "<=")
_comparison(operator.gt, ">")
_comparison(operator.ge, ">=")
_comparison(operator.eq, "==")
_comparison(operator.ne, "!=")


@type_callable(operator.neg)
def _type_neg(context):  # type: ignore[no-untyped-def]
    return lambda x: x if isinstance(x, VectorType) and x.is_float else None


@lower_builtin(operator.neg, VectorType)
def _lower_neg(context, builder, sig, args):  # type: ignore[no-untyped-def]
    return builder.fneg(args[0])


@type_callable(operator.invert)
def _type_invert(context):  # type: ignore[no-untyped-def]
    return lambda x: x if isinstance(x, VectorType) and not x.is_float else None


@lower_builtin(operator.invert, VectorType)
def _lower_invert(context, builder, sig, args):  # type: ignore[no-untyped-def]
    return builder.not_(args[0])


# Vectors from numbers and from memory. Indices are not checked.


@intrinsic
def splat(typing, x):  # type: ignore[no-untyped-def]
    """A vector with the float32, float64 or int32 number x in each lane."""
    if x not in _KIND_OF:
        raise TypingError(f"no vectors of {x}")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        return _splat(builder, args[0])

    return _VECTOR[_KIND_OF[x]](x), codegen


def _constant(values: list[float]) -> Any:
    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        return ir.Constant(_llvm("f32"), values)

    return F32(), codegen


@intrinsic
def lane_column(typing):  # type: ignore[no-untyped-def]
    """0 1 2 3 0 1 2 3 ...: the column of each lane in a square of 4 x 4."""
    return _constant([lane % 4 for lane in range(LANES)])


@intrinsic
def lane_row(typing):  # type: ignore[no-untyped-def]
    """0 0 0 0 1 1 1 1 ...: the row of each lane in a square of 4 x 4."""
    return _constant([lane // 4 for lane in range(LANES)])


@intrinsic
def pointer(typing, array):  # type: ignore[no-untyped-def]
    """The address of a contiguous array, which is indexed like the flat array.

    Inside kernels, arrays are handed on as pointers: an array is seven numbers and a count of
    references, which a function per stage makes slow to compile and to run. The kernel keeps the
    array itself alive.
    """
    if not isinstance(array, types.Array) or array.layout != "C":
        raise TypingError(f"a contiguous array is needed, not {array}")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        return make_array(sig.args[0])(context, builder, args[0]).data

    return types.CPointer(array.dtype)(array), codegen


@intrinsic
def load(typing, array, index):  # type: ignore[no-untyped-def]
    """array[index : index + 16]."""
    kind = _array_kind(array)

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        at = _element(context, builder, sig, args)
        at = builder.bitcast(at, _llvm(kind).as_pointer())
        value = builder.load(at, typ=_llvm(kind))
        value.align = 4
        return value

    return _VECTOR[kind](array, index), codegen


@intrinsic
def store(typing, array, index, vector):  # type: ignore[no-untyped-def]
    """array[index : index + 16] = vector."""
    if _array_kind(array) != vector.kind:
        raise TypingError(f"{vector} does not fit into {array}")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        at = _element(context, builder, sig, args)
        builder.store(args[2], builder.bitcast(at, args[2].type.as_pointer()), align=4)
        return context.get_dummy_value()

    return types.void(array, index, vector), codegen


@intrinsic
def gather(typing, array, index, mask):  # type: ignore[no-untyped-def]
    """array[index[lane]] in the lanes of the mask; 0 in the others, whose index may be any."""
    return _gather(_array_kind(array), array, index, mask)


def _gather(kind: str, array: Any, index: Any, mask: Any) -> Any:
    if kind == "f64" or index != I32 or mask != MASK:
        raise TypingError("gather takes 32-bit elements, an I32 and a MASK")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        wide, pointers = ir.VectorType(_I64, LANES), ir.VectorType(ir.PointerType(), LANES)
        data = _address(context, builder, sig.args[0], args[0])
        first = _splat(builder, builder.ptrtoint(data, _I64))
        offset = builder.shl(builder.sext(args[1], wide), ir.Constant(wide, [2] * LANES))
        address = builder.inttoptr(builder.add(first, offset), pointers)
        zero = ir.Constant(_llvm(kind), [0] * LANES)
        name = f"llvm.masked.gather.v{LANES}{kind}.v{LANES}p0"
        return _call(builder, name, zero.type, [address, ir.Constant(_I32, 4), args[2], zero])

    return _VECTOR[kind](array, index, mask), codegen


@intrinsic
def fetch(typing, array, index, mask):  # type: ignore[no-untyped-def]
    """A vector of array[index]: gathered for an I32 of indices, repeated for a number."""
    kind = _array_kind(array)
    if index == I32:
        return _gather(kind, array, index, mask)

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        at = _element(context, builder, sig, args)
        return _splat(builder, builder.load(at, typ=_ELEMENT[kind]))

    return _VECTOR[kind](array, index, mask), codegen


@intrinsic
def fetch_index(typing, array, index, mask):  # type: ignore[no-untyped-def]
    """array[index]: gathered for an I32 of indices, one int32 for a number."""
    if index == I32:
        return _gather(_array_kind(array), array, index, mask)

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        at = _element(context, builder, sig, args)
        return builder.load(at, typ=_I32)

    return types.int32(array, index, mask), codegen


@intrinsic
def prefetch(typing, array, index):  # type: ignore[no-untyped-def]
    """Asks for the cache line of array[index], which will be read soon; any index is allowed."""

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        at = _element(context, builder, sig, args)
        read, keep, data = (ir.Constant(_I32, value) for value in (0, 3, 1))
        _call(builder, "llvm.prefetch.p0", ir.VoidType(), [at, read, keep, data])
        return context.get_dummy_value()

    return types.void(array, index), codegen


# Squares of 4 x 4 pixels to images: row r of the square goes to array[index + r * stride].


def _store_rows(context: Any, builder: Any, sig: Any, args: Any, rows: list) -> Any:
    index, stride = (
        context.cast(builder, value, fe_type, types.intp)
        for value, fe_type in zip(args[1:3], sig.args[1:3], strict=True)
    )
    kind = _array_kind(sig.args[0])
    first = _address(context, builder, sig.args[0], args[0])
    for row in rows:
        at = builder.gep(first, [index], source_etype=_ELEMENT[kind])
        builder.store(row, builder.bitcast(at, row.type.as_pointer()), align=4)
        index = builder.add(index, stride)
    return context.get_dummy_value()


@intrinsic
def store_square(typing, array, index, stride, vector):  # type: ignore[no-untyped-def]
    """Stores a number a pixel."""
    if _array_kind(array) != vector.kind:
        raise TypingError(f"{vector} does not fit into {array}")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        undefined = _undefined(args[3].type)
        rows = [
            _shuffle(builder, args[3], undefined, [4 * row + column for column in range(4)])
            for row in range(4)
        ]
        return _store_rows(context, builder, sig, args, rows)

    return types.void(array, index, stride, vector), codegen


@intrinsic
def store_square3(typing, array, index, stride, x, y, z):  # type: ignore[no-untyped-def]
    """Stores three numbers a pixel, interleaved."""
    if _array_kind(array) != _kind(x, y, z):
        raise TypingError(f"{x} does not fit into {array}")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        both = list(range(2 * LANES))
        xy = _shuffle(builder, args[3], args[4], both)
        zz = _shuffle(builder, args[5], args[5], both)
        rows = [
            _shuffle(builder, xy, zz, [4 * row + c + LANES * k for c in range(4) for k in range(3)])
            for row in range(4)
        ]
        return _store_rows(context, builder, sig, args, rows)

    return types.void(array, index, stride, x, y, z), codegen


# Functions of vectors, lane by lane. Numbers may stand for vectors, but not for all of them.


def _function(name: str, count: int) -> Callable:
    """The typing function of an intrinsic that is LLVM's own function `name`."""

    def build(*fe_types: Any) -> Any:
        kind = _kind(*fe_types)
        vector = _VECTOR[kind]

        def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
            values = [
                _widened(context, builder, a, t, kind) for a, t in zip(args, sig.args, strict=True)
            ]
            return _call(builder, f"llvm.{name}.v{LANES}{kind}", _llvm(kind), values)

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


def _extreme(sign: str) -> Callable:
    """The smaller or larger of two; y where either is NaN. One instruction where there is one."""

    def build(typing, x, y):  # type: ignore[no-untyped-def]
        kind = _kind(x, y)

        def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
            x_, y_ = (
                _widened(context, builder, a, t, kind) for a, t in zip(args, sig.args, strict=True)
            )
            return builder.select(builder.fcmp_ordered(sign, x_, y_), x_, y_)

        return _VECTOR[kind](x, y), codegen

    return build


vmin = intrinsic(_extreme("<"))
vmax = intrinsic(_extreme(">"))


@intrinsic
def select(typing, mask, x, y):  # type: ignore[no-untyped-def]
    """x in the lanes of the mask, y in the others."""
    kind = _kind(x, y)

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        x_, y_ = (
            _widened(context, builder, a, t, kind)
            for a, t in zip(args[1:], sig.args[1:], strict=True)
        )
        return builder.select(args[0], x_, y_)

    return _VECTOR[kind](mask, x, y), codegen


def _conversion(source: VectorType, target: VectorType, instruction: str) -> Callable:
    def build(typing, x):  # type: ignore[no-untyped-def]
        if x != source:
            raise TypingError(f"{source} is needed, not {x}")

        def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
            return getattr(builder, instruction)(args[0], _llvm(target.kind))

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
def bits(typing, mask):  # type: ignore[no-untyped-def]
    """A mask as an int64: bit i is lane i."""
    if mask != MASK:
        raise TypingError(f"a mask is needed, not {mask}")

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        return builder.zext(builder.bitcast(args[0], ir.IntType(LANES)), _I64)

    return types.int64(mask), codegen


@intrinsic
def mask_of(typing, number):  # type: ignore[no-untyped-def]
    """The mask whose lane i is bit i of an integer."""

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        value = context.cast(builder, args[0], sig.args[0], types.int32)
        return builder.bitcast(builder.trunc(value, ir.IntType(LANES)), _llvm("mask"))

    return MASK(number), codegen


def _reduction(sign: str) -> Callable:
    def build(typing, x):  # type: ignore[no-untyped-def]
        def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
            # Fold the vector in halves until one lane is left.
            (value,), lanes = args, LANES
            while lanes > 1:
                lanes //= 2
                undefined = _undefined(value.type)
                low = _shuffle(builder, value, undefined, list(range(lanes)))
                high = _shuffle(builder, value, undefined, list(range(lanes, 2 * lanes)))
                value = builder.select(builder.fcmp_ordered(sign, low, high), low, high)
            return builder.extract_element(value, ir.Constant(_I32, 0))

        return _SCALAR[_kind(x)](x), codegen

    return build


smallest = intrinsic(_reduction("<"))
largest = intrinsic(_reduction(">"))


@intrinsic
def lowest_bit(typing, number):  # type: ignore[no-untyped-def]
    """The index, int64, of the lowest bit set in an integer whose low 32 bits are not 0."""

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        value = context.cast(builder, args[0], sig.args[0], types.int32)
        index = _call(builder, "llvm.cttz.i32", _I32, [value, ir.Constant(_I1, 1)])
        return builder.zext(index, _I64)

    return types.int64(number), codegen


@intrinsic
def lane_of(typing, vector, lane):  # type: ignore[no-untyped-def]
    """One lane of a vector, by its index."""
    scalar = _SCALAR[vector.kind]

    def codegen(context, builder, sig, args):  # type: ignore[no-untyped-def]
        index = context.cast(builder, args[1], sig.args[1], types.int32)
        return builder.extract_element(args[0], index)

    return scalar(vector, lane), codegen
