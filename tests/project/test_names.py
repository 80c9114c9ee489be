"""A class's name says which one is meant: it stands once in the project."""

from __future__ import annotations

import ast
from collections import defaultdict

from test_layers import MODULES


def test_a_class_name_stands_once() -> None:
    places: dict[str, list[str]] = defaultdict(list)
    for module, path in MODULES.items():
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ClassDef):
                places[node.name].append(module)
    assert len(places) > 300
    assert not {name: modules for name, modules in places.items() if len(modules) > 1}
