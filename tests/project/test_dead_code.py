"""Nothing stands in the product that only tests call: what a module defines, another part uses.

Vulture, one of the linters, goes by names alone: two functions of one name hide each other. Here
a name counts only for its own module and for those that import it from there.
"""

import ast
import functools
import re

from test_layers import MODULES, ROOT, tree_of

from lucida.renderer.files.cameras import FORMATS
from lucida.renderer.images.frame import DISPLAY

# What is found by its name, and by whom.
FOUND = {
    "NAME": "app/cli.py looks for it in each of app/commands",
    "configure": "the same",
    "run": "the same",
    "explore": "called in notebooks",
    "main": "run by `python -m`, or in a child process",
    "__all__": "read by `import *` and by tools",
    "__getattr__": "called by Python for what a module lacks",
    "__dir__": "called by dir()",
    "_": "a loop's variable",
}
# A decorator that hands the function on to whoever calls it.
REGISTERED = {"atexit.register", "lower_builtin", "register_model", "type_callable"}

# Modules that are loaded by name: what they define is asked of what comes.
LOADED = {f"lucida.renderer.files.cameras.{entry.name}" for entry in FORMATS} | {DISPLAY}


def definitions(tree):
    """Names that a module binds at its top level, but for imports."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            calls = (d.func if isinstance(d, ast.Call) else d for d in node.decorator_list)
            if not REGISTERED & {ast.unparse(call) for call in calls}:
                yield node.name, node
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for part in (part for target in targets for part in ast.walk(target)):
                if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
                    yield part.id, node


def dotted(node):
    """Return the names of an expression like a.b.c; () for another one."""
    if isinstance(node, ast.Name):
        return (node.id,)
    names = dotted(node.value) if isinstance(node, ast.Attribute) else ()
    return (*names, node.attr) if names else ()


def uses(module, tree):
    """(module, name) of what a module reads: its own names, imported ones, and attributes of
    imported modules."""
    package = MODULES[module].name == "__init__.py"
    above = module.split(".") if package else module.split(".")[:-1]
    named, nodes = {}, [tree]
    for node in nodes:  # ast.walk() takes twice as long
        for part in vars(node).values():
            parts = part if isinstance(part, list) else [part]
            nodes += [one for one in parts if isinstance(one, ast.AST)]
        if isinstance(node, ast.ImportFrom):
            start = above[: len(above) - node.level + 1] if node.level else []
            home = ".".join([*start, *([node.module] if node.module else [])])
            for alias in node.names:
                yield home, alias.name
                named[alias.asname or alias.name] = f"{home}.{alias.name}"
        elif isinstance(node, ast.Import):
            for alias in node.names:
                first = alias.name.split(".")[0]
                named[alias.asname or first] = alias.name if alias.asname else first
    for node in nodes:
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            yield module, node.id
        elif isinstance(node, ast.Attribute) and (names := dotted(node)):
            first, *rest = names
            parts = [*named.get(first, first).split("."), *rest]
            for end in range(1, len(parts)):
                yield ".".join(parts[:end]), parts[end]


@functools.cache
def used():
    by_python = {use for module, path in MODULES.items() for use in uses(module, tree_of(path))}
    shaders = (path for path in ROOT.glob("shaders/**/*.*") if path.suffix != ".py")
    words = {word for path in shaders for word in re.findall(r"\w+", path.read_text("latin-1"))}
    return frozenset(
        by_python | {("lucida.renderer.images.shared_numbers", word) for word in words}
    )


def test_what_a_module_defines_is_used():
    unused = {
        (module, name)
        for module in MODULES.keys() - LOADED
        for name, _ in definitions(tree_of(MODULES[module]))
        if (module, name) not in used() and name not in FOUND
    }
    assert not unused, "only tests use these, or nobody"
