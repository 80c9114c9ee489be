"""The door to what numba does not promise: all that is used of it beside its documentation.

Each part is a module of this folder, and looked for before it is used. Where numba lacks something
that the part needs, as after an update, the tracer does without: its kernels take longer to
compile, or are compiled at each start; the images are the same.

LUCIDA_NUMBA=plain, in the environment, does without all parts.
"""

from __future__ import annotations

import importlib
import os
from functools import cache
from typing import Any

PARTS = ("numba_compiler", "numba_calls", "numba_cache", "numba_shortcuts")


@cache
def part(name: str) -> Any:
    """The module, one of PARTS; None where something is missing that it NEEDS: pairs of an object
    of numba's and the names that it must have."""
    if os.environ.get("LUCIDA_NUMBA") == "plain":
        return None
    try:
        found = importlib.import_module(f"{__package__}.{name}")
    except (ImportError, AttributeError):
        return None
    return found if all(_has(owner, names) for owner, names in found.NEEDS) else None


def missing() -> tuple[str, ...]:
    """The parts that the tracer does without."""
    return tuple(name for name in PARTS if part(name) is None)


def _has(owner: Any, names: tuple[str, ...]) -> bool:
    """Whether it has all of these, or gives them to its objects when they are made."""
    known: set[str] = set()
    for base in getattr(owner, "__mro__", ()):
        known.update(getattr(getattr(base.__init__, "__code__", None), "co_names", ()))
    return all(name in known or hasattr(owner, name) for name in names)
