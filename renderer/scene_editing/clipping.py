"""Copy and paste: objects and lights as text, in the TOML of scene files.

This also works between two windows, and from a scene file or a mail: pasted text is checked in the
same way as a file.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

from renderer.errors import LucidaError
from renderer.scene.limits import TOML_BYTES
from renderer.scene.model import Scene
from renderer.scene.saving import brought_into, relocated
from renderer.scene.tables import parse_toml
from renderer.scene.toml_writing import toml_text
from renderer.scene_editing.changing import (
    Item,
    Table,
    as_tables,
    find,
    listed,
    origin_of,
    with_tables,
)
from renderer.scene_editing.objects import add, named_anew

KINDS = ("materials", "objects", "lights")


def copy_text(scene: Scene, items: Sequence[Item]) -> str:
    """Return items as TOML, with the shared materials that they name.

    Files have absolute paths, so that they are found wherever the text is pasted.
    """
    scene = as_tables(scene)
    origin, tables = origin_of(scene)
    found: dict[str, Any] = {"materials": {}, "objects": [], "lights": []}
    for kind, number in sorted((find(scene, item) for item in items), reverse=True):
        table = listed(scene, kind)[number]
        found[kind].insert(0, table)
        if isinstance(name := table.get("material"), str):
            found["materials"][name] = tables["materials"][name]
    found = {kind: tables for kind, tables in found.items() if tables}
    return toml_text(relocated(found, origin.folder, None))


def paste_text(scene: Scene, text: str) -> tuple[Scene, tuple[Item, ...]]:
    """Return the scene with the objects and lights of a text after its own, and these items.

    Materials are pasted, too. If the scene has an equal one of that name, it is used; if it has a
    different one, the pasted material is renamed. Objects and lights are also renamed. Raises
    LucidaError if the text is not TOML, holds anything else, or is empty.
    """
    scene = as_tables(scene)
    if len(text) > TOML_BYTES:
        raise LucidaError("", f"the text has {len(text)} characters", "paste less at once")
    tables = parse_toml(text)
    _check(tables)
    origin, own = origin_of(scene)
    tables = brought_into(tables, origin.folder)
    names, materials = _materials(own.get("materials", {}), tables.get("materials", {}))
    objects = []
    for table in tables.get("objects", []):
        given = table.get("material")
        is_pasted = isinstance(given, str) and given in names
        objects.append({**table, "material": names[given]} if is_pasted else table)
    found = [*objects, *tables.get("lights", [])]
    if materials != own.get("materials", {}):
        scene = with_tables(scene, {**own, "materials": materials})
    return add(scene, *named_anew(scene, found))


def _check(tables: Table) -> None:
    """Check the outer structure; the contents are checked when the scene is built."""
    for name in tables:
        if name not in KINDS:
            remedy = f"paste {', '.join(KINDS[:2])} and {KINDS[2]}"
            raise LucidaError(name, "cannot be pasted into a scene", remedy)
    for kind in KINDS[1:]:
        entries = tables.get(kind, [])
        if not isinstance(entries, list) or not all(isinstance(e, dict) for e in entries):
            raise LucidaError(kind, "is not a list of tables", f"write [[{kind}]]")
        for number, entry in enumerate(entries):
            is_light = entry.get("type") in ("point", "directional")
            if is_light != (kind == "lights"):
                where = f"{kind}[{number}].type"
                raise LucidaError(where, f"{entry.get('type')!r} is not one", "correct it")
    if not isinstance(tables.get("materials", {}), dict):
        raise LucidaError("materials", "is not a table", "write [materials.NAME]")
    if not any(tables.get(kind) for kind in KINDS[1:]):
        raise LucidaError("", "the text holds no objects and no lights", "copy some first")


def _materials(own: Table, pasted: Table) -> tuple[dict[str, str], Table]:
    """Return the new names of pasted materials by their old ones, and all materials."""
    names: dict[str, str] = {}
    found = dict(own)
    for name, table in pasted.items():
        new, number = name, 2
        while new in found and found[new] != table:
            new, number = f"{name} {number}", number + 1
        names[name], found[new] = new, copy.deepcopy(table)
    return names, found
