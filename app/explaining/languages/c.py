"""Translation to C99: a program of single lines, vectors of three and NumPy's functions.

Vectors are arrays of three; operations on their components are loops over k.
"""

from __future__ import annotations

import ast

from app.explaining.languages.expressions import (
    ATOM,
    OPERATORS,
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
FUNCTIONS = {"max": "fmax", "min": "fmin", "arctan": "atan", "arcsin": "asin"}


class _C(Expressions):
    """The translator. ahead: statements that must precede the current one."""

    def __init__(self) -> None:
        super().__init__()
        self.types: dict[str, str] = {}  # of declared variables
        self.ahead: list[str] = []
        self._made = 0
        self._looping = False  # inside a loop over k

    def written(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.Name(id=name) if self.is_vector(node):
                return f"{name}[k]", ATOM
            case ast.BinOp(left=ast.Constant(value=int() as part), op=ast.Div(), right=right):
                return f"{part}.0 / {self.text(right, SIGN)}", PRODUCT  # no division of integers
            case ast.Call(func=ast.Attribute(value=ast.Call() as inner, attr="astype")):
                return f"(int)floor({self.text(inner.args[0])})", ATOM
        return super().written(node)

    def is_vector(self, node: ast.expr) -> bool:
        return kind_of(node, self.kinds) == VECTOR

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
            array = ast.Call(ast.Attribute(ast.Name("np"), "array"), arguments, [])
            return f"{self.vector(array)}[k]"
        if name in ("dot", "norm"):
            text = f"{name}({', '.join(self.vector(one) for one in arguments)})"
            if not self._looping:
                return text
            # Inside a loop that changes the vector, its length would change, too.
            made = self._new_name("s")
            self.ahead.append(f"double {made} = {text};")
            return made
        return super().call(FUNCTIONS.get(name, name), arguments)

    def vector(self, node: ast.expr) -> str:
        """Return the name of a vector. An unnamed one is computed ahead."""
        if isinstance(node, ast.Name):
            return node.id
        name = self._new_name("v")
        self.ahead += self.assigned(name, node)
        return name

    def _new_name(self, letter: str) -> str:
        self._made += 1
        return f"{letter}{self._made}"

    def each(self, target: str, value: ast.expr) -> str:
        """Return a loop over the components of a vector. target: up to the = sign."""
        outer, self._looping = self._looping, True
        text = self.text(value)
        self._looping = outer
        return f"{EACH}{target}= {text};"

    def assigned(self, name: str, value: ast.expr) -> list[str]:
        """Return the statements that assign a value to a variable, with its declaration if it is
        new.
        """
        is_new = name not in self.types
        if not self.is_vector(value):
            is_int = isinstance(value, ast.Constant) and isinstance(value.value, int)
            kind = self.types.setdefault(name, "int" if is_int else "double")
            return [f"{f'{kind} ' if is_new else ''}{name} = {self.text(value)};"]
        self.kinds[name] = VECTOR
        function = function_of(value) if isinstance(value, ast.Call) else ""
        kind = self.types.setdefault(name, "int" if function.endswith("astype") else "double")
        match value:
            case ast.Call(args=[ast.List(elts=parts)]) if function == "array":
                texts = [self.text(part) for part in parts]
                if is_new:
                    return [f"{kind} {name}[3] = {{{', '.join(texts)}}};"]
                return [f"{name}[{k}] = {text};" for k, text in enumerate(texts)]
            case ast.Call(args=factors) if function == "cross":
                found = f"cross({', '.join(map(self.vector, factors))}, {name});"
            case _:
                found = self.each(f"{name}[k] ", value)
        return [f"{kind} {name}[3];", found] if is_new else [found]

    def statements(self, node: ast.stmt) -> list[str]:
        match node:
            case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Tuple(elts=values)):
                pairs = zip(targets, values, strict=True)
                return [
                    line for one, value in pairs for line in self.assigned(ast.unparse(one), value)
                ]
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                return self.assigned(name, value)
            case ast.AugAssign(target=ast.Name(id=name), op=op, value=value):
                sign, _ = OPERATORS[type(op)]
                if self.kinds.get(name) == VECTOR:
                    return [self.each(f"{name}[k] {sign}", value)]
                return [f"{name} {sign}= {self.text(value)};"]
            case ast.Expr(value=ast.Call(func=ast.Name(id="print"), args=parts)):
                return [self.printed(part.id) for part in parts if isinstance(part, ast.Name)]
        return []

    def printed(self, name: str) -> str:
        one = "%d" if self.types[name] == "int" else "%.17g"
        parts = [f"{name}[{k}]" for k in range(3)] if self.kinds.get(name) == VECTOR else [name]
        return f'printf("{name}{f" {one}" * len(parts)}\\n", {", ".join(parts)});'


def program(python: str) -> str:
    """Translate a NumPy program, one statement per line, to C: a whole file. Link it with -lm."""
    words = _C()
    lines = []
    for line in python.rstrip("\n").split("\n"):
        code, comment = comment_of(line)
        words.ahead = []
        found = words.statements(ast.parse(code).body[0]) if code else []
        found = [*words.ahead, *found]
        if comment:
            found = [f"{found[0]}  // {comment}", *found[1:]] if found else [f"// {comment}"]
        lines += found or ([""] if not code else [])
    body = "\n".join(f"    {line}" if line else "" for line in lines)
    return f"{HEAD}{body}\n    return 0;\n}}\n"
