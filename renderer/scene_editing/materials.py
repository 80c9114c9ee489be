"""Materials: shared ones, which have a name and may be used by several objects, and objects' own.

A change of one object's material can be for all objects that share it, or for this one only.
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
    """An object's material.

    name: of a shared material, "" for its own. users: all items that share it, including the
    object. material: as drawn; that of the first part for a model's parts without one from the
    scene file. is_models: the parts have the model file's materials.
    """

    name: str
    users: tuple[Item, ...]
    material: Material
    is_models: bool = False


def material_of(scene: Scene, item: Item) -> MaterialUse:
    """Return an object's material. Raises LucidaError for a light."""
    entry = entry_of(scene, item)
    named, material = entry.fields.material, entry.objects[0].material
    name = named if isinstance(named, str) else ""
    users = users_of(scene, name) if name else (item,)
    return MaterialUse(name, users, material, named is None and entry.table["type"] == "model")


def users_of(scene: Scene, name: str) -> tuple[Item, ...]:
    """Return the objects that share a material."""
    entries = origin_of(as_tables(scene))[0].entries
    return tuple(entry.key for entry in entries if entry.fields.material == name)


def material_names(scene: Scene) -> tuple[str, ...]:
    """Return the names of the shared materials, in the file's order."""
    return tuple(_materials(as_tables(scene)))


def set_material(
    scene: Scene, items: Sequence[Item], field: str, value: Any, for_all: bool
) -> Scene:
    """Return the scene with one field of the items' materials changed, such as "diffuse" or
    "checker.size".

    value: as in set_field(). for_all: change it for all objects that share a material with them;
    otherwise the items get their own materials. A model's parts all get that material. Raises
    LucidaError.
    """
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


def set_single_sided(scene: Scene, items: Sequence[Item], value: bool, for_all: bool) -> Scene:
    """Return the scene with the items' backs hidden or visible.

    A model's own materials stay unchanged: its object has a switch for all of them. for_all: as in
    set_material().
    """
    scene = as_tables(scene)
    models = [item for item in items if entry_of(scene, item).table["type"] == "model"]
    others = [item for item in items if item not in models]
    if models:
        scene = set_field(scene, models, "single_sided", value)
    if others:
        scene = set_material(scene, others, "single_sided", value or None, for_all)
    return scene


def own_material(scene: Scene, items: Sequence[Item]) -> Scene:
    """Return the scene with the items' own materials, equal to their present ones."""
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
    """Return the scene with a shared material for some objects; None for the default, or a model's
    own.
    """
    return set_field(scene, items, "material", name)


def share_material(scene: Scene, item: Item, name: str) -> Scene:
    """Return the scene with an object's material under a name, for other objects to use.

    Raises LucidaError if the name is taken or empty.
    """
    scene = own_material(scene, [item])
    table = entry_of(scene, item).table["material"]
    scene = add_material(scene, name, table)
    return use_material(scene, [item], name)


def add_material(scene: Scene, name: str, table: Table) -> Scene:
    """Return the scene with one more shared material. Raises LucidaError."""
    scene = as_tables(scene)
    materials = _materials(scene)
    _check_new(name, materials)
    return with_tables(scene, {**origin_of(scene)[1], "materials": {**materials, name: table}})


def rename_material(scene: Scene, old: str, new: str) -> Scene:
    """Return the scene with a shared material renamed, also in the objects that use it."""
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
    """Return the scene without a shared material. Raises LucidaError if an object uses it."""
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
    """Return the scene with one field of a shared material changed, used or not. Raises
    LucidaError.
    """
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
