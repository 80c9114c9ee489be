"""The attacks: `make attack`, bounded, and not part of `make test`.

    python -m tools.attack                          all of them, within half an hour
    python -m tools.attack random_events --seed 3   one of them, with its own arguments

A command is a module of this folder with a `main(argv) -> int`; its docstring says what it does. A
new one is found by being there. The status is 1 where one of them found something.
"""

from __future__ import annotations

import ast
import importlib
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

FOLDER = Path(__file__).parent
# All together within half an hour: each begins nothing new after its minutes, and is ended
# GRACE_S after them. Numbers do not bound them.
MINUTES = {
    "kill_saves": 1,
    "mutated_files": 2,
    "mutations": 6,
    "platforms": 3,
    "properties": 4,
    "random_events": 4,
    "random_views": 2,
}
MANY = {
    "kill_saves": ("--times", "1000000"),
    "mutated_files": ("--files", "1000000"),
    "random_views": ("--views", "1000000"),
}
GRACE_S = 120.0


def commands() -> dict[str, str]:
    """The first lines of their docstrings by name, of all that are there."""
    found = {}
    for path in sorted(FOLDER.glob("*.py")):
        tree = ast.parse(path.read_text())
        names = [node.name for node in tree.body if isinstance(node, ast.FunctionDef)]
        if "main" in names and not path.stem.startswith("_"):
            found[path.stem] = (ast.get_docstring(tree) or "").split("\n")[0]
    return found


def main(argv: Sequence[str]) -> int:
    known = commands()
    if not argv:
        return run_all(list(known))
    name, *rest = argv
    if name in known:
        return int(importlib.import_module(f"tools.attack.{name}").main(rest))
    if name not in ("-h", "--help"):
        print(f"{name}: is no attack; give one of {', '.join(known)}", file=sys.stderr)
        return 2
    print(__doc__)
    for name, told in known.items():
        print(f"  {name:16} {told}")
    return 0


def run_all(names: Sequence[str]) -> int:
    """One after the other, each in a process of its own; then what came of them."""
    outcomes = {}
    for name in names:
        bounds = ("--minutes", str(MINUTES[name])) if name in MINUTES else ()
        bounds += MANY.get(name, ())
        arguments = [sys.executable, "-m", "tools.attack", name, *bounds]
        print(f"== {' '.join(arguments[3:])}", flush=True)
        began_s, limit_s = time.monotonic(), 60 * MINUTES.get(name, 0) + GRACE_S
        try:
            status = subprocess.run(arguments, cwd=FOLDER.parents[1], timeout=limit_s).returncode
        except subprocess.TimeoutExpired:
            status = 124
        outcomes[name] = status, time.monotonic() - began_s
    print()
    for name, (status, took_s) in outcomes.items():
        told = "all well" if status == 0 else f"FOUND SOMETHING (status {status})"
        print(f"{name:16} {took_s:5.0f} s  {told}")
    return int(any(status for status, _ in outcomes.values()))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
