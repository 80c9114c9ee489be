"""The rule for the keys of a file that its reader does not use: nothing is dropped silently.

Each format has a table of harmless keys, and one of meanings. Any other key is reported in a line.
A key that may move a camera, bend its image or hold another camera is an error.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import Floats
from lucida.renderer.system.errors import LucidaError

TOLD = 8  # unknown keys that are named; the others are counted
_LENS = re.compile(r"dist(?!anc)|.*(?<!un)distort|[kps]\d\d?$")
_POSE = re.compile(r".*(?:pose|extrin|transf|quat|rotat|transl|position|orient|world)|[tq][a-z]{2}")
_FOCAL = re.compile(r".*\.(?:flx|fx|focal.*)")
_NONE: Mapping[str, str] = {}
_AT_REST = [np.eye(*shape).ravel() for shape in ((3, 3), (3, 4), (4, 4), (1, 4))]
_AT_REST.append(_AT_REST[-1][::-1])  # quaternions, with w first or last


def plain(name: str) -> str:
    """Return a key as the tables have it: lower case, letters, digits and dots only."""
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


def notes_on(
    entries: Iterable[tuple[str, Any]],
    harmless: str,
    meanings: Mapping[str, str],
    refused: Mapping[str, str] = _NONE,
) -> tuple[str, ...]:
    """Return phrases on unused entries, by their keys. Raises LucidaError for one that matters.

    harmless: keys, perhaps without their tables', and patterns of keys. meanings: by patterns, what
    a key means and what is shown instead. refused: by patterns, why a key is an error. Zeros,
    identities and empty values mean nothing.
    """
    told: dict[str, None] = {}
    unknown: dict[str, None] = {}
    seen: dict[str, str | None] = {}  # by name: the meaning, None if it is harmless
    for name, value in entries:
        if name not in seen:
            seen[name] = _meaning(plain(name), harmless.split(), meanings)
        meaning, numbers = seen[name], numbers_in(value)
        if meaning is None or _is_nothing(value, numbers):
            continue
        for pattern, problem in refused.items():
            if fnmatchcase(plain(name), pattern):
                raise LucidaError(name, problem, "give poses and images of a pinhole camera")
        if meaning:
            told[f"{name} is not used: {meaning}"] = None
        else:
            _check(name, plain(name), numbers)
            unknown[name] = None
    if unknown:
        names, more = list(unknown)[:TOLD], len(unknown) - TOLD
        rest = f" and {more} more" if more > 0 else ""
        told[f"not used, since the meaning is not known: {', '.join(names)}{rest}"] = None
    return tuple(told)


def _meaning(key: str, harmless: list[str], meanings: Mapping[str, str]) -> str | None:
    """Return the meaning of a key, "" if it is not known, None if it is harmless."""
    if any(fnmatchcase(key, part) or key.rpartition(".")[2] == part for part in harmless):
        return None
    return next((text for part, text in meanings.items() if fnmatchcase(key, part)), "")


def _is_nothing(value: Any, numbers: Floats) -> bool:
    if not numbers.size:
        return value in ("", None, [], {})
    return not numbers.any() or any(np.array_equal(numbers, rest) for rest in _AT_REST)


def numbers_in(value: Any) -> Floats:
    """Return the numbers of a value, however nested; none if it holds anything else."""
    try:
        numbers = np.ravel(value)
    except (TypeError, ValueError):
        return np.zeros(0)
    return numbers.astype(float) if numbers.dtype.kind in "iufb" else np.zeros(0)


def _check(name: str, key: str, numbers: Floats) -> None:
    last, count = key.rpartition(".")[2], numbers.size
    if not count:
        return
    is_K = count == 9 and not numbers[[3, 6, 7]].any() and numbers[0] > 1 and numbers[8] == 1
    if _LENS.match(last):
        problem = "sounds like a lens's distortion, and is no name that is known"
        remedy = "call it distortion_coefficients: k1, k2, p1, p2, k3; or remove it"
    elif is_K or _FOCAL.fullmatch(key):
        problem, remedy = "looks like another camera's", "give each camera a file of its own"
    elif count in (12, 16) or (count > 2 and _POSE.match(last)):
        problem = "looks like a pose, and is no name that is known"
        remedy = "call it camera_from_world or world_from_camera, or remove it"
    else:
        return
    raise LucidaError(name, problem, remedy)
