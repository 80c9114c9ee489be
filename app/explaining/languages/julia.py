"""Translation to Julia, which counts from 1.

There are two ways: program() takes single lines, vectors of three and NumPy's functions; loops()
takes a function of loops over pixels, whose rows and columns then count from 1 or from 0.
"""

from __future__ import annotations

import ast
import textwrap
from dataclasses import dataclass

from app.explaining.languages.expressions import (
    ATOM,
    OPERATORS,
    POWER,
    SIGN,
    SUM,
    VECTOR,
    Expressions,
    comment_of,
    kind_of,
)
from renderer.pixels import Indexing

INDENT = "    "


class _Julia(Expressions):
    """counted: the variables that Python counts from 0, and Julia here as `indexing`."""

    def __init__(
        self, counted: frozenset[str] = frozenset(), indexing: Indexing = Indexing.LECTURE
    ) -> None:
        super().__init__()
        self._counted, self._from_one = counted, indexing is Indexing.LECTURE

    def written(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.BinOp(left=ast.Name(id=name), op=ast.Add(), right=ast.Constant(value=0.5)) if (
                name in self._counted and self._from_one
            ):
                return super().written(ast.BinOp(node.left, ast.Sub(), node.right))
            case ast.Call(func=ast.Attribute(value=ast.Call() as inner, attr="astype")):
                return f"floor.(Int, {self.text(inner.args[0])})", ATOM
            case ast.Subscript(value=value, slice=ast.Tuple(elts=places)) if not self._from_one:
                return f"{self.text(value, ATOM)}[{', '.join(map(self._from_next, places))}]", ATOM
            case ast.Subscript(value=value, slice=place):
                return f"{self.text(value, ATOM)}[{self.text(place, -2)}]", ATOM
        return super().written(node)

    def _from_next(self, place: ast.expr) -> str:
        """Return an index of an array, which Julia counts from 1, if the variables count from 0."""
        return f"{self.text(place, SUM)} + 1"

    def is_elementwise(self, left: ast.expr, sign: str, right: ast.expr) -> bool:
        kinds = [kind_of(side, self.kinds) == VECTOR for side in (left, right)]
        # Vectors can be added and scaled; everything else is elementwise.
        plain = sign in "+-" if kinds[0] == kinds[1] else sign == "*" or (sign == "/" and kinds[0])
        return any(kinds) and not plain

    def power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        sign = " .^ " if kind_of(base, self.kinds) == VECTOR else "^"
        return f"{self.text(base, ATOM)}{sign}{self.text(exponent, SIGN + 1)}", POWER

    def call(self, name: str, arguments: list[ast.expr]) -> str:
        if name == "array":
            assert isinstance(arguments[0], ast.List)
            return f"[{', '.join(self.text(part) for part in arguments[0].elts)}]"
        if name == "range" and len(arguments) == 1:
            last = self.text(arguments[0], ATOM)
            return f"1:{last}" if self._from_one else f"0:{last} - 1"
        renamed = {"clip": "clamp.", "where": "ifelse.", "arctan": "atan", "arcsin": "asin"}
        return super().call(renamed.get(name, name), arguments)


def program(python: str) -> str:
    """Translate a NumPy program, one statement per line, to Julia with its standard library."""
    words = _Julia()
    return "\n".join(_line(words, line) for line in python.rstrip("\n").split("\n")) + "\n"


def _line(words: _Julia, line: str) -> str:
    code, comment = comment_of(line)
    note = f"# {comment}" if comment else ""
    if not code:
        return note
    return "  ".join(part for part in (_statement(words, ast.parse(code).body[0]), note) if part)


def _statement(words: _Julia, node: ast.stmt) -> str:
    match node:
        case ast.Import():
            return "using LinearAlgebra"
        case ast.Assign(targets=[target], value=value):
            _learn(words, target, value)
            return f"{words.text(target, -1)} = {words.text(value, -1)}"
        case ast.AugAssign(target=target, op=op, value=value):
            return f"{words.text(target)} {OPERATORS[type(op)][0]}= {words.text(value)}"
        case ast.Expr(value=ast.Call(func=ast.Name(id="print"), args=parts)):
            listed = ", ' ', ".join(words.text(part) for part in parts)
            return f"println({listed})"
        case ast.Return(value=ast.expr() as value):
            return f"return {words.text(value, -1)}"
    return ast.unparse(node)


def _learn(words: _Julia, target: ast.expr, value: ast.expr) -> None:
    """Note which variables are vectors from here on."""
    pairs = [(target, value)]
    if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
        pairs = list(zip(target.elts, value.elts, strict=True))
    for name, part in pairs:
        if isinstance(name, ast.Name):
            words.kinds[name.id] = kind_of(part, words.kinds)


@dataclass(frozen=True)
class Loops:
    """A function in Julia.

    lines: its text.
    line_of: for each line of the Python, the number of the corresponding line, from 0.
    """

    lines: tuple[str, ...]
    line_of: tuple[int, ...]


def loops(python: str, indexing: Indexing = Indexing.LECTURE) -> Loops:
    """Translate a function of loops, without its docstring, to Julia: line by line, with an `end`
    at the end of each block. Rows and columns that count from 0 then count as `indexing` does.
    """
    tree = ast.parse(textwrap.dedent(python)).body[0]
    counted = frozenset(
        node.target.id
        for node in ast.walk(tree)
        if isinstance(node, ast.For) and isinstance(node.target, ast.Name)
    )
    lines: list[str] = []
    line_of = [-1] * len(python.rstrip("\n").split("\n"))
    _block(_Julia(counted, indexing), [tree], 0, lines, line_of)
    for number, line in enumerate(line_of):  # a statement's further lines
        line_of[number] = line if line >= 0 else line_of[number - 1]
    return Loops(tuple(lines), tuple(line_of))


def _block(
    words: _Julia, body: list[ast.stmt], depth: int, lines: list[str], line_of: list[int]
) -> None:
    for node in body:
        line_of[node.lineno - 1] = len(lines)
        lines.append(INDENT * depth + _header(words, node))
        inner = getattr(node, "body", None)
        if inner is None:
            continue
        _block(words, inner, depth + 1, lines, line_of)
        rest = getattr(node, "orelse", [])
        if rest:
            lines.append(INDENT * depth + "else")
            _block(words, rest, depth + 1, lines, line_of)
        lines.append(INDENT * depth + "end")


def _header(words: _Julia, node: ast.stmt) -> str:
    match node:
        case ast.FunctionDef(name=name, args=arguments):
            return f"function {name}({', '.join(one.arg for one in arguments.args)})"
        case ast.For(target=target, iter=over):
            return f"for {words.text(target, -1)} in {words.text(over)}"
        case ast.While(test=test):
            return f"while {words.text(test)}"
        case ast.If(test=test):
            return f"if {words.text(test)}"
    return _statement(words, node)
