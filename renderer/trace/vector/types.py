"""numba types for vectors of 16 lanes, with their operators.

The types are F32, F64, I32 and MASK. This module also has the helpers that generate LLVM code for
them. lanes.py has their functions, and explains their purpose.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.errors import TypingError
from numba.extending import lower_builtin, models, register_model, type_callable

from lucida.renderer.trace.compile.emit import Value, target

LANES = 16
CPointer = types.CPointer  # type: ignore[attr-defined]

I1, INT32, INT64 = ir.IntType(1), ir.IntType(32), ir.IntType(64)
ELEMENT = {"f32": ir.FloatType(), "f64": ir.DoubleType(), "i32": INT32, "mask": I1}
SCALAR: dict[str, Any] = {"f32": types.float32, "f64": types.float64, "i32": types.int32}
KIND_OF = {types.float32: "f32", types.float64: "f64", types.int32: "i32"}


class VectorType(types.Type):
    """The numba type of a vector of 16 lanes. kind: 'f32', 'f64', 'i32' or 'mask' (truth
    values).
    """

    def __init__(self, kind: str) -> None:
        self.kind = kind
        super().__init__(name=f"{kind}x{LANES}")

    @property
    def is_float(self) -> bool:
        return self.kind in ("f32", "f64")


F32, F64, I32, MASK = (VectorType(kind) for kind in ("f32", "f64", "i32", "mask"))
VECTOR: dict[str, Any] = {vector.kind: vector for vector in (F32, F64, I32, MASK)}


@register_model(VectorType)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, fe_type: VectorType) -> None:
        super().__init__(manager, fe_type, llvm_vector(fe_type.kind))


# Helpers for LLVM.


def llvm_vector(kind: str, lanes: int = LANES) -> ir.VectorType:
    return ir.VectorType(ELEMENT[kind], lanes)


def undefined(type_: ir.Type) -> ir.Constant:
    return ir.Constant(type_, ir.Undefined)


def shuffled(builder: Any, x: Any, y: Any, lanes: list[int]) -> Any:
    """Return the given lanes of x followed by y."""
    mask = ir.Constant(ir.VectorType(INT32, len(lanes)), lanes)
    return builder.shuffle_vector(x, y, mask)


def repeated(builder: Any, scalar: Any) -> Any:
    """Return a vector with `scalar` in each lane."""
    nothing = undefined(ir.VectorType(scalar.type, LANES))
    first = builder.insert_element(nothing, scalar, ir.Constant(INT32, 0))
    return shuffled(builder, first, nothing, [0] * LANES)


def call_llvm(builder: Any, name: str, result: Any, arguments: list) -> Any:
    """Call one of LLVM's own functions."""
    signature = ir.FunctionType(result, [argument.type for argument in arguments])
    function = cgutils.get_or_insert_function(builder.module, signature, name)
    return builder.call(function, arguments)


def widened(context: Any, builder: Any, value: Any, fe_type: Any, kind: str) -> Any:
    """Return a vector unchanged; a number cast to the lanes' type and repeated in each lane."""
    if isinstance(fe_type, VectorType):
        return value
    return repeated(builder, context.cast(builder, value, fe_type, SCALAR[kind]))


def address_of(context: Any, builder: Any, array_type: Any, array: Any) -> Any:
    """Return the address of an array's first element."""
    if isinstance(array_type, CPointer):
        return array
    return cgutils.create_struct_proxy(array_type)(context, builder, value=array).data


def first_address(builder: Any, array: Value) -> Any:
    """Return the address of the first element of a Value's array."""
    return address_of(target().context, builder, array.kind, array.llvm)


def element_address(builder: Any, array: Value, index: Value) -> Any:
    """Return the address of array[index]."""
    at = target().context.cast(builder, index.llvm, index.kind, types.intp)
    element = ELEMENT[array_kind(array.kind)]
    return builder.gep(first_address(builder, array), [at], source_etype=element)


def common_kind(*fe_types: Any) -> str:
    """Return the kind of the vectors among the arguments, which must all be the same; numbers fit
    any.
    """
    kinds = {t.kind for t in fe_types if isinstance(t, VectorType)}
    numbers = all(isinstance(t, VectorType | types.Number) for t in fe_types)
    if len(kinds) != 1 or not numbers:
        raise TypingError(f"vectors of one kind are needed, not {fe_types}")
    return kinds.pop()


def array_kind(array: Any) -> str:
    """Return the kind of vector for the elements of an array, or of a pointer."""
    if not isinstance(array, CPointer) and not (
        isinstance(array, types.Array) and array.ndim == 1 and array.layout == "C"
    ):
        raise TypingError(f"a pointer or a contiguous one-dimensional array is needed, not {array}")
    if array.dtype not in KIND_OF:
        raise TypingError(f"no vectors of {array.dtype}")
    return KIND_OF[array.dtype]


# Operators, of two vectors or of a vector and a number.


def _operator(function: Callable, emit: Callable, compares: bool = False) -> None:
    """Define a binary operator; emit(builder, is_float, x, y) generates LLVM's instruction."""

    @type_callable(function)
    def _typing(context):
        def typer(x, y):
            vector = x if isinstance(x, VectorType) else y
            if isinstance(vector, VectorType) and all(
                t == vector or isinstance(t, types.Number) for t in (x, y)
            ):
                return MASK if compares else vector
            return None

        return typer

    def lower(context, builder, sig, args):
        kind = common_kind(*sig.args)
        x, y = (widened(context, builder, a, t, kind) for a, t in zip(args, sig.args, strict=True))
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
    """Define an ordered comparison: false in a lane where an operand is NaN."""

    def emit(builder, is_float, x, y):
        return (builder.fcmp_ordered if is_float else builder.icmp_signed)(sign, x, y)

    _operator(function, emit, compares=True)


_comparison(operator.lt, "<")
_comparison(operator.le, "<=")
_comparison(operator.gt, ">")
_comparison(operator.ge, ">=")
_comparison(operator.eq, "==")
_comparison(operator.ne, "!=")


@type_callable(operator.neg)
def _type_neg(context):
    return lambda x: x if isinstance(x, VectorType) and x.is_float else None


@lower_builtin(operator.neg, VectorType)
def _lower_neg(context, builder, sig, args):
    return builder.fneg(args[0])


@type_callable(operator.invert)
def _type_invert(context):
    return lambda x: x if isinstance(x, VectorType) and not x.is_float else None


@lower_builtin(operator.invert, VectorType)
def _lower_invert(context, builder, sig, args):
    return builder.not_(args[0])
