"""A call of a compiled function out of LLVM's code that is made by hand, without compiling it anew.

A part of numba_inside.py.
"""

from __future__ import annotations

from typing import Any

from numba.core.callconv import CPUCallConv
from numba.core.codegen import CodeLibrary
from numba.core.cpu import CPUContext
from numba.core.registry import CPUDispatcher

NEEDS = (
    (CPUDispatcher, ("get_compile_result",)),
    (CPUContext, ("active_code_library", "declare_function", "call_conv")),
    (CPUCallConv, ("call_function",)),
    (CodeLibrary, ("add_linking_library",)),
)


def call(context: Any, builder: Any, function: Any, signature: Any, arguments: Any) -> None:
    """Calls numba's function, a type of Dispatcher, with values of LLVM's; it has no result."""
    compiled = function.dispatcher.get_compile_result(signature)
    context.active_code_library.add_linking_library(compiled.library)
    callee = context.declare_function(builder.module, compiled.fndesc)
    context.call_conv.call_function(
        builder, callee, signature.return_type, signature.args, arguments
    )
