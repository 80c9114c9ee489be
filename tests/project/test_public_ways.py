"""Tests use what they test in the public way. Where there is none, the test says why."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

TESTS = Path(__file__).parents[1]
PRIVATE = re.compile(r"_[a-zA-Z]\w*")
PYTHONS = {
    "_asdict",
    "_exit",
    "_fields",
    "_replace",
}  # of os and of named tuples: public in spite of their names

# Each is explained where it stands.
NONE_IS_PUBLIC = {
    "checking/running/test_running_command.py": {"_chunks"},
    "checking/running/test_running_limits.py": {"_closed", "_program", "_source"},
    "images/test_live_raster.py": {"_under_way", "_first_row", "_build"},
    "outside/test_outside_drawing.py": {"_used"},
    "project/test_compile_note.py": {"_note"},
    "scenarios/motion.py": {"_placed", "_pictures", "_shown_raster"},
    "storage/test_files.py": {"_SHAPES"},
    "notebook/test_notebook_display.py": {"_repr_html_", "_repr_png_"},  # what a notebook calls
    "storage/test_odd_names.py": {"_name", "_finish", "_glfw", "_GLFWdropfun"},
    "trace/test_precompile.py": {"_exit"},
    "trace/test_trace_cache.py": {"_has_failed", "_note"},
    "your_code/test_code_runs.py": {"_asked", "_wake"},
}


def private_names(tree: ast.Module) -> Iterator[str]:
    """Attributes of anything but self, imported names, and what monkeypatch.setattr() replaces."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            if not (isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")):
                yield node.attr
        elif isinstance(node, ast.ImportFrom):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(("setattr", "delattr")):
            yield from (str(part.value) for part in node.args if isinstance(part, ast.Constant))


def test_no_test_reaches_into_what_it_tests() -> None:
    found = {}
    for path in TESTS.rglob("*.py"):
        name = path.relative_to(TESTS).as_posix()
        names = set(private_names(ast.parse(path.read_text("utf-8"))))
        private = {one for one in names if PRIVATE.fullmatch(one)} - PYTHONS
        found[name] = private - NONE_IS_PUBLIC.get(name, set())
    assert len(found) > 200
    assert not {name: private for name, private in found.items() if private}
