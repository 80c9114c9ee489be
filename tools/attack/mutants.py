"""Single changes of a function's code, such as a wrong bound or sign, for mutations.py to try.

A mutant changes one node of the syntax tree: a comparison, an arithmetic or boolean operator, a
condition, a number, a statement, or the order of two arguments. Types, documentation and the words
of errors stay as they are.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import CodeType
from typing import Any

COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
ARITHMETIC: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
}
Function = ast.FunctionDef | ast.AsyncFunctionDef
Place = ast.Name | ast.Attribute | ast.Subscript
SMALL = 1e-4  # numbers below are tolerances, chosen by eye


@dataclass(frozen=True)
class Mutant:
    """One change of a module's code.

    node and change count the tree's nodes in the order of ast.walk(), and the changes of that
    node. function is the qualified name of the outermost function around it.
    """

    module: str
    node: int
    change: int
    function: str
    line: int
    text: str


def mutants(root: Path, module: str) -> list[Mutant]:
    """Return all mutants of a module's functions."""
    source = (root / module).read_text("utf-8")
    lines, tree = source.splitlines(), ast.parse(source)
    owners = {
        node: name
        for name, function in _functions(tree)
        for statement in function.body
        for node in ast.walk(statement)
    }
    skipped = _skipped(tree)
    found = []
    for number, node in enumerate(ast.walk(tree)):
        if node in owners and node not in skipped:
            line = node.target.lineno if isinstance(node, ast.comprehension) else _line(node)
            for change, (name, _) in enumerate(_changes(node)):
                text = f"{module}:{line} {owners[node]}: {lines[line - 1].strip()} | {name}"
                found.append(Mutant(module, number, change, owners[node], line, text))
    return found


def compiled(root: Path, mutant: Mutant) -> CodeType:
    """Compile the module with the change of a mutant."""
    tree = ast.parse((root / mutant.module).read_text("utf-8"))
    node = next(node for k, node in enumerate(ast.walk(tree)) if k == mutant.node)
    list(_changes(node))[mutant.change][1]()
    ast.fix_missing_locations(tree)
    return compile(tree, str(root / mutant.module), "exec", dont_inherit=True)


def spans(root: Path, module: str) -> dict[str, range]:
    """Return the lines of each outermost function, decorators included."""
    return {
        name: range(
            min([function.lineno, *(part.lineno for part in function.decorator_list)]),
            (function.end_lineno or function.lineno) + 1,
        )
        for name, function in _functions(ast.parse((root / module).read_text("utf-8")))
    }


def _line(node: Any) -> int:
    return getattr(node, "lineno", 1)


def _functions(tree: ast.AST, prefix: str = "") -> Iterator[tuple[str, Function]]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, Function):
            yield prefix + node.name, node
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, f"{prefix}{node.name}.")


def _skipped(tree: ast.Module) -> set[ast.AST]:
    """Return the nodes that are no behaviour: types, texts, messages, checks of types."""
    roots: list[ast.AST | None] = []
    for node in ast.walk(tree):
        match node:
            case ast.Raise():  # the statement as a whole is a behaviour
                roots += [node.exc, node.cause]
            case ast.JoinedStr() | ast.Assert() | ast.Expr(value=ast.Constant()):
                roots.append(node)
            case ast.arg() | ast.AnnAssign():
                roots.append(node.annotation)
            case ast.keyword(arg="strict"):
                roots.append(node)
            case ast.Constant(value=float() as value) if 0 < value < SMALL:
                roots.append(node)
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                roots += [node.returns, *node.decorator_list]
    return {node for root in roots if root is not None for node in ast.walk(root)}


def _changes(node: Any) -> Iterator[tuple[str, Callable[[], None]]]:
    """Yield the changes of a node, and how each is made; in the same order at each call."""
    match node:
        case ast.Compare():
            for k, op in enumerate(node.ops):
                for other in COMPARISONS[type(op)]:
                    yield f"{_name(op)} -> {other.__name__}", _setter(node.ops, k, other())
        case ast.BinOp() | ast.AugAssign() if type(node.op) in ARITHMETIC:
            other_op = ARITHMETIC[type(node.op)]
            yield f"{_name(node.op)} -> {other_op.__name__}", _setter(node, "op", other_op())
        case ast.BoolOp():
            swapped = ast.Or() if isinstance(node.op, ast.And) else ast.And()
            yield f"{_name(node.op)} -> {_name(swapped)}", _setter(node, "op", swapped)
        case ast.UnaryOp(op=ast.USub()):
            yield "without minus", _setter(node, "op", ast.UAdd())
        case ast.If() | ast.While() | ast.IfExp() if not isinstance(node.test, ast.Compare):
            yield "condition negated", _setter(node, "test", ast.UnaryOp(ast.Not(), node.test))
        case ast.comprehension():
            for k, condition in enumerate(node.ifs):
                negated = ast.UnaryOp(ast.Not(), condition)
                yield f"filter {k} negated", _setter(node.ifs, k, negated)
        case ast.Call(args=[first, second, *others]) if (
            isinstance(first, Place) and isinstance(second, Place) and not _is_symmetric(node.func)
        ):
            yield "arguments exchanged", _setter(node, "args", [second, first, *others])
        case ast.Constant(value=bool() as value):
            yield f"{value} -> {not value}", _setter(node, "value", not value)
        case ast.Constant(value=int() | float() as value):
            changed = value + 1 if isinstance(value, int) or value == 0 else value * 1.5
            yield f"{value} -> {changed}", _setter(node, "value", changed)
        case ast.Return(value=ast.expr()):
            if not (isinstance(node.value, ast.Constant) and node.value.value is None):
                yield "returns None", _setter(node, "value", ast.Constant(None))
        case ast.Expr() | ast.Raise() | ast.Continue() | ast.Break():
            yield "statement removed", lambda: setattr(node, "__class__", ast.Pass)


def _is_symmetric(function: ast.expr) -> bool:
    return ast.unparse(function).rpartition(".")[2] in ("min", "max", "minimum", "maximum", "dot")


def _setter(target: Any, name: str | int, value: Any) -> Callable[[], None]:
    def change() -> None:
        if isinstance(name, int):
            target[name] = value
        else:
            setattr(target, name, value)

    return change


def _name(op: ast.AST) -> str:
    return type(op).__name__
