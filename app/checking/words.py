"""The words of tasks and their meanings, from words.toml."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

Words = Mapping[str, str]


class _Kind(msgspec.Struct):
    """A kind of function. words: its own words. groups: words that it shares with other kinds."""

    function: str
    arguments: tuple[str, ...]
    answer: str
    returns: tuple[str, ...] = ()
    words: dict[str, str] = {}
    groups: tuple[str, ...] = ()
    return_words: dict[str, str] = {}


class _File(msgspec.Struct):
    groups: dict[str, dict[str, str]]
    parts: dict[str, dict[str, str]]
    kinds: dict[str, _Kind]


_FILE = msgspec.toml.decode(Path(__file__).with_suffix(".toml").read_bytes(), type=_File)
GROUPS, PARTS = _FILE.groups, _FILE.parts
# The first cases of a kind, by its name; see kinds/first_cases.toml.
FIRST_CASES = msgspec.toml.decode((Path(__file__).parent / "kinds/first_cases.toml").read_bytes())


def described(name: str) -> dict[str, Any]:
    """Return CheckKind's arguments for a kind of function."""
    kind = _FILE.kinds[name]
    own = msgspec.structs.asdict(kind) | {"name": name, "words": dict(kind.words)}
    for group in own.pop("groups"):
        own["words"] |= GROUPS[group]
    return own
