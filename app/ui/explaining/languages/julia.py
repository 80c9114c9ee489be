"""Translation to Julia, which counts from 1.

There are two ways: program() takes single lines, vectors of three and NumPy's functions; loops()
takes a function of loops over pixels, whose rows and columns then count from 1 or from 0.
"""

from __future__ import annotations

import ast
import io
import textwrap
import tokenize
from collections.abc import Mapping
from dataclasses import dataclass

from lucida.renderer.camera.pixels import Indexing

INDENT = "    "
VECTOR, SCALAR = "vector", "scalar"
# How tightly operators bind.
COMPARE, SUM, PRODUCT, SIGN, POWER, ATOM = range(6)
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


class _Julia:
    """Writes expressions, with as few parentheses as possible.

    counted: the variables that Python counts from 0, and Julia here as `indexing`.
    """

    def __init__(
        self, counted: frozenset[str] = frozenset(), indexing: Indexing = Indexing.LECTURE
    ) -> None:
        self.kinds: dict[str, str] = {}  # of the variables so far
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
            case ast.Call(func=ast.Attribute(value=ast.Call() as inner, attr="astype")):
                return f"floor.(Int, {self.text(inner.args[0])})", ATOM
            case ast.Subscript(value=value, slice=ast.Tuple(elts=places)) if not self._from_one:
                return f"{self.text(value, ATOM)}[{', '.join(map(self._from_next, places))}]", ATOM
            case ast.Subscript(value=value, slice=place):
                return f"{self.text(value, ATOM)}[{self.text(place, -1)}]", ATOM
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
            case ast.Tuple(elts=parts):
                return ", ".join(self.text(part) for part in parts), -1
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
        return f"{renamed.get(name, name)}({', '.join(self.text(one) for one in arguments)})"


def comment_of(line: str) -> tuple[str, str]:
    """Split a line of Python into the code and the words of its comment."""
    for token in tokenize.generate_tokens(io.StringIO(line).readline):
        if token.type == tokenize.COMMENT:
            return line[: token.start[1]].rstrip(), token.string.lstrip("# ")
    return line, ""


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
        lines.append(INDENT * depth + "end")


def _header(words: _Julia, node: ast.stmt) -> str:
    match node:
        case ast.FunctionDef(name=name, args=arguments):
            return f"function {name}({', '.join(one.arg for one in arguments.args)})"
        case ast.For(target=target, iter=over):
            return f"for {words.text(target, -1)} in {words.text(over)}"
        case ast.If(test=test):
            return f"if {words.text(test)}"
    return _statement(words, node)
