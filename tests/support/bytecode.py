"""Bytecode of all modules and tests, for several processes that would each compile the same."""

import compileall
import sys
from contextlib import suppress
from importlib.util import module_from_spec
from pathlib import Path

TESTS = Path(__file__).parents[1]
SCENARIOS = "tests/app/window/scenarios"


def write_bytecode() -> None:
    """Compile all modules. Pytest's importer compiles the tests, whose assertions it rewrites."""
    for folder in ("app", "renderer", "lucida", "tests/support", SCENARIOS):
        compileall.compile_dir(TESTS.parent / folder, quiet=2)
    for path in (*TESTS.rglob("conftest.py"), *TESTS.rglob("test_*.py")):
        specs = (finder.find_spec(path.stem, [str(path.parent)]) for finder in sys.meta_path)
        spec = next(filter(None, specs))
        module = module_from_spec(spec)
        vars(module)["__builtins__"] = {}  # without __import__, the first import ends a module
        with suppress(ImportError, SyntaxError):  # the collection reports the latter
            spec.loader.exec_module(module)
