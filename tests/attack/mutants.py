"""Single changes of a module's code, such as a wrong border or sign, for mutations.py to try.

Knows nothing of tests. A mutant changes one node of the syntax tree: a comparison, an arithmetic or
boolean operator, a condition, a number, a statement. Types, documentation and what is told in
errors are left alone. Of the renderers, tolerances too: numbers below SMALL and the modules' own
constants become ten times as large or as small. Those of the app are tuned by eye.
"""

from __future__ import annotations

import ast
from collections import Counter
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

SMALL = 1e-4  # smaller numbers are tolerances: half as much again is no change to notice
TENFOLD = {"ten times": 10.0, "a tenth": 0.1}


@dataclass(frozen=True)
class Mutant:
    """module: its file, as tests/attack/mutations.py names it. node, change: of which node of the
    tree, in the order of ast.walk(), which change. function: the outermost one that it is in, as
    `Class.name`; empty for code that runs at import. line: where. key: its name, which holds as
    long as the line stays as it is."""

    module: str
    node: int
    change: int
    function: str
    line: int
    key: str


def mutants(root: Path, module: str) -> list[Mutant]:
    """All mutants of a module."""
    source = (root / module).read_text()
    lines = source.splitlines()
    tree = ast.parse(source)
    owners, skipped = _owners(tree), _skipped(tree, tuned=not module.startswith("renderer/"))
    found, seen = [], Counter[str]()
    for number, node in enumerate(ast.walk(tree)):
        if node in skipped:
            continue
        for change, (told, _) in enumerate(_changes(node)):
            line = node.lineno if hasattr(node, "lineno") else _test_of(node).lineno
            owner = owners.get(node, "")
            key = f"{module} {owner or 'import'}: {lines[line - 1].strip()} | {told}"
            seen[key] += 1
            key += f" ({seen[key]})" if seen[key] > 1 else ""
            found.append(Mutant(module, number, change, owner, line, key))
    return sorted(found, key=lambda mutant: (mutant.line, mutant.node))


def compiled(root: Path, mutant: Mutant) -> CodeType:
    """The code of the module with its change."""
    tree = ast.parse((root / mutant.module).read_text())
    node = next(node for k, node in enumerate(ast.walk(tree)) if k == mutant.node)
    list(_changes(node))[mutant.change][1]()
    ast.fix_missing_locations(tree)
    return compile(tree, str(root / mutant.module), "exec", dont_inherit=True)


def outermost(root: Path, module: str) -> dict[str, tuple[int, int]]:
    """First and last line of the functions that mutants name, decorators included."""
    spans = {}
    for name, function in _functions(ast.parse((root / module).read_text())):
        first = min([function.lineno, *(part.lineno for part in function.decorator_list)])
        spans[name] = (first, function.end_lineno or first)
    return spans


def _functions(tree: ast.AST, prefix: str = "") -> Iterator[tuple[str, Function]]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, Function):
            yield prefix + node.name, node
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, f"{prefix}{node.name}.")


def _owners(tree: ast.Module) -> dict[ast.AST, str]:
    """Of each node in a function's body that function's name; defaults run at import."""
    return {
        node: name
        for name, function in _functions(tree)
        for statement in function.body
        for node in ast.walk(statement)
    }


def _skipped(tree: ast.Module, tuned: bool) -> set[ast.AST]:
    """What is not mutated. tuned: the tolerances are tuned by eye, which no test holds."""
    roots: list[ast.AST] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise):  # the statement itself is
            roots += [part for part in (node.exc, node.cause) if part is not None]
        elif (
            isinstance(node, ast.JoinedStr | ast.Assert)
            or (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING")
            or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))
        ):
            roots.append(node)
        elif isinstance(node, ast.arg | ast.AnnAssign) and node.annotation is not None:
            roots.append(node.annotation)
        elif isinstance(node, ast.keyword) and node.arg == "strict":  # of zip(): only a check
            roots.append(node)
        elif isinstance(node, Function) and node.returns is not None:
            roots.append(node.returns)
        if isinstance(node, Function | ast.ClassDef):
            roots += node.decorator_list
        if tuned and isinstance(node, ast.Constant) and _is_small(node.value):
            roots.append(node)
    for statement in tree.body:  # NAME = 3
        if isinstance(statement, ast.Assign) and not any(
            isinstance(node, ast.Call | ast.Name) for node in ast.walk(statement.value)
        ):
            roots.append(statement if tuned else statement.value)
    return {node for root in roots for node in ast.walk(root)}


def _is_small(value: object) -> bool:
    return isinstance(value, float) and 0 < value < SMALL


def _is_number(node: ast.expr) -> bool:
    """Such as 1 / 128, without names."""
    if isinstance(node, ast.BinOp):
        return _is_number(node.left) and _is_number(node.right)
    return isinstance(node, ast.Constant) and isinstance(node.value, int | float)


def _test_of(node: Any) -> ast.expr:
    """Of a comprehension's part, which has no place of its own."""
    return node.target


def _changes(node: Any) -> Iterator[tuple[str, Callable[[], None]]]:
    """What can be changed in a node, and how; each time that it is called, in the same order."""
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
            negated = ast.UnaryOp(ast.Not(), node.test)
            yield "condition negated", _setter(node, "test", negated)
        case ast.comprehension():
            for k, condition in enumerate(node.ifs):
                negated = ast.UnaryOp(ast.Not(), condition)
                yield f"filter {k} negated", _setter(node.ifs, k, negated)
        case ast.Constant(value=bool() as value):
            yield f"{value} -> {not value}", _setter(node, "value", not value)
        case ast.Constant(value=int() | float() as value) if not _is_small(value):
            changed = value + 1 if isinstance(value, int) or value == 0 else value * 1.5
            yield f"{value} -> {changed}", _setter(node, "value", changed)
        case ast.Constant(value=float() as value):
            for told, factor in TENFOLD.items():
                yield f"{told} {value}", _setter(node, "value", value * factor)
        case ast.Assign() if node.col_offset == 0 and _is_number(node.value):  # of the module
            for told, factor in TENFOLD.items():
                scaled = ast.BinOp(node.value, ast.Mult(), ast.Constant(factor))
                yield told, _setter(node, "value", scaled)
        case ast.Return(value=ast.expr()):
            if not (isinstance(node.value, ast.Constant) and node.value.value is None):
                yield "returns None", _setter(node, "value", ast.Constant(None))
        case ast.Expr() | ast.Raise() | ast.Continue() | ast.Break():
            yield "statement removed", lambda: setattr(node, "__class__", ast.Pass)


def _setter(target: Any, name: str | int, value: Any) -> Callable[[], None]:
    def change() -> None:
        if isinstance(name, int):
            target[name] = value
        else:
            setattr(target, name, value)

    return change


def _name(op: ast.AST) -> str:
    return type(op).__name__
