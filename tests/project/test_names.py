"""A class's name says which one is meant: it stands once in the project."""

from __future__ import annotations

import ast
import re
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


def test_the_files_that_texts_name_are_there() -> None:
    """Docstrings and comments, which no linter reads: `laboratory/pages.py`."""
    there = [path.as_posix() for path in MODULES.values()]
    named = [
        (module, name)
        for module, path in MODULES.items()
        for name in re.findall(r"(?<![\w/.])\w+(?:/\w+)+\.py\b", path.read_text("utf-8"))
    ]
    assert len(named) > 20
    assert not [entry for entry in named if not any(p.endswith(f"/{entry[1]}") for p in there)]
