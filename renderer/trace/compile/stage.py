"""A kernel's stage that is compiled on its own: called by its address, with what it always needs.
And a part that is compiled with its kernel, but called, not inlined.

Owns how such a stage is handed to the kernel that calls it. Knows nothing of what either does.

A kernel and its parts are compiled as one piece, by one processor. Where a kernel calls a large
part once for many rays, the two may as well be compiled apart, at once: the part, with all that is
the same for the whole image, becomes StagedCode, two addresses, and the kernel needs neither its
code nor the types of what it takes. A call costs some nanoseconds.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.core.errors import TypingError
from numba.extending import intrinsic
from numpy.typing import NDArray

ROOM_BYTES = 4096  # for what a stage always needs

CPointer = types.CPointer  # type: ignore[attr-defined]

# Arguments of each call: row and column of the image, and a thread's scratch memory.
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
    """code: the address. room: what the code always needs; whatever that points to must be kept."""

    code: int
    room: NDArray[np.uint8]


def new_room() -> NDArray[np.uint8]:
    """Memory for prepared() to fill."""
    return np.empty(ROOM_BYTES, np.uint8)


@intrinsic
def prepared(typing, function, always, room):
    """Fills a room with `always`; gives the address of code that calls function(always, row,
    column, floats, ints), int64.

    function: decorated by inlined(); without a result, and it raises nothing.
    """
    if not isinstance(function, types.Dispatcher):
        raise TypingError(f"a compiled function is needed, not {function}")
    signature = function.get_call_type(typing, (always, *_EACH), {})

    def codegen(context, builder, sig, args):
        always_type = context.get_value_type(sig.args[1])
        if context.get_abi_sizeof(always_type) > ROOM_BYTES:
            raise TypingError(f"{sig.args[1]} has no room in {ROOM_BYTES} bytes")
        builder.store(args[1], builder.bitcast(args[2], always_type.as_pointer()))
        code = _code(context, builder.module, function, signature, always_type)
        return builder.ptrtoint(code, ir.IntType(64))

    return types.int64(function, always, room), codegen


def _code(context, module, function, signature, always_type):
    """A function of type _CODE, which calls numba's."""

    def arguments(builder, own):
        at = builder.bitcast(own[0], always_type.as_pointer())
        return [builder.load(at, typ=always_type), *own[1:]]

    return _calling(context, module, function, signature, _CODE, arguments)


def _calling(context, module, function, signature, code_type, arguments):
    """A function of LLVM's, which calls numba's with arguments(builder, its own)."""
    code = ir.Function(module, code_type, module.get_unique_name("lucida_stage"))
    code.linkage = "internal"
    builder = ir.IRBuilder(code.append_basic_block())
    values = arguments(builder, code.args)
    compiled = context.compile_subroutine(builder, function.dispatcher.py_func, signature)
    context.call_internal_no_propagate(builder, compiled.fndesc, signature, values)
    builder.ret_void()
    return code


@intrinsic
def call_stage(typing, code, room, row, column, floats, ints):
    """Calls a stage's code, by its address; room: the pointer to its memory."""
    signature = types.void(types.int64, CPointer(types.uint8), *_EACH)

    def codegen(context, builder, sig, args):
        builder.call(builder.inttoptr(args[0], _CODE.as_pointer()), args[1:])
        return context.get_dummy_value()

    return signature, codegen


@intrinsic
def call_apart(typing, function, arguments):
    """function(*arguments), called and not inlined: for what is rarely needed, and would take
    registers from what always is.

    function: decorated by inlined(); without a result, and it raises nothing.
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
