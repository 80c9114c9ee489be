"""Stages of a kernel that are compiled separately and called by address with constant arguments.

This module also calls parts that are compiled with their kernel, but not inlined. A kernel and its
parts are compiled as a whole, on one processor. If a kernel calls a large part once for many rays,
the two can be compiled separately, at the same time. The part, with all arguments that are constant
for the image, becomes StagedCode, two addresses. The kernel needs neither its code nor the types of
those arguments. A call costs some nanoseconds.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError
from numba.extending import intrinsic
from numpy.typing import NDArray

ROOM_BYTES = 4096  # for a stage's constant arguments

CPointer = types.CPointer  # type: ignore[attr-defined]

# Each call's arguments: row and column of the image, and a thread's scratch memory.
_EACH = (types.int64, types.int64, CPointer(types.float32), CPointer(types.int32))
_BYTES = ir.IntType(8).as_pointer()
_CODE = ir.FunctionType(
    ir.VoidType(),
    [
        _BYTES,
        ir.IntType(64),
        ir.IntType(64),
        ir.FloatType().as_pointer(),
        ir.IntType(32).as_pointer(),
    ],
)


class StagedCode(NamedTuple):
    """A compiled stage.

    code: the address. room: its constant arguments; everything that they point to must be kept
    alive.
    """

    code: int
    room: NDArray[np.uint8]


def new_room() -> NDArray[np.uint8]:
    """Return memory for prepared() to fill."""
    return np.empty(ROOM_BYTES, np.uint8)


@intrinsic
def prepared(typing, function, always, room):
    """Store `always` in a room. Return the address, int64, of code that calls function(always, row,
    column, floats, ints).

    function: decorated by inlined(); it returns nothing and raises nothing.
    """
    signature = function.get_call_type(typing, (always, *_EACH), {})

    def codegen(context, builder, sig, args):
        always_type = context.get_value_type(sig.args[1])
        if context.get_abi_sizeof(always_type) > ROOM_BYTES:
            raise TypingError(f"{sig.args[1]} has no room in {ROOM_BYTES} bytes")
        builder.store(args[1], builder.bitcast(args[2], always_type.as_pointer()))

        def arguments(builder, own):
            at = builder.bitcast(own[0], always_type.as_pointer())
            return [builder.load(at, typ=always_type), *own[1:]]

        code = _calling(context, builder.module, function, signature, _CODE, arguments)
        return builder.ptrtoint(code, ir.IntType(64))

    return types.int64(function, always, room), codegen


def _calling(context, module, function, signature, code_type, arguments):
    """Return an LLVM function that calls a part with arguments(builder, its own)."""
    code = ir.Function(module, code_type, module.get_unique_name("lucida_stage"))
    code.linkage = "internal"
    builder = ir.IRBuilder(code.append_basic_block())
    values = arguments(builder, code.args)
    context.get_function(function, signature)(builder, values)
    builder.ret_void()
    return code


@intrinsic
def call_stage(typing, code, room, row, column, floats, ints):
    """Call a stage's code by its address. room: the pointer to its memory."""
    signature = types.void(types.int64, CPointer(types.uint8), *_EACH)

    def codegen(context, builder, sig, args):
        builder.call(builder.inttoptr(args[0], _CODE.as_pointer()), args[1:])
        return context.get_dummy_value()

    return signature, codegen


@intrinsic
def call_apart(typing, function, arguments):
    """Call function(*arguments) without inlining it, for rarely needed code that would take
    registers from the usual path.

    function: decorated by inlined(); it returns nothing and raises nothing.
    """
    signature = function.get_call_type(typing, tuple(arguments), {})

    def codegen(context, builder, sig, args):
        values = [builder.extract_value(args[1], k) for k in range(len(signature.args))]
        code_type = ir.FunctionType(ir.VoidType(), [value.type for value in values])
        code = _calling(context, builder.module, function, signature, code_type, lambda _, own: own)
        code.attributes.add("noinline")
        code.attributes.add("cold")
        builder.call(code, values)
        return context.get_dummy_value()

    return types.void(function, arguments), codegen
