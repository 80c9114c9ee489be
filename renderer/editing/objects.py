"""Add, delete, duplicate, rename and hide objects and lights."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterable, Sequence
from typing import Any

from lucida.renderer.files.scene_file import new_keys
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .changing import Item, Kind, Table, as_tables, find, listed, origin_of, set_field, with_listed

SHAPES = ("sphere", "box", "rectangle", "disk", "cylinder", "cone", "torus")
LIGHTS = ("point", "directional")
KINDS: tuple[Kind, Kind] = ("objects", "lights")


def new_table(
    scene: Scene, kind: str, at: Sequence[float] = (0.0, 0.0, 0.0), size: float = 1.0
) -> Table:
    """Return a table to add for one of SHAPES or LIGHTS, with an unused name.

    A shape is about `size` across and centred on `at`. A directional light shines from `at` to the
    origin.
    """
    half = size / 2
    x, y, z = map(float, at)
    own: dict[str, Table] = {
        "sphere": {"radius": half},
        "box": {"size": size},
        "rectangle": {"width": size, "depth": size},
        "disk": {"radius": half},
        "cylinder": {"radius": half, "height": size},
        "cone": {"radius": half, "height": size},
        "torus": {"radius": 0.7 * half, "tube_radius": 0.3 * half},
        "point": {"position": [x, y, z], "color": [0.8, 0.8, 0.8]},
        "directional": {
            "direction": [-x, -y, -z] if any(at) else [0.5, -0.8, -0.6],
            "color": [0.8, 0.8, 0.8],
        },
    }
    if kind not in own:
        choices = ", ".join(own)
        raise LucidaError("type", f"{kind!r} is unknown", f"give one of {choices}")
    label = f"{kind} light" if kind in LIGHTS else kind
    table = {"type": kind, "name": unused_name(scene, label), **own[kind]}
    if kind in SHAPES:
        table["center" if kind == "sphere" else "translate"] = [x, y, z]
    return table


def model_table(scene: Scene, file: str, at: Sequence[float] = (0.0, 0.0, 0.0)) -> Table:
    """Return a table to add for a model file.

    file: an absolute path, or relative to the scene's folder. To avoid reading the file twice, add
    the table inside read_by(), with the model that was read.
    """
    stem = re.split(r"[/\\]", file)[-1].rsplit(".", 1)[0]
    name = unused_name(scene, stem)
    return {"type": "model", "name": name, "file": file, "translate": list(map(float, at))}


def add(scene: Scene, *tables: Table) -> tuple[Scene, tuple[Item, ...]]:
    """Return the scene with more objects and lights, after its own, and these items.

    A table whose type is in LIGHTS is a light. Raises LucidaError.
    """
    scene = as_tables(scene)
    keys = new_keys(len(tables))
    changed: dict[Kind, list[Any]] = {}
    all_keys = dict(zip(KINDS, map(list, origin_of(scene)[0].keys), strict=True))
    for key, table in zip(keys, tables, strict=True):
        kind: Kind = "lights" if table.get("type") in LIGHTS else "objects"
        changed.setdefault(kind, list(listed(scene, kind))).append(table)
        all_keys[kind].append(key)
    found = with_listed(scene, changed, (tuple(all_keys["objects"]), tuple(all_keys["lights"])))
    return found, keys


def delete(scene: Scene, items: Iterable[Item]) -> Scene:
    """Return the scene without some of its items. Shared materials stay."""
    scene, gone = as_tables(scene), set(items)
    for item in gone:
        find(scene, item)
    changed: dict[Kind, list[Any]] = {}
    kept = []
    for kind, keys in zip(KINDS, origin_of(scene)[0].keys, strict=True):
        kept.append(tuple(key for key in keys if key not in gone))
        if kept[-1] != keys:
            tables = zip(keys, listed(scene, kind), strict=True)
            changed[kind] = [table for key, table in tables if key not in gone]
    return with_listed(scene, changed, (kept[0], kept[1])) if gone else scene


def duplicate(
    scene: Scene, items: Sequence[Item], by: Sequence[float] = (0.0, 0.0, 0.0)
) -> tuple[Scene, tuple[Item, ...]]:
    """Return the scene with copies of items after all others, moved by `by`; and the copies.

    Copies share the arrays, but have names of their own.
    """
    from .moving import shift

    scene = as_tables(scene)
    tables, taken = [], _names(scene)
    for kind, number in (find(scene, item) for item in items):
        table = copy.deepcopy(listed(scene, kind)[number])
        if table.get("name"):
            table["name"] = _unused(table["name"], taken)
            taken.add(table["name"])
        tables.append(table)
    found, copies = add(scene, *tables)
    return (shift(found, copies, by) if any(by) else found), copies


def rename(scene: Scene, item: Item, name: str) -> Scene:
    """Return the scene with an item renamed. name: "" for no name."""
    return set_field(scene, [item], "name", name or None)


def hide(scene: Scene, items: Sequence[Item], hidden: bool = True) -> Scene:
    """Return the scene with some items hidden, or shown. No renderer draws hidden items; ids stay
    the same.
    """
    return set_field(scene, items, "hidden", True if hidden else None)


def unused_name(scene: Scene, name: str) -> str:
    """Return the name, with a number after it if an item of the scene has it."""
    return _unused(name, _names(scene))


def _names(scene: Scene) -> set[str]:
    scene = as_tables(scene)
    return {table.get("name", "") for kind in KINDS for table in listed(scene, kind)}


def _unused(name: str, taken: set[str]) -> str:
    if name not in taken:
        return name
    stem = re.sub(r" \d+$", "", name)
    number = 2
    while f"{stem} {number}" in taken:
        number += 1
    return f"{stem} {number}"
