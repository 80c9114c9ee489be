"""Expressions of Python written in another language, with as few parentheses as possible.

This is the part that the languages share: precedence, and which values are vectors.
"""

from __future__ import annotations

import ast
import io
import tokenize
from collections.abc import Mapping

VECTOR, SCALAR = "vector", "scalar"
# How tightly operators bind.
OR, AND, COMPARE, SUM, PRODUCT, SIGN, POWER, ATOM = range(8)
OPERATORS: dict[type[ast.AST], tuple[str, int]] = {
    ast.Add: ("+", SUM),
    ast.Sub: ("-", SUM),
    ast.Mult: ("*", PRODUCT),
    ast.Div: ("/", PRODUCT),
    ast.Lt: ("<", COMPARE),
    ast.LtE: ("<=", COMPARE),
    ast.Gt: (">", COMPARE),
    ast.GtE: (">=", COMPARE),
    ast.Eq: ("==", COMPARE),
    ast.NotEq: ("!=", COMPARE),
}


def function_of(node: ast.Call) -> str:
    """Return the name of the called function as written; without the module if it is NumPy's:
    `cross`.
    """
    name = ast.unparse(node.func)
    return name.rpartition(".")[2] if name.startswith("np.") else name


def kind_of(node: ast.expr, kinds: Mapping[str, str]) -> str:
    """Return the kind of a value, vector or scalar. kinds: of the variables; others are scalars."""
    match node:
        case ast.Name(id=name):
            return kinds.get(name, SCALAR)
        case ast.BinOp(op=ast.MatMult()):
            return SCALAR
        case ast.BinOp(left=left, right=right):
            return _any(kinds, left, right)
        case ast.UnaryOp(operand=operand):
            return kind_of(operand, kinds)
        case ast.Compare(left=left, comparators=others):
            return _any(kinds, left, *others)
        case ast.Call(func=ast.Attribute(value=value, attr="astype")):
            return kind_of(value, kinds)
        case ast.Call():
            name = function_of(node)
            if name in ("array", "cross"):
                return VECTOR
            if name in ("clip", "where", "floor"):
                return _any(kinds, *node.args)
    return SCALAR


def _any(kinds: Mapping[str, str], *nodes: ast.expr) -> str:
    return VECTOR if any(kind_of(node, kinds) == VECTOR for node in nodes) else SCALAR


class Expressions:
    """Writes expressions; a language overrides what it writes differently."""

    def __init__(self) -> None:
        self.kinds: dict[str, str] = {}  # of the variables so far

    def text(self, node: ast.expr, least: int = OR) -> str:
        """Return the expression, in parentheses if it binds less tightly than `least`."""
        written, binds = self.written(node)
        return f"({written})" if binds < least else written

    def written(self, node: ast.expr) -> tuple[str, int]:
        """Return the expression without parentheses around it, and its precedence."""
        match node:
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return self.power(left, right)
            case ast.BinOp(left=left, op=ast.MatMult(), right=right):
                return self.call("dot", [left, right]), ATOM
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
                return self.binary(left, op, right)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"-{self.text(operand, SIGN)}", SIGN
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in OPERATORS:
                return self.binary(left, op, right)
            case ast.BoolOp(op=op, values=values):
                word, binds = ("||", OR) if isinstance(op, ast.Or) else ("&&", AND)
                return f" {word} ".join(self.text(value, binds + 1) for value in values), binds
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"!{self.text(operand, SIGN)}", SIGN
            case ast.Tuple(elts=parts):
                return ", ".join(self.text(part) for part in parts), OR - 1
            case ast.Attribute(value=value, attr=name):
                return f"{self.text(value, ATOM)}.{name}", ATOM
            case ast.Call():
                return self.call(function_of(node), node.args), ATOM
        return ast.unparse(node), ATOM

    def binary(self, left: ast.expr, op: ast.AST, right: ast.expr) -> tuple[str, int]:
        """Return two operands with the operator between them; associates to the left."""
        sign, binds = OPERATORS[type(op)]
        if self.is_elementwise(left, sign, right):
            sign = f".{sign}"
        return f"{self.text(left, binds)} {sign} {self.text(right, binds + 1)}", binds

    def is_elementwise(self, left: ast.expr, sign: str, right: ast.expr) -> bool:
        """Return True if the language writes this operation of vectors with a dot."""
        return False

    def power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        raise NotImplementedError

    def call(self, name: str, arguments: list[ast.expr]) -> str:
        """Return a function call."""
        return f"{name}({', '.join(self.text(argument) for argument in arguments)})"


def comment_of(line: str) -> tuple[str, str]:
    """Split a line of Python into the code and the words of its comment."""
    for token in tokenize.generate_tokens(io.StringIO(line).readline):
        if token.type == tokenize.COMMENT:
            return line[: token.start[1]].rstrip(), token.string.lstrip("# ")
    return line, ""
