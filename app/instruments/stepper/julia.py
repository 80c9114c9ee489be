"""Translation of functions that loop over pixels to Julia.

Julia counts from 1. Rows and columns, which Python counts from 0, are counted from 1 or from 0.
"""

from __future__ import annotations

import ast
import textwrap
from dataclasses import dataclass

from lucida.renderer.camera.pixels import Indexing

INDENT = "    "
# Precedences: operators with higher numbers bind more tightly.
COMPARE, SUM, PRODUCT, SIGN, ATOM = range(5)
OPERATORS: dict[type[ast.AST], tuple[str, int]] = {
    ast.Add: ("+", SUM),
    ast.Sub: ("-", SUM),
    ast.Mult: ("*", PRODUCT),
    ast.Div: ("/", PRODUCT),
    ast.Lt: ("<", COMPARE),
    ast.GtE: (">=", COMPARE),
}


class _Julia:
    """A writer of expressions, with as few parentheses as possible.

    counted: the variables that Python counts from 0, and Julia as `indexing` says.
    """

    def __init__(self, counted: frozenset[str], indexing: Indexing) -> None:
        self._counted, self._from_one = counted, indexing is Indexing.LECTURE

    def text(self, node: ast.expr, least: int = COMPARE) -> str:
        """Return the expression, in parentheses if it binds less tightly than `least`."""
        written, binds = self.written(node)
        return f"({written})" if binds < least else written

    def written(self, node: ast.expr) -> tuple[str, int]:
        """Return the expression without parentheses around it, and its precedence."""
        match node:
            case ast.BinOp(left=ast.Name(id=name), op=ast.Add(), right=ast.Constant(value=0.5)) if (
                name in self._counted and self._from_one
            ):
                return self.binary(node.left, ast.Sub(), node.right)
            case ast.Subscript(value=value, slice=ast.Tuple(elts=places)) if not self._from_one:
                # Julia's arrays count from 1 in any case.
                numbers = ", ".join(f"{self.text(place, SUM)} + 1" for place in places)
                return f"{self.text(value, ATOM)}[{numbers}]", ATOM
            case ast.Subscript(value=value, slice=place):
                return f"{self.text(value, ATOM)}[{self.text(place, -1)}]", ATOM
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
                return self.binary(left, op, right)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"-{self.text(operand, SIGN)}", SIGN
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in OPERATORS:
                return self.binary(left, op, right)
            case ast.Tuple(elts=parts):
                return ", ".join(self.text(part) for part in parts), -1
            case ast.Attribute(value=value, attr=name):
                return f"{self.text(value, ATOM)}.{name}", ATOM
            case ast.Call(func=ast.Name(id="range"), args=[count]):
                last = self.text(count, ATOM)
                return (f"1:{last}" if self._from_one else f"0:{last} - 1"), ATOM
            case ast.Call(func=function, args=arguments):
                given = ", ".join(self.text(one) for one in arguments)
                return f"{self.text(function, ATOM)}({given})", ATOM
        return ast.unparse(node), ATOM

    def binary(self, left: ast.expr, op: ast.AST, right: ast.expr) -> tuple[str, int]:
        """Return two operands with the operator between them, which associates to the left."""
        sign, binds = OPERATORS[type(op)]
        return f"{self.text(left, binds)} {sign} {self.text(right, binds + 1)}", binds


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
    at the end of each block. Rows and columns that count from 0 then count as `indexing` says.
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
        lines.append(INDENT * depth + "end")


def _header(words: _Julia, node: ast.stmt) -> str:
    match node:
        case ast.FunctionDef(name=name, args=arguments):
            return f"function {name}({', '.join(one.arg for one in arguments.args)})"
        case ast.For(target=target, iter=over):
            return f"for {words.text(target, -1)} in {words.text(over)}"
        case ast.If(test=test):
            return f"if {words.text(test)}"
        case ast.Assign(targets=[target], value=value):
            return f"{words.text(target, -1)} = {words.text(value, -1)}"
        case ast.Return(value=ast.expr() as value):
            return f"return {words.text(value, -1)}"
    return ast.unparse(node)
