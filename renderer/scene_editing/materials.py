"""Materials: shared ones, which have a name and may be used by several objects, and objects' own.

Whoever changes the material of one object says whether all that share it change with it.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from renderer.errors import LucidaError
from renderer.scene.model import Material, Scene
from renderer.scene.saving import material_table
from renderer.scene_editing.changing import (
    Item,
    Table,
    as_tables,
    entry_of,
    find,
    listed,
    origin_of,
    set_field,
    with_field,
    with_tables,
)


@dataclass(frozen=True)
class MaterialUse:
    """What an object is made of. name: of a shared material, "" for its own. users: all items that
    share it, the object too. material: as it is drawn; of a model's parts without one of the scene
    file, that of the first. is_models: the parts have what the model file gives them."""

    name: str
    users: tuple[Item, ...]
    material: Material
    is_models: bool = False


def material_of(scene: Scene, item: Item) -> MaterialUse:
    """Raises LucidaError for a light."""
    entry = entry_of(scene, item)
    named, material = entry.fields.material, entry.objects[0].material
    name = named if isinstance(named, str) else ""
    users = users_of(scene, name) if name else (item,)
    return MaterialUse(name, users, material, named is None and entry.table["type"] == "model")


def users_of(scene: Scene, name: str) -> tuple[Item, ...]:
    """The objects that share a material."""
    entries = origin_of(as_tables(scene))[0].entries
    return tuple(entry.key for entry in entries if entry.fields.material == name)


def material_names(scene: Scene) -> tuple[str, ...]:
    """Of the shared materials, in the file's order."""
    return tuple(_materials(as_tables(scene)))


def set_material(
    scene: Scene, items: Sequence[Item], field: str, value: Any, for_all: bool
) -> Scene:
    """The scene with one field of the items' materials changed, such as "diffuse" or
    "checker.size"; value: as set_field() takes it. for_all: whatever shares a material with them
    changes too; False: they get materials of their own. A model's parts all get that material.
    Raises LucidaError."""
    scene = as_tables(scene)
    names = {name for item in items if (name := material_of(scene, item).name)}
    if for_all:
        materials = _materials(scene)
        for name in names:
            materials = {**materials, name: with_field(materials[name], field, value)}
        if names:
            scene = with_tables(scene, {**origin_of(scene)[1], "materials": materials})
    own = [item for item in items if not (for_all and material_of(scene, item).name)]
    if not own:
        return scene
    return set_field(own_material(scene, own), own, f"material.{field}", value)


def own_material(scene: Scene, items: Sequence[Item]) -> Scene:
    """The scene with materials of the items' own, which look as theirs did."""
    scene = as_tables(scene)
    tables = list(listed(scene, "objects"))
    for item in items:
        number = find(scene, item)[1]
        given = entry_of(scene, item).table.get("material")
        if isinstance(given, dict):
            continue
        use = material_of(scene, item)
        own = _materials(scene)[use.name] if use.name else {}
        if use.is_models:
            own = material_table(use.material, origin_of(scene)[0].folder)
        tables[number] = {**tables[number], "material": copy.deepcopy(own)}
    return with_tables(scene, {**origin_of(scene)[1], "objects": tables})


def use_material(scene: Scene, items: Sequence[Item], name: str | None) -> Scene:
    """The scene with a shared material for some objects; None: the default, or a model's own."""
    return set_field(scene, items, "material", name)


def share_material(scene: Scene, item: Item, name: str) -> Scene:
    """The scene with an object's material under a name, for others to use. Raises LucidaError where
    the name is taken, or empty."""
    scene = own_material(scene, [item])
    table = entry_of(scene, item).table["material"]
    scene = add_material(scene, name, table)
    return use_material(scene, [item], name)


def add_material(scene: Scene, name: str, table: Table) -> Scene:
    """The scene with one more shared material. Raises LucidaError."""
    scene = as_tables(scene)
    materials = _materials(scene)
    _check_new(name, materials)
    return with_tables(scene, {**origin_of(scene)[1], "materials": {**materials, name: table}})


def rename_material(scene: Scene, old: str, new: str) -> Scene:
    """The scene with a shared material under another name, by which its objects name it then."""
    scene = as_tables(scene)
    materials = _materials(scene)
    _check_there(old, materials)
    _check_new(new, materials)
    users = set(users_of(scene, old))
    origin, tables = origin_of(scene)
    objects = [
        {**entry.table, "material": new} if entry.key in users else entry.table
        for entry in origin.entries
    ]
    renamed = {new if name == old else name: table for name, table in materials.items()}
    return with_tables(scene, {**tables, "materials": renamed, "objects": objects})


def delete_material(scene: Scene, name: str) -> Scene:
    """The scene without a shared material. Raises LucidaError where an object uses it."""
    scene = as_tables(scene)
    materials = _materials(scene)
    _check_there(name, materials)
    if users := users_of(scene, name):
        count = f"{len(users)} object" + "s" * (len(users) > 1)
        raise LucidaError(f"materials.{name}", f"is used by {count}", "give them another material")
    left = {key: table for key, table in materials.items() if key != name}
    tables = {**origin_of(scene)[1], "materials": left}
    if not left:  # a file has no place for an empty table of sections
        del tables["materials"]
    return with_tables(scene, tables)


def set_shared_material(scene: Scene, name: str, field: str, value: Any) -> Scene:
    """The scene with one field of a shared material changed, used or not. Raises LucidaError."""
    scene = as_tables(scene)
    materials = _materials(scene)
    _check_there(name, materials)
    changed = {**materials, name: with_field(materials[name], field, value)}
    return with_tables(scene, {**origin_of(scene)[1], "materials": changed})


def _materials(scene: Scene) -> dict[str, Table]:
    materials: dict[str, Table] = origin_of(scene)[1].get("materials", {})
    return materials


def _check_there(name: str, materials: dict[str, Table]) -> None:
    if name not in materials:
        raise LucidaError("material", f"{name[:40]!r} is unknown", "choose another one")


def _check_new(name: str, materials: dict[str, Table]) -> None:
    if not name or name in materials:
        problem = f"{name[:40]!r} is taken" if name else "has no name"
        raise LucidaError("material", problem, "give another name")
