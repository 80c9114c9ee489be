"""Functions that Python runs while a kernel is compiled, to emit LLVM's instructions.

numba takes about a millisecond for each statement, but none for a function decorated by emitted().
At each call in a kernel, Python calls it with Values, whose operators emit instructions on the
spot. Such a function has no runtime branches or loops. A condition must be known from the types,
like `lens is None`, or use choose(). It may call other emitted functions, but none of numba's.
"""

from __future__ import annotations

import inspect
import operator
from collections.abc import Callable
from functools import cache, partial, wraps
from typing import Any, NamedTuple

from numba.core import types
from numba.core.errors import TypingError
from numba.extending import lower_builtin, type_callable

BaseTuple = types.BaseTuple  # type: ignore[attr-defined]


class _Target(NamedTuple):
    """numba's contexts, and LLVM's builder; without the last two, only types are determined."""

    typing: Any
    context: Any = None
    builder: Any = None


_targets: list[_Target] = []  # innermost last; numba compiles one function at a time


def target() -> _Target:
    """Return the target into which the running function emits."""
    return _targets[-1]


class Value:
    """A value of the kernel. kind: its numba type. llvm: its LLVM value.

    A tuple has its elements and fields; a pointer is indexed; numbers and vectors have operators.
    """

    __array_ufunc__ = None  # NumPy's numbers defer to this class's operators
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, kind: Any, llvm: Any) -> None:
        self.kind, self.llvm = kind, llvm

    def __getattr__(self, name: str) -> Any:
        fields = getattr(self.kind, "fields", ())
        if name not in fields:
            raise AttributeError(f"{self.kind} has no {name}")
        return self[fields.index(name)]

    def __iter__(self) -> Any:
        return (self[index] for index in range(len(self.kind)))

    def __getitem__(self, index: Any) -> Any:
        if not isinstance(self.kind, BaseTuple):
            return call(operator.getitem, self, index)
        return new(self.kind[index], lambda builder: builder.extract_value(self.llvm, index))

    def __setitem__(self, index: Any, value: Any) -> None:
        call(operator.setitem, self, index, value)

    def __abs__(self) -> Any:
        return call(abs, self)

    def __bool__(self) -> bool:
        raise TypingError(f"a branch on {self.kind}: use choose()")


def _define_operator(name: str) -> None:
    function = getattr(operator, name)
    setattr(Value, name, lambda *values: call(function, *values))
    setattr(Value, name.replace("__", "__r", 1), lambda right, left: call(function, left, right))


for _name in (
    *("__add__", "__sub__", "__mul__", "__truediv__", "__floordiv__", "__mod__", "__neg__"),
    *("__and__", "__or__", "__xor__", "__invert__", "__lshift__", "__rshift__"),
    *("__lt__", "__le__", "__gt__", "__ge__", "__eq__", "__ne__"),
):
    _define_operator(_name)


def new(kind: Any, emit: Callable[[Any], Any]) -> Any:
    """Return the Value of this numba type that emit(builder) emits; None for type none."""
    builder = target().builder
    llvm = None if builder is None else emit(builder)
    return None if kind == types.none else Value(kind, llvm)


def value_of(x: Any) -> Value:
    """Return the Value of a constant, or of a tuple of Values."""
    if isinstance(x, Value):
        return x
    typing, context, builder = target()
    parts: list[Value] = []
    if isinstance(x, tuple):
        parts = [value_of(part) for part in x]
        cls = type(x) if hasattr(x, "_fields") else None
        kind = BaseTuple.from_types([part.kind for part in parts], cls)
    else:
        kind = typing.resolve_value_type(x)
    if builder is None:
        return Value(kind, None)
    if parts:
        return Value(kind, context.make_tuple(builder, kind, [part.llvm for part in parts]))
    return Value(kind, context.get_constant_generic(builder, kind, x))


def with_fields(data: Value, **changes: Any) -> Any:
    """Return a NamedTuple with some of its fields replaced."""
    fields = {name: getattr(data, name) for name in data.kind.fields}
    return data.kind.instance_class(**fields | changes)


@cache
def _signature(typing: Any, function: Any, kinds: tuple[Any, ...]) -> Any:
    signature = typing.resolve_function_type(function, kinds, {})
    if signature is None:
        raise TypingError(f"no {function} of {kinds}")
    return signature


def call(function: Any, *arguments: Any) -> Any:
    """Call a function or operator that numba knows. Return its result."""
    typing, context, _ = target()
    values = [value_of(argument) for argument in arguments]
    signature = _signature(typing, function, tuple(value.kind for value in values))

    def emit(builder):
        code = context.get_function(typing.resolve_value_type(function), signature)
        pairs = zip(values, signature.args, strict=True)
        return code(builder, [context.cast(builder, v.llvm, v.kind, kind) for v, kind in pairs])

    return new(signature.return_type, emit)


def converted(kind: Any, x: Any) -> Any:
    """Return a number as another numba type."""
    x, context = value_of(x), target().context
    return new(kind, lambda builder: context.cast(builder, x.llvm, x.kind, kind))


f32, f64 = partial(converted, types.float32), partial(converted, types.float64)
i32, i64 = partial(converted, types.int32), partial(converted, types.int64)


def choose(condition: Any, then: Callable[[], Any], otherwise: Callable[[], Any]) -> Any:
    """Return then() if the condition holds, else otherwise(). Their results have the same types."""
    if not isinstance(condition, Value):
        return then() if condition else otherwise()
    builder = target().builder
    if builder is None:
        return then()
    with builder.if_else(condition.llvm) as branches:
        results, blocks = [], []
        for branch, function in zip(branches, (then, otherwise), strict=True):
            with branch:
                results.append(_parts(function()))
                blocks.append(builder.block)
    return _joined(builder, blocks, *results)


def _parts(x: Any) -> Any:
    """Return a result as tuples of single Values, so that LLVM need not join tuples."""
    is_tuple = isinstance(x, tuple) or (isinstance(x, Value) and isinstance(x.kind, BaseTuple))
    return tuple(map(_parts, x)) if is_tuple else value_of(x)


def _joined(builder: Any, blocks: list, a: Any, b: Any) -> Any:
    if isinstance(a, tuple):
        return tuple(_joined(builder, blocks, *pair) for pair in zip(a, b, strict=True))
    if a.kind == types.none:
        return None
    joined = builder.phi(a.llvm.type)
    joined.add_incoming(a.llvm, blocks[0])
    joined.add_incoming(b.llvm, blocks[1])
    return Value(a.kind, joined)


def defined(function: Any, kind_of: Any, lower: Any) -> Any:
    """Define for numba the type of a function's calls, kind_of(typing context, arguments' types),
    and their code.
    """
    signature = inspect.signature(function)

    def typer_of(typing: Any) -> Any:
        def typer(*kinds):
            return kind_of(typing, kinds)

        typer.__signature__ = signature  # type: ignore[attr-defined]
        return typer

    type_callable(function)(typer_of)
    lower_builtin(function, types.VarArg(types.Any))(lower)  # type: ignore[attr-defined]
    return function


def emitted(function: Any) -> Any:
    """Decorate a function that kernels, and other emitted functions, call (see the module)."""

    def run(target: _Target, kinds: tuple[Any, ...], values: list) -> Value:
        _targets.append(target)
        try:
            pairs = zip(kinds, values, strict=True)
            return value_of(function(*(None if k == types.none else Value(k, v) for k, v in pairs)))
        finally:
            _targets.pop()

    @cache
    def kind_of(typing: Any, kinds: tuple[Any, ...]) -> Any:
        return run(_Target(typing), kinds, [None] * len(kinds)).kind

    def lower(context, builder, sig, args):
        target = _Target(context.typing_context, context, builder)
        result = run(target, sig.args, args)
        return context.cast(builder, result.llvm, result.kind, sig.return_type)

    return defined(function, kind_of, lower)


@emitted
def lesser(a, b):
    """Return the lesser of two numbers of one type."""
    return choose(a < b, lambda: a, lambda: b)


@emitted
def greater(a, b):
    """Return the greater of two numbers of one type."""
    return choose(a > b, lambda: a, lambda: b)


def instruction(define: Any) -> Any:
    """Decorate a function of Values that returns the result's numba type, and emit(builder)."""

    @emitted
    @wraps(define)
    def function(*arguments):
        return new(*define(*map(value_of, arguments)))

    return function
