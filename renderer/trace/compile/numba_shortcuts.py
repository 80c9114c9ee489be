"""Shortcuts through numba's compiler, for a process that does nothing but compile.

A part of numba_inside.py.

numba keeps the time that its parts take, by events at each call of LLVM's and each step of its own;
remembers at each instruction what to say if that is wrong; looks for new declarations before each
function; tries all that an operator can mean again for each use of it; looks at a function's
parameters each time that it is to make code of it, and for variables in everything that an
instruction holds. That is a third of the time that kernels take to compile, and the machine code is
the same without.
"""

from __future__ import annotations

import functools
import types
from typing import Any

import llvmlite.binding as llvm
import numba.core.base
from numba.core import analysis, compiler_machinery, errors, ir, lowering, typeinfer
from numba.core.base import BaseContext
from numba.core.compiler_machinery import PassManager
from numba.core.types.functions import BaseFunction
from numba.core.typing.context import BaseContext as TypingContext
from numba.core.typing.templates import _OverloadFunctionTemplate

NEEDS = (
    (llvm.ffi.lib._lock, ("_cblist",)),
    (numba.core.base, ("_has_loc",)),
    (analysis, ("_use_defs_result", "compute_use_defs", "ir_extension_usedefs")),
    (compiler_machinery, ("errors",)),
    (errors, ("new_error_context",)),
    (ir.Inst, ("_rec_list_vars", "list_vars")),
    (lowering, ("compute_use_defs", "new_error_context")),
    (typeinfer, ("new_error_context",)),
    (BaseContext, ("_registries", "refresh")),
    (BaseFunction, ("_impl_keys", "get_call_type", "templates", "typing_key")),
    (PassManager, ("_ENFORCING", "_analysis", "_runPass")),
    (TypingContext, ("_registries", "refresh")),
)


def take_shortcuts() -> None:
    """Changes numba, for the rest of this process."""
    llvm.ffi.lib._lock._cblist.clear()
    numba.core.base._has_loc = functools.cache(numba.core.base._has_loc)
    ir.Inst._rec_list_vars = _variables_in
    BaseFunction.get_call_type = _remembering(BaseFunction.get_call_type)  # type: ignore[method-assign]
    for context in (BaseContext, TypingContext):
        context.refresh = _refreshing(context.refresh)
    modules: tuple[Any, ...] = (errors, lowering, typeinfer)
    for module in modules:
        module.new_error_context = functools.wraps(module.new_error_context)(_no_context)
    modules = analysis, lowering
    for module in modules:
        module.compute_use_defs = functools.wraps(module.compute_use_defs)(_uses_and_definitions)
    if not PassManager._ENFORCING:
        PassManager._runPass = functools.wraps(PassManager._runPass)(_run_pass)


class _NoContext:
    """What an error is put into: nothing. Nobody reads a compiling process' errors."""

    def __enter__(self) -> None: ...
    def __exit__(self, *error: object) -> None: ...


_nothing = _NoContext()


def _no_context(*_: object, **__: object) -> _NoContext:
    return _nothing


def _run_pass(self: Any, index: int, step: Any, state: Any) -> None:
    """One step of a compilation."""
    step.analysis = self._analysis
    step.run_initialization(state)
    step.run_pass(state)
    step.run_finalizer(state)


def _refreshing(refresh: Any) -> Any:
    """The method that takes over new declarations, called only where there are any."""
    known: dict[int, int] = {}

    @functools.wraps(refresh)
    def refreshing(self: Any) -> None:
        if known.get(id(self)) != _declarations(self):
            refresh(self)
            known[id(self)] = _declarations(self)

    return refreshing


def _declarations(context: Any) -> int:
    """How many there are in what a context takes them from: lists, which only grow."""
    return sum(len(each) for registry in context._registries for each in vars(registry).values())


def _uses_and_definitions(blocks: dict) -> Any:
    """The variables that each block uses before it sets them, and those that it sets."""
    used: dict[int, set[str]] = {}
    defined: dict[int, set[str]] = {}
    for number, block in blocks.items():
        uses: set[str] = set()
        defines: set[str] = set()
        used[number], defined[number] = uses, defines
        for statement in block.body:
            if type(statement) in analysis.ir_extension_usedefs:
                analysis.ir_extension_usedefs[type(statement)](statement, uses, defines)
                continue
            if not isinstance(statement, ir.Assign):
                names = {variable.name for variable in statement.list_vars()}
            else:
                names = {variable.name for variable in _variables_in(statement, statement.value)}
                if statement.target.name not in names:
                    defines.add(statement.target.name)
            uses |= names - defines
    return analysis._use_defs_result(used, defined)


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
