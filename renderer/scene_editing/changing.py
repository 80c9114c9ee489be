"""One change to a scene: other tables in the place of its own, and what is built from them.

Owns items (an object or a light of a scene file, by its key) and fields in tables. A key stays what
it is in all versions of a scene, whatever is moved, deleted or undone; no two items share one.
Scenes and their tables are never written to: what does not change is the same objects in both
scenes, so that renderers see at once what has been changed.
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.files import changed_scene, new_keys
from renderer.scene.model import (
    FileEntry,
    ItemKind,
    Keys,
    Mesh,
    Origin,
    SavedFile,
    Scene,
    SceneObject,
)
from renderer.scene.noting import noting, stamp
from renderer.scene.reading import full_path
from renderer.scene.saving import light_table, scene_tables
from renderer.scene.schema import AnyLight, LightTable, MeshTable, ModelTable, SphereTable
from renderer.scene.tables import to_struct

Item = int  # the key of an object or of a light
Kind = ItemKind
Table = dict[str, Any]

_tabled: weakref.WeakKeyDictionary[Scene, Scene] = weakref.WeakKeyDictionary()


def as_tables(scene: Scene) -> Scene:
    """The same scene with tables, which editing needs: itself where it has some.

    One of a model file alone gets an object of that model: the same objects, of the same arrays.
    Raises LucidaError for a mesh that was made in Python, which is in no file.
    """
    if scene.origin is not None and scene.origin.tables is not None:
        return scene
    if scene not in _tabled:
        _tabled[scene] = _with_tables(scene)
    return _tabled[scene]


def _with_tables(scene: Scene) -> Scene:
    origin = scene.origin or Origin("")
    folder = Path(origin.source).parent if origin.source else Path()
    tables = scene_tables(scene, folder)
    keys = new_keys(len(tables["objects"])), new_keys(len(scene.lights))
    if origin.source:  # a model: it is not read again
        fields = ModelTable(file=tables["objects"][0]["file"])
        made, path = scene.objects, os.path.abspath(origin.source)
        known = FileEntry(0, {}, fields, None, made, made, scene.views, path)
        origin = replace(origin, entries=(known,))
    origin = replace(origin, folder=folder, saved=SavedFile())
    return changed_scene(replace(scene, origin=origin), tables, keys)


def origin_of(scene: Scene) -> tuple[Origin, Table]:
    """Of a scene with tables: where it is from, and these."""
    assert scene.origin is not None and scene.origin.tables is not None, "as_tables() comes first"
    return scene.origin, scene.origin.tables


def with_tables(
    scene: Scene, tables: Table, keys: Keys | None = None, folder: Path | None = None
) -> Scene:
    """The scene of other tables; keys: of their objects and lights, None for those as they were.
    Raises LucidaError where the tables are wrong; the scene stays as it was."""
    scene = as_tables(scene)
    origin, _ = origin_of(scene)
    with noting() as noted:
        changed = changed_scene(scene, tables, origin.keys if keys is None else keys)
    now, _ = origin_of(changed)
    for entry in now.entries:
        if isinstance(entry.fields, ModelTable):
            path = full_path(now.folder / entry.fields.file)
            if path not in now.files and path not in noted:
                noted[path] = stamp(path)  # it was read elsewhere, for this
    return replace(changed, origin=replace(now, files={**now.files, **noted})) if noted else changed


def find(scene: Scene, item: Item) -> tuple[Kind, int]:
    """Which of the file's lists an item is in, and its number there. Raises LucidaError."""
    place = origin_of(as_tables(scene))[0].places.get(item)
    if place is None:
        raise LucidaError("", "is not in this scene any more", "choose another object")
    return place


def present(scene: Scene, items: Iterable[Item]) -> tuple[Item, ...]:
    """Those of the items that the scene has: for a selection, after undo."""
    there = origin_of(as_tables(scene))[0].places
    return tuple(item for item in items if item in there)


def table_of(scene: Scene, item: Item) -> Table:
    """An item's table as in the file: not to be written to."""
    kind, number = find(scene, item)
    table: Table = listed(scene, kind)[number]
    return table


def listed(scene: Scene, kind: Kind) -> list[Any]:
    """The tables of all objects, or of all lights; the default lights' where the file has none."""
    scene = as_tables(scene)
    tables = origin_of(scene)[1]
    if kind == "lights" and "lights" not in tables:
        return [light_table(light) for light in scene.lights]
    entries: list[Any] = tables.get(kind, [])
    return entries


def has_default_lights(scene: Scene) -> bool:
    """Whether the lights are those of scenes whose file names none."""
    return scene.origin is not None and "lights" not in (scene.origin.tables or {"lights": ()})


def fields_of(scene: Scene, item: Item) -> SphereTable | MeshTable | LightTable:
    """All fields of an item with their values, defaults too, as a structure of
    renderer/scene/schema.py: BoxTable, PointLightTable, ..."""
    kind, number = find(scene, item)
    if kind == "objects":
        fields: SphereTable | MeshTable = origin_of(as_tables(scene))[0].entries[number].fields
        return fields
    light: LightTable = to_struct(listed(scene, kind)[number], AnyLight, f"lights[{number}]")
    return light


def entry_of(scene: Scene, item: Item) -> FileEntry:
    """An object's table and what it became. Raises LucidaError for a light."""
    kind, number = find(scene, item)
    if kind != "objects":
        raise LucidaError("", "is a light", "choose an object")
    return origin_of(as_tables(scene))[0].entries[number]


def set_field(scene: Scene, items: Sequence[Item], field: str, value: Any) -> Scene:
    """The scene with one field of some items changed.

    field: as in the file, parts of inner tables after dots: "radius", "checker.size" in a material.
    value: as in the file; tuples and NumPy's numbers are taken as well; None for the default.
    Raises LucidaError naming the field.
    """
    scene = as_tables(scene)
    changed: dict[Kind, list[Any]] = {}
    for item in items:
        kind, number = find(scene, item)
        tables = changed.setdefault(kind, list(listed(scene, kind)))
        tables[number] = with_field(tables[number], field, value)
    return with_listed(scene, changed)


def set_scene_field(scene: Scene, field: str, value: Any) -> Scene:
    """The scene with another name, ambient, background; or another material's field, as in
    "materials.NAME.diffuse". value: as in set_field(). Raises LucidaError naming the field."""
    scene = as_tables(scene)
    return with_tables(scene, with_field(origin_of(scene)[1], field, value))


def with_listed(scene: Scene, changed: dict[Kind, list[Any]], keys: Keys | None = None) -> Scene:
    """The scene with other lists of objects or lights."""
    tables = dict(origin_of(scene)[1])
    for kind, entries in changed.items():
        tables[kind] = entries
    return with_tables(scene, tables, keys)


def with_field(table: Table, field: str, value: Any) -> Table:
    """A table with one field changed; itself where nothing changes. A table inside, or a name in
    its place, makes room for what is set inside."""
    return _with_path(table, field.split("."), plain(value))


def _with_path(table: Table, path: list[str], value: Any) -> Table:
    name, *rest = path
    if not rest:
        if value is None:
            return {key: kept for key, kept in table.items() if key != name}
        return {**table, name: value}
    inner = table.get(name)
    changed = _with_path(inner if isinstance(inner, dict) else {}, rest, value)
    return {**table, name: changed}


def plain(value: Any) -> Any:
    """A value as TOML's reader gives it."""
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, tuple | list):
        return [plain(part) for part in value]
    return value


def ids_of(scene: Scene, item: Item) -> range:
    """The ids of an item's objects in images: one, or one for each part of a model; none for a
    light. Indices of scene.objects."""
    kind, number = find(scene, item)
    if kind == "lights":
        return range(0)
    first_ids = origin_of(as_tables(scene))[0].first_ids
    return range(first_ids[number], first_ids[number + 1])


def item_of(scene: Scene, number: int) -> Item | None:
    """The item of an id in the id image; None for -1, the background, and for what there is not."""
    for entry in origin_of(as_tables(scene))[0].entries:
        if 0 <= number < len(entry.objects):
            return entry.key
        number -= len(entry.objects)
    return None


def triangles_of(objects: Iterable[SceneObject]) -> int:
    return sum(len(entry.shape.faces) for entry in objects if isinstance(entry.shape, Mesh))
