"""Change the materials of objects.

A changed object gets its own material, because several objects may share a named material in the
scene file.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

from lucida.renderer.files.saving import material_table
from lucida.renderer.scene.model import Scene

from .changing import Item, as_tables, entry_of, find, listed, origin_of, set_field, with_listed


def set_material(scene: Scene, items: Sequence[Item], field: str, value: Any) -> Scene:
    """Return the scene with one field of the items' materials changed, such as "diffuse" or
    "checker.size".

    value: as in set_field(). The items get materials of their own; all parts of a model get the
    same one. Raises LucidaError.
    """
    return set_field(own_material(scene, items), items, f"material.{field}", value)


def own_material(scene: Scene, items: Sequence[Item]) -> Scene:
    """Return the scene with the items' own materials, equal to their present ones."""
    scene = as_tables(scene)
    origin, all_tables = origin_of(scene)
    tables = list(listed(scene, "objects"))
    for item in items:
        entry = entry_of(scene, item)
        own = entry.table.get("material")
        if isinstance(own, dict):
            continue
        if isinstance(own, str):
            own = all_tables["materials"][own]
        elif entry.table["type"] == "model":  # the first part's
            own = material_table(entry.objects[0].material, origin.folder)
        number = find(scene, item)[1]
        tables[number] = {**tables[number], "material": copy.deepcopy(own or {})}
    return with_listed(scene, {"objects": tables})
