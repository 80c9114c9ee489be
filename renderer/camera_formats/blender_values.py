"""The camera values in a Blender script or a JSON file, read without running anything.

A script's assignments are known by the last name on their left, `camera.data.lens = 50` as `lens`,
in the file's order and anywhere in it. A value is a number, a text, a sum or product of them,
radians() of them, or Euler(), Vector(), Matrix() and Quaternion() of them. If a script has a table,
a list of dicts, only the table is read, as JSON is: one camera per dict, which inherits the values
around it.
"""

from __future__ import annotations

import ast
import math
import operator
import warnings
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from renderer.errors import LucidaError

Values = dict[str, Any]
Found = tuple[Values, dict[str, int]]  # with their lines in a script

_OPERATORS: dict[type, Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_SIGNS: dict[type, Callable[[float], float]] = {ast.USub: operator.neg, ast.UAdd: operator.pos}
_TAKEN_AS_THEY_ARE = {"Vector", "Matrix", "Quaternion"}
_CAMERA_TYPES = ("PERSP", "ORTHO", "PANO", "CUSTOM")
_PARTLY = "?"  # placeholder for a value that a script assigns only in part
_DEEPEST = 100  # nesting of dicts, lists and operators


class _Assignment(NamedTuple):
    """An assignment. owner: the text before the name, such as "camera.data"."""

    owner: str
    name: str
    node: ast.expr


def tables(value: object, known: frozenset[str], around: Values | None = None) -> Iterator[Values]:
    """Yield the cameras in a JSON value: each one's values of the known names. Raises
    LucidaError.
    """
    yield from _tables(value, known, around or {}, _DEEPEST)


def _tables(value: object, known: frozenset[str], around: Values, depth: int) -> Iterator[Values]:
    if not depth:
        raise LucidaError("", "has tables within tables without end", "give a camera's table")
    if isinstance(value, list | tuple):
        for entry in value:
            if isinstance(entry, dict):
                yield from _tables(entry, known, around, depth - 1)
        return
    if not isinstance(value, dict):
        return
    found, lists = dict(around), []
    waiting = [value]
    while waiting:
        for key, part in waiting.pop().items():
            if key in known:
                found[key] = part
            elif isinstance(part, dict):
                waiting.append(part)
            elif isinstance(part, list | tuple) and any(isinstance(one, dict) for one in part):
                lists.append(part)
    if lists:
        for part in lists:
            yield from _tables(part, known, found, depth - 1)
    elif found:
        yield found


def script(text: str, known: frozenset[str]) -> list[Found]:
    """Return the cameras in a Python script, with the lines of their values. Raises LucidaError."""
    try:
        with warnings.catch_warnings():  # about invalid escape sequences in the script
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        line = f"line {error.lineno}" if isinstance(error, SyntaxError) and error.lineno else ""
        reason = error.msg if isinstance(error, SyntaxError) else "too deep, or with a NUL"
        raise LucidaError(line, f"is no Python: {reason}", "mend it, or give JSON") from None
    assigned = sorted(_assignments(tree), key=lambda each: (each.node.lineno, each.node.col_offset))
    around: Values = {}
    listed = []
    for each in assigned:
        node = each.node
        if isinstance(node, ast.Dict | ast.List) and _names(node, known):
            try:
                value = ast.literal_eval(node)
            except (ValueError, TypeError, RecursionError, MemoryError):
                problem = "is a table with more than numbers and text in it"
                raise LucidaError(
                    f"line {node.lineno}: {each.name}", problem, "write them"
                ) from None
            if isinstance(value, dict):
                around |= {key: part for key, part in value.items() if key in known}
            else:
                listed.append(value)
    if listed:
        return [
            (values, {}) for value in listed for values in tables(value, known | {"name"}, around)
        ]
    return _by_assignments([each for each in assigned if each.name in known], around)


def _names(node: ast.expr, known: frozenset[str]) -> bool:
    """Return True if the node is a table that holds one of these names."""
    keys = (key for part in ast.walk(node) if isinstance(part, ast.Dict) for key in part.keys)
    return any(isinstance(key, ast.Constant) and key.value in known for key in keys)


def _by_assignments(assigned: list[_Assignment], around: Values) -> list[Found]:
    values, lines = dict(around), dict[str, int]()
    for name in dict.fromkeys(each.name for each in assigned):
        mine = [each for each in assigned if each.name == name and _may_be(each)]
        if len({each.owner for each in mine}) > 1:  # other objects have locations, too
            mine = [each for each in mine if "cam" in each.owner.lower()] or mine
        for each in mine:
            where = f"line {each.node.lineno}: {name}"
            try:
                value = _value(each.node, _DEEPEST)
            except LucidaError as error:
                raise error.within(where) from None
            except (ArithmeticError, TypeError, ValueError, RecursionError):
                raise LucidaError(where, "has no value", "write it as a number") from None
            if name in lines and value != values[name]:
                problem = f"is not the value of line {lines[name]}"
                raise LucidaError(where, problem, "leave the camera's alone")
            values[name], lines[name] = value, each.node.lineno
    return [(values, lines)] if values else []


def _may_be(each: _Assignment) -> bool:
    """Return False for the type of a light: only a camera's type counts."""
    value = each.node.value if isinstance(each.node, ast.Constant) else None
    return each.name != "type" or value in _CAMERA_TYPES


def _assignments(tree: ast.Module) -> Iterator[_Assignment]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                yield from _assigned(target, node.value)
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            yield from _assigned(node.target, node.value)
        elif isinstance(node, ast.AugAssign):
            yield from _assigned(node.target, ast.copy_location(ast.Name(_PARTLY), node.value))
        elif isinstance(node, ast.Call) and _last(node.func) == "camera_add":
            for word in node.keywords:
                name = {"rotation": "rotation_euler"}.get(word.arg or "", word.arg or "")
                yield _Assignment("camera_add", name, word.value)


def _assigned(target: ast.expr, value: ast.expr) -> Iterator[_Assignment]:
    if isinstance(target, ast.Tuple | ast.List):
        whole = isinstance(value, ast.Tuple | ast.List) and len(value.elts) == len(target.elts)
        values = value.elts if whole else [value] * len(target.elts)  # type: ignore[attr-defined]
        for part, its in zip(target.elts, values, strict=True):
            yield from _assigned(part, its)
        return
    part = target
    if isinstance(target, ast.Subscript) or getattr(target, "attr", "") in ("x", "y", "z", "w"):
        part = getattr(target, "value", target)  # location[0] and location.x are parts of location
    if isinstance(part, ast.Attribute):
        node = value if part is target else ast.copy_location(ast.Name(_PARTLY), value)
        yield _Assignment(ast.unparse(part.value), part.attr, node)
    elif isinstance(part, ast.Name):
        yield _Assignment("", part.id, value)


def _value(node: ast.expr, depth: int) -> Any:
    if depth and isinstance(node, ast.Constant):
        return node.value
    if depth and isinstance(node, ast.Tuple | ast.List):
        return [_value(part, depth - 1) for part in node.elts]
    if depth and isinstance(node, ast.UnaryOp) and type(node.op) in _SIGNS:
        return _SIGNS[type(node.op)](_value(node.operand, depth - 1))
    if depth and isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
        one, other = (float(_value(part, depth - 1)) for part in (node.left, node.right))
        return _OPERATORS[type(node.op)](one, other)
    if depth and isinstance(node, ast.Attribute | ast.Name) and _last(node) == "pi":
        return math.pi
    if depth and isinstance(node, ast.Call) and not node.keywords and node.args:
        name, parts = _last(node.func), [_value(part, depth - 1) for part in node.args]
        if name == "radians" and len(parts) == 1:
            return math.radians(float(parts[0]))
        if name == "Euler":  # with its own rotation order
            return parts[0] if len(parts) == 1 else {"angles": parts[0], "order": parts[1]}
        if name in _TAKEN_AS_THEY_ARE and len(parts) == 1:
            return parts[0]
    problem = f"{ast.unparse(node)[:60]} has no value that can be read without running it"
    if isinstance(node, ast.Name) and node.id == _PARTLY:
        problem = "is given in parts"
    raise LucidaError("", problem, "write it whole, as numbers")


def _last(node: ast.expr) -> str:
    return str(getattr(node, "attr", None) or getattr(node, "id", ""))
