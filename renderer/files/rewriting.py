"""Put changed tables into a scene file's text; all other text stays as its author wrote it.

tomlkit keeps the comments, but assigns those above a header to the previous table. They are
therefore moved below their header while the tables are changed.
"""

from __future__ import annotations

import re
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

from lucida.renderer.scene.origin import Keys
from lucida.renderer.system.errors import LucidaError

from .tables import MARK, parse_toml
from .toml_writing import toml_text, value_text

LISTS = ("objects", "lights")
_COMMENT = r"[ \t]*#[^\n]*\n"
_HEADER = r"^[ \t]*\[[^\n]*\n"
# The comments directly above a header, and those above them after a blank line.
_ABOVE = re.compile(rf"((?:(?<=\n\n)(?:{_COMMENT}|\n)+)|(?:^{_COMMENT})+)({_HEADER})", re.MULTILINE)
_BELOW = re.compile(rf"({_HEADER})((?:^#\ue000[^\n]*\n)+)", re.MULTILINE)
Tables = dict[str, Any]


class CommentsLostError(LucidaError):
    """The file could only be written without its comments. Nothing was written."""


def rewritten(text: str, old: Tables, old_keys: Keys, new: Tables, new_keys: Keys) -> str | None:
    """Return the text of a scene file with the tables `new` in place of `old`, which it holds.

    old_keys, new_keys: of their objects and lights. The same key means the same table.
    Return None if the change does not fit the arrangement of the tables in the text.
    """
    if new == old and new_keys == old_keys:
        return text
    mark, text = (MARK, text[1:]) if text.startswith(MARK) else ("", text)
    newline = "\r\n" if 0 < text.count("\n") == text.count("\r\n") else "\n"
    text = text.replace(newline, "\n").rstrip("\n") + "\n"
    try:
        file = tomlkit.parse(_ABOVE.sub(_put_below, text))
        _change_table(file, _without_lists(old), _without_lists(new))
        for name, was, now in zip(LISTS, old_keys, new_keys, strict=True):
            if new.get(name) != old.get(name) or was != now:
                before = dict(zip(was, old.get(name, ()), strict=name in old))
                _change_list(file, name, before, dict(zip(now, new[name], strict=True)))
        text = _BELOW.sub(
            lambda found: found[2].replace("#\ue000", "") + found[1], tomlkit.dumps(file)
        )
        if parse_toml(text) != {key: value for key, value in new.items() if key != "lucida"}:
            return None
    except (LucidaError, TOMLKitError, LookupError, TypeError, ValueError, AttributeError):
        return None
    return mark + (text.rstrip("\n") + "\n").replace("\n", newline)


def _put_below(found: re.Match[str]) -> str:
    return found[2] + re.sub("^", "#\ue000", found[1], flags=re.MULTILINE).removesuffix("#\ue000")


def _without_lists(tables: Tables) -> Tables:
    return {key: value for key, value in tables.items() if key not in LISTS}


def _change_table(table: Any, old: Tables, new: Tables) -> None:
    """Change a table of tomlkit from the values `old` to the values `new`."""
    for key in dict.fromkeys([*old, *new]):
        was, now = old.get(key), new.get(key)
        if was == now:
            continue
        if isinstance(was, dict) and isinstance(now, dict):
            _change_table(table[key], was, now)
        elif now is None:
            del table[key]
        elif key == "camera":
            table.append(key, tomlkit.parse(toml_text({key: now}))[key])
        else:
            table[key] = tomlkit.value(value_text(now))


def _change_list(file: Any, name: str, old: dict[int, Tables], new: dict[int, Tables]) -> None:
    """Change the objects or the lights, by their keys."""
    if not old or not new:
        file.pop(name, None)
        if not new:
            file[name] = []
            return
        file.append(name, tomlkit.aot())
        old = {}
    tables = file[name]
    for number, key in reversed([*enumerate(old)]):
        if key in new:
            _change_table(tables[number], old[key], new[key])
        else:
            del tables[number]
    for number, (key, table) in enumerate(new.items()):
        if key not in old:
            made = tomlkit.parse(toml_text({name: [table]}))[name][0]
            made.add(tomlkit.nl())
            if number and not tables[number - 1].as_string().endswith("\n\n"):
                tables[number - 1].add(tomlkit.nl())
            tables.insert(number, made)
