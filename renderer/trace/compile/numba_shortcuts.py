"""Shortcuts through numba's compiler, for a process that does nothing but compile.

A part of numba_inside.py.

numba keeps the time that its parts take, by events at each call of LLVM's; tries all that an
operator can mean again for each use of it; looks at a function's parameters each time that it is
to make code of it, and for variables in everything that an instruction holds. That is a quarter of
the time that kernels take to compile, and the machine code is the same without.
"""

from __future__ import annotations

import functools
import types
from typing import Any

import llvmlite.binding as llvm
import numba.core.base
from numba.core import ir
from numba.core.types.functions import BaseFunction
from numba.core.typing.templates import _OverloadFunctionTemplate

NEEDS = (
    (llvm.ffi.lib._lock, ("_cblist",)),
    (numba.core.base, ("_has_loc",)),
    (ir.Inst, ("_rec_list_vars", "list_vars")),
    (BaseFunction, ("_impl_keys", "get_call_type", "templates", "typing_key")),
)


def take_shortcuts() -> None:
    """Changes numba, for the rest of this process."""
    llvm.ffi.lib._lock._cblist.clear()
    numba.core.base._has_loc = functools.cache(numba.core.base._has_loc)
    ir.Inst._rec_list_vars = _variables_in
    BaseFunction.get_call_type = _remembering(BaseFunction.get_call_type)  # type: ignore[method-assign]


# What most of an instruction's members are, that hold no variables.
_PLAIN = frozenset(
    (ir.Loc, ir.Scope, str, int, bool, type(None), types.FunctionType, types.BuiltinFunctionType)
)


def _variables_in(instruction: Any, value: Any) -> list:
    """The variables in a value that an instruction holds."""
    if isinstance(value, ir.Var):
        return [value]
    if isinstance(value, ir.Inst):
        return value.list_vars()
    if isinstance(value, dict):
        value = value.values()
    elif not isinstance(value, list | tuple):
        return []
    found: list = []
    for member in value:
        kind = type(member)
        if kind is ir.Var:
            found.append(member)
        elif kind not in _PLAIN:
            found += _variables_in(instruction, member)
    return found


def _remembering(get_call_type: Any) -> Any:
    """The method that gives a function's signature for types of arguments, asked once for each.

    Not what is written in Python itself (an overload, of numba's): that is compiled anew for each
    set of compiler's options.
    """
    known: dict[tuple, Any] = {}

    @functools.wraps(get_call_type)
    def remembering(self: Any, context: Any, args: tuple, kws: dict) -> Any:
        key = self, args, tuple(kws.items())
        signature = known.get(key)
        if signature is None:
            signature = get_call_type(self, context, args, kws)
            is_builtin = self._impl_keys[signature.args] is self.typing_key
            if is_builtin or not any(
                issubclass(template, _OverloadFunctionTemplate) for template in self.templates
            ):
                known[key] = signature
        return signature

    return remembering
