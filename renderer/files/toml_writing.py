"""Write tables as TOML 1.0: each section a block, everything inside it on one line."""

from __future__ import annotations

import json
from typing import Any


def toml_text(tables: dict[str, Any]) -> str:
    """Return the text of a scene file: a section for each table, its fields on one line each."""
    lines = [f"{key} = {value_text(v)}" for key, v in tables.items() if _is_plain(key, v)]
    for key, value in tables.items():
        if key == "camera":
            lines += ["", "[camera]", *entries(value)]
        elif key == "materials":
            for name, material in value.items():
                lines += ["", f"[materials.{key_text(name)}]", *entries(material)]
        elif key in ("lights", "objects") and value:
            for entry in value:
                lines += ["", f"[[{key}]]", *entries(entry)]
    return "\n".join(lines).lstrip("\n") + "\n"


def _is_plain(key: str, value: Any) -> bool:
    return key not in ("camera", "materials", "lights", "objects") or value == []


def entries(table: dict[str, Any]) -> list[str]:
    """Return a line for each field."""
    return [f"{name} = {value_text(value)}" for name, value in table.items()]


def value_text(value: Any) -> str:
    """Return a value in TOML 1.0. Numbers are read back exactly."""
    if isinstance(value, str):
        # JSON's strings are also TOML's, except for one character that TOML must escape.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key_text(k)} = {value_text(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(map(value_text, value)) + "]"


def key_text(name: str) -> str:
    """Return a key, in quotes if it needs them."""
    return name if name.isidentifier() and name.isascii() else value_text(name)
