"""The modules of a page as one text: a page from a disk cannot import files.

A module imports names with `import { a, b } from "./file.js";` and exports declarations. All
modules share one scope in the page, so no two may declare the same name.
"""

from __future__ import annotations

import re
from importlib.resources import files

IMPORT = re.compile(r'^import (?:\{[^}]*\} from )?"\./([\w]+\.js)";\n', re.MULTILINE)
EXPORT = re.compile(r"^export ", re.MULTILINE)
DECLARED = re.compile(r"^(?:async )?(?:function\*?|class|const|let) +(\w+)", re.MULTILINE)


def read_module(name: str) -> str:
    """Return the text of a file in app/web/modules."""
    return files("lucida.app.web").joinpath("modules", name).read_text(encoding="utf-8")


def bundle(entry: str) -> str:
    """Return a module with all its imports. Each occurs once, before its first user.

    Raises ValueError for a name that two modules declare, and for circular imports.
    """
    texts: dict[str, str] = {}
    _add(entry, texts, ())
    owners: dict[str, str] = {}
    for name, text in texts.items():
        for declared in DECLARED.findall(text):
            if owners.setdefault(declared, name) != name:
                raise ValueError(f"{declared} is declared in {owners[declared]} and in {name}")
    return "".join(f"// {name}\n{text}\n" for name, text in texts.items())


def _add(name: str, texts: dict[str, str], users: tuple[str, ...]) -> None:
    if name in texts:
        return
    if name in users:
        raise ValueError(f"modules import each other in a circle: {', '.join((*users, name))}")
    text = read_module(name)
    for needed in IMPORT.findall(text):
        _add(needed, texts, (*users, name))
    texts[name] = EXPORT.sub("", IMPORT.sub("", text))
