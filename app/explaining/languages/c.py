"""Translation to C99: a program of single lines, vectors of three and NumPy's functions.

Vectors are arrays of three; operations on their components are loops over k.
"""

from __future__ import annotations

import ast

from app.explaining.languages.expressions import (
    ATOM,
    PRODUCT,
    SIGN,
    VECTOR,
    Expressions,
    comment_of,
    function_of,
    kind_of,
)

EACH = "for (int k = 0; k < 3; k++) "
HEAD = """\
#include <math.h>
#include <stdio.h>

double dot(const double a[3], const double b[3]) { return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]; }
double norm(const double a[3]) { return sqrt(dot(a, a)); }
double sign(double x) { return (x > 0) - (x < 0); }
void cross(const double a[3], const double b[3], double product[3])
{
    product[0] = a[1]*b[2] - a[2]*b[1];
    product[1] = a[2]*b[0] - a[0]*b[2];
    product[2] = a[0]*b[1] - a[1]*b[0];
}

int main(void)
{
"""
FUNCTIONS = {"max": "fmax", "min": "fmin"}


class _C(Expressions):
    """The translator. ahead: statements that must precede the current one."""

    def __init__(self) -> None:
        super().__init__()
        self.types: dict[str, str] = {}  # of declared variables
        self.ahead: list[str] = []
        self._made = 0

    def written(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.Name(id=name) if kind_of(node, self.kinds) == VECTOR:
                return f"{name}[k]", ATOM
            case ast.BinOp(left=ast.Constant(value=int() as part), op=ast.Div(), right=right):
                return f"{part}.0 / {self.text(right, SIGN)}", PRODUCT  # no division of integers
            case ast.Call(func=ast.Attribute(value=ast.Call() as inner, attr="astype")):
                return f"(int)floor({self.text(inner.args[0])})", ATOM
        return super().written(node)

    def power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        return f"pow({self.text(base)}, {self.text(exponent)})", ATOM

    def call(self, name: str, arguments: list[ast.expr]) -> str:
        if name == "where":
            test, then, otherwise = (self.text(one) for one in arguments)
            return f"({test} ? {then} : {otherwise})"
        if name == "clip":
            value, least, most = (self.text(one) for one in arguments)
            return f"fmin(fmax({value}, {least}), {most})"
        if name == "array":
            return f"{self.made(_array(arguments))}[k]"
        if name in ("dot", "norm"):
            return f"{name}({', '.join(self.vector(one) for one in arguments)})"
        return super().call(FUNCTIONS.get(name, name), arguments)

    def vector(self, node: ast.expr) -> str:
        """Return the name of a vector. An unnamed one is computed ahead."""
        return node.id if isinstance(node, ast.Name) else self.made(node)

    def made(self, node: ast.expr) -> str:
        """Return a new variable with that value."""
        self._made += 1
        name = f"{'v' if kind_of(node, self.kinds) == VECTOR else 's'}{self._made}"
        statements = self.assigned(name, node)
        self.ahead += statements
        return name

    def scalars_ahead(self, node: ast.expr) -> ast.expr:
        """Return the expression with products and lengths of vectors as variables. Inside a loop
        that changes the vector, they would change, too.
        """
        words = self

        class Hoist(ast.NodeTransformer):
            def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
                if isinstance(node.op, ast.MatMult):
                    return ast.Name(words.made(node))
                self.generic_visit(node)
                return node

            def visit_Call(self, node: ast.Call) -> ast.expr:
                if function_of(node) == "norm":
                    return ast.Name(words.made(node))
                self.generic_visit(node)
                return node

        found = Hoist().visit(node)
        assert isinstance(found, ast.expr)
        return found

    def assigned(self, name: str, value: ast.expr) -> list[str]:
        """Return the statements that assign a value to a variable, with its declaration if it is
        new.
        """
        is_new = name not in self.types
        if kind_of(value, self.kinds) != VECTOR:
            is_int = isinstance(value, ast.Constant) and isinstance(value.value, int)
            kind = self.types.setdefault(name, "int" if is_int else "double")
            return [
                f"{kind} {name} = {self.text(value)};"
                if is_new
                else f"{name} = {self.text(value)};"
            ]
        self.kinds[name] = VECTOR
        function = function_of(value) if isinstance(value, ast.Call) else ""
        kind = self.types.setdefault(name, "int" if function.endswith("astype") else "double")
        if function == "array":
            parts = self.parts(value)
            if is_new:
                return [f"{kind} {name}[3] = {{{', '.join(parts)}}};"]
            return [f"{name}[{k}] = {part};" for k, part in enumerate(parts)]
        declared = [f"{kind} {name}[3];"] if is_new else []
        if function == "cross":
            assert isinstance(value, ast.Call)
            factors = ", ".join(self.vector(one) for one in value.args)
            return [*declared, f"cross({factors}, {name});"]
        return [*declared, f"{EACH}{name}[k] = {self.text(self.scalars_ahead(value))};"]

    def parts(self, value: ast.expr) -> list[str]:
        """Return the three numbers of np.array([...])."""
        assert isinstance(value, ast.Call) and isinstance(value.args[0], ast.List)
        return [self.text(part) for part in value.args[0].elts]


def _array(arguments: list[ast.expr]) -> ast.Call:
    return ast.Call(ast.Attribute(ast.Name("np"), "array"), arguments, [])


def program(python: str) -> str:
    """Translate a NumPy program, one statement per line, to C: a whole file. Link it with -lm."""
    words = _C()
    lines = []
    for line in python.rstrip("\n").split("\n"):
        code, comment = comment_of(line)
        found = _statements(words, ast.parse(code).body[0]) if code else []
        if comment:
            found = [f"{found[0]}  // {comment}", *found[1:]] if found else [f"// {comment}"]
        lines += found or ([""] if not code else [])
    body = "\n".join(f"    {line}" if line else "" for line in lines)
    return f"{HEAD}{body}\n    return 0;\n}}\n"


def _statements(words: _C, node: ast.stmt) -> list[str]:
    words.ahead = []
    found = _written(words, node)
    return [*words.ahead, *found]


def _written(words: _C, node: ast.stmt) -> list[str]:
    match node:
        case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Tuple(elts=values)):
            return [
                line
                for target, value in zip(targets, values, strict=True)
                for line in words.assigned(ast.unparse(target), value)
            ]
        case ast.Assign(targets=[ast.Name(id=name)], value=value):
            return words.assigned(name, value)
        case ast.AugAssign(target=ast.Name(id=name), op=op, value=value):
            sign = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(op)]
            if words.kinds.get(name) != VECTOR:
                return [f"{name} {sign}= {words.text(value)};"]
            return [f"{EACH}{name}[k] {sign}= {words.text(words.scalars_ahead(value))};"]
        case ast.Expr(value=ast.Call(func=ast.Name(id="print"), args=parts)):
            return [_printed(words, part) for part in parts if isinstance(part, ast.Name)]
    return []


def _printed(words: _C, name: ast.Name) -> str:
    one = "%d" if words.types[name.id] == "int" else "%.17g"
    if words.kinds.get(name.id) != VECTOR:
        return f'printf("{name.id} {one}\\n", {name.id});'
    values = ", ".join(f"{name.id}[{k}]" for k in range(3))
    return f'printf("{name.id} {one} {one} {one}\\n", {values});'
