"""Convert TOML to typed structures, with errors that a user can act on.

A syntax error is reported with its line and column, and any other with the path of its field.
"""

from __future__ import annotations

import re
import tomllib
from typing import Any, Literal, get_args, get_origin

import msgspec

from lucida.renderer.scene.limits import KEY_PARTS
from lucida.renderer.system.errors import LucidaError

from .reading import suggestion

MARK = "\ufeff"  # the byte order mark that Windows writes
VERSION = 1  # of the formats of scene and view files: their key `lucida`

_KEY_PART = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_LONG_KEY = re.compile(rf"(?<![\w-]){_KEY_PART}(?:[ \t]*\.[ \t]*{_KEY_PART}){{{KEY_PARTS},}}")
_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|(end of document))\)$")
_NAMES = {
    "float": "a number",
    "int": "a whole number",
    "str": "text in quotes",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
}


def parse_toml(text: str) -> dict[str, Any]:
    """Return the tables of a TOML text. Raises LucidaError with line and column if it is not TOML.

    A key `lucida` above VERSION is reported here, before fields that this program cannot know.
    """
    text = text.removeprefix(MARK)
    # The parser takes quadratic time for keys of many parts.
    if long_key := _LONG_KEY.search(text):
        line = text.count("\n", 0, long_key.start()) + 1
        raise LucidaError(f"line {line}", "has a key of too many parts", "shorten the key")
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _syntax_error(str(error), text) from None
    except RecursionError:
        raise LucidaError("", "is nested too deeply", "write it with fewer brackets") from None
    except ValueError:  # Python's limit on the digits of a number
        raise LucidaError("", "holds a number of too many digits", "shorten it") from None
    check_integers(tables)
    version = tables.pop("lucida", VERSION)
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise LucidaError("lucida", f"{version!r} is not a version", f"give lucida = {VERSION}")
    if version > VERSION:
        raise LucidaError(
            "lucida",
            f"the file has version {version}; this program reads up to {VERSION}",
            "update Lucida, or save the file for the older version",
        )
    return tables


def check_integers(tables: Any, remedy: str = "give one of at most 18 digits") -> None:
    """Raise LucidaError, with the field's path, for an integer of more than 64 bits.

    TOML has none, and most numbers of this program cannot hold it.
    """
    left: list[tuple[str, Any]] = [("", tables)]
    while left:
        path, value = left.pop()
        if isinstance(value, dict):
            left += [(f"{path}.{key}" if path else str(key), part) for key, part in value.items()]
        elif isinstance(value, list):
            left += [(f"{path}[{k}]", part) for k, part in enumerate(value)]
        elif isinstance(value, int) and value.bit_length() > 63:
            problem = f"is a whole number of {len(str(abs(value)))} digits"
            raise LucidaError(path, problem, remedy)


def to_struct(value: Any, kind: Any, prefix: str = "") -> Any:
    """Return the value as a msgspec structure, or one of a union of them. Raises LucidaError with
    the field's path under `prefix`.
    """
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        raise explained(str(error), _chosen(kind, value), prefix) from None
    except RecursionError:
        raise LucidaError(prefix, "is nested too deeply", "write it with fewer brackets") from None


def _syntax_error(message: str, text: str) -> LucidaError:
    place = _PLACE.search(message)
    line, column = (place[1], place[2]) if place else (None, None)
    if line is None:
        lines = text.split("\n")
        line, column = str(len(lines)), str(len(lines[-1]) + 1)
    reason = _PLACE.sub("", message)
    reason = reason[:1].lower() + reason[1:]
    remedy = "correct the TOML there"
    if reason.endswith("twice"):
        name = ".".join(re.findall(r"'(.*?)'", reason))
        remedy = f"keep one, or write all of a list's tables in double brackets: [[{name}]]"
    return LucidaError(f"line {line}, column {column}", reason, remedy)


def explained(message: str, kind: Any = None, prefix: str = "") -> LucidaError:
    """Return msgspec's error in Lucida's words."""
    text, _, path = message.partition(" - at `$")
    path = path.rstrip("`").lstrip(".")
    field = f"{prefix}.{path}" if prefix and path and path[0] != "[" else prefix + path
    kinds = _types_at(kind, path)

    if own := re.fullmatch(r"Object (.*) field `(.*)`", text, re.DOTALL):
        error = LucidaError(own[2], "is missing", "give it")
        if own[1] == "contains unknown":
            error = LucidaError(own[2], "is unknown", suggestion(own[2], _fields(kinds)))
        return error.within(field)
    if choice := re.fullmatch(r"Invalid (enum )?value (.*)", text, re.DOTALL):
        choices = [str(c) for k in kinds if get_origin(k) is Literal for c in get_args(k)]
        if not choice[1]:  # the tag that selects one of several tables
            tables = _structs(_types_at(kind, path.rpartition(".")[0]))
            choices = [str(table.__struct_config__.tag) for table in tables]
        remedy = suggestion(choice[2].strip("'"), choices)
        return LucidaError(field, f"{choice[2]} is unknown", remedy)
    if length := re.fullmatch(r"Expected `array` of length (\d+), got (\d+)", text):
        count = "1 entry" if length[2] == "1" else f"{length[2]} entries"
        return LucidaError(field, f"has {count}", f"give {length[1]}")
    if wrong := re.fullmatch(r"Expected `(.*)`, got `(.*)`", text):
        kinds = [name for name in wrong[1].split(" | ") if name != "null"]
        wanted = " or ".join(_NAMES.get(name, name) for name in kinds)
        return LucidaError(field, f"is {_NAMES.get(wrong[2], 'a ' + wrong[2])}", f"give {wanted}")
    wanted = re.sub("`([a-z]+)`", lambda name: _NAMES.get(name[1], name[1]), text)
    return LucidaError(field, wanted[:1].lower() + wanted[1:], "correct it")


def _types_at(kind: Any, path: str) -> list[Any]:
    """Return the types that a value at `path` below `kind` may have."""
    found = _parts(kind)
    for name in re.findall(r"[a-zA-Z_][^.\[\]]*", path):
        fields = (field for struct in _structs(found) for field in msgspec.structs.fields(struct))
        found = [part for field in fields if field.name == name for part in _parts(field.type)]
    return found


def _chosen(kind: Any, value: Any) -> Any:
    """Return the structure in a tagged union that fits a table; otherwise the same type."""
    for struct in _structs(_parts(kind)):
        config = struct.__struct_config__
        if isinstance(value, dict) and config.tag and value.get(config.tag_field) == config.tag:
            return struct
    return kind


def _parts(kind: Any) -> list[Any]:
    """Return the types in a union or a list."""
    if get_origin(kind) is Literal or not get_args(kind):
        return [kind]
    return [found for part in get_args(kind) for found in _parts(part)]


def _structs(kinds: list[Any]) -> list[type[msgspec.Struct]]:
    return [kind for kind in kinds if isinstance(kind, type) and issubclass(kind, msgspec.Struct)]


def _fields(kinds: list[Any]) -> list[str]:
    names = (
        name
        for struct in _structs(kinds)
        for name in (struct.__struct_config__.tag_field, *struct.__struct_fields__)
        if name
    )
    return list(dict.fromkeys(names))
