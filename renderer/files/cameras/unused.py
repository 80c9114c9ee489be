"""The keys of a file that its reader does not use: a note names them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import Floats

SHOWN = 8  # keys that a note names; the others are counted


def plain(name: str) -> str:
    """Return a key in lower case, letters, digits and dots only."""
    return re.sub(r"[^a-z0-9.]", "", name.lower())


def entries_of(tree: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield all values of nested tables, named like "cam0.size" and "cameras.0.size".

    A table with data is a matrix, and one value.
    """
    for name, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        is_list = isinstance(value, list) and any(isinstance(part, dict) for part in value)
        if is_list or (isinstance(value, dict) and "data" not in value):
            yield from entries_of(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


def numbers_in(value: Any) -> Floats:
    """Return the numbers of a value, however nested; none if it holds anything else."""
    try:
        numbers = np.ravel(value)
    except (TypeError, ValueError):
        return np.zeros(0)
    return numbers.astype(float) if numbers.dtype.kind in "iufb" else np.zeros(0)


def notes_on(names: Iterable[str]) -> tuple[str, ...]:
    """Return a note that names the keys that are not used; none if there are none."""
    unused = list(dict.fromkeys(names))
    if not unused:
        return ()
    more = f" and {len(unused) - SHOWN} more" if len(unused) > SHOWN else ""
    return (f"not used: {', '.join(unused[:SHOWN])}{more}",)
