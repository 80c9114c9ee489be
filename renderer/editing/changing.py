"""A change to a scene: new tables, and the scene built from them.

An item is an object or a light of a scene file, identified by a key. It keeps its key in all
versions of a scene, even if it is moved, deleted or restored; no two items share one.
Scenes and their tables are never modified. Both scenes share the objects that did not change, so
that renderers detect changes quickly.
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lucida.renderer.files.reading import full_path
from lucida.renderer.files.saving import light_table, scene_tables
from lucida.renderer.files.scene_file import changed_scene, new_keys
from lucida.renderer.files.schema import AnyLight, LightTable, MeshTable, ModelTable, SphereTable
from lucida.renderer.files.tables import to_struct
from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.origin import FileEntry, ItemKind, Keys, Origin, SavedFile
from lucida.renderer.system.errors import LucidaError, under
from lucida.renderer.system.file_dependencies import noting, stamp

Item = int  # the key of an object or of a light
Kind = ItemKind
Table = dict[str, Any]

_tabled: weakref.WeakKeyDictionary[Scene, Scene] = weakref.WeakKeyDictionary()


def as_tables(scene: Scene) -> Scene:
    """Return the same scene with tables, which editing needs: the scene itself if it has them.

    A scene of only a model file gets an object for that model, with the same objects and arrays.
    Raises LucidaError for a mesh made in Python, which is not in any file.
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
    if origin.source:  # a model, which is not read again
        fields = ModelTable(file=tables["objects"][0]["file"])
        made, path = scene.objects, os.path.abspath(origin.source)
        known = FileEntry(0, {}, fields, None, made, made, path)
        origin = replace(origin, entries=(known,))
    origin = replace(origin, folder=folder, saved=SavedFile())
    return changed_scene(replace(scene, origin=origin), tables, keys)


def origin_of(scene: Scene) -> tuple[Origin, Table]:
    """Return the origin and the tables of a scene that has tables."""
    assert scene.origin is not None and scene.origin.tables is not None, "as_tables() comes first"
    return scene.origin, scene.origin.tables


def with_tables(
    scene: Scene, tables: Table, keys: Keys | None = None, folder: Path | None = None
) -> Scene:
    """Return the scene built from other tables.

    keys: of their objects and lights; None to keep the old ones. Raises LucidaError if the tables
    are invalid. The given scene stays unchanged.
    """
    scene = as_tables(scene)
    origin, _ = origin_of(scene)
    with noting() as noted:
        changed = changed_scene(scene, tables, origin.keys if keys is None else keys)
    now, _ = origin_of(changed)
    for entry in now.entries:
        if isinstance(entry.fields, ModelTable):
            path = full_path(now.folder / entry.fields.file)
            if path not in now.files and path not in noted:
                noted[path] = stamp(path)  # it was read elsewhere, for this change
    return replace(changed, origin=replace(now, files={**now.files, **noted})) if noted else changed


def find(scene: Scene, item: Item) -> tuple[Kind, int]:
    """Return the list of the file that an item is in, and its index there. Raises LucidaError."""
    place = origin_of(as_tables(scene))[0].places.get(item)
    if place is None:
        raise LucidaError("", "is not in this scene any more", "select another object")
    return place


def present(scene: Scene, items: Iterable[Item]) -> tuple[Item, ...]:
    """Return the items that are still in the scene, such as a selection's after undo."""
    there = origin_of(as_tables(scene))[0].places
    return tuple(item for item in items if item in there)


def table_of(scene: Scene, item: Item) -> Table:
    """Return an item's table, as in the file. It must not be modified."""
    kind, number = find(scene, item)
    table: Table = listed(scene, kind)[number]
    return table


def listed(scene: Scene, kind: Kind) -> list[Any]:
    """Return the tables of all objects, or of all lights; the default lights' if the file
    has none.
    """
    scene = as_tables(scene)
    tables = origin_of(scene)[1]
    if kind == "lights" and "lights" not in tables:
        return [light_table(light) for light in scene.lights]
    entries: list[Any] = tables.get(kind, [])
    return entries


def fields_of(scene: Scene, item: Item) -> SphereTable | MeshTable | LightTable:
    """Return all fields of an item with their values, including defaults, as a structure of
    renderer/files/schema.py: BoxTable, PointLightTable, ...
    """
    kind, number = find(scene, item)
    if kind == "objects":
        fields: SphereTable | MeshTable = origin_of(as_tables(scene))[0].entries[number].fields
        return fields
    light: LightTable = to_struct(listed(scene, kind)[number], AnyLight, f"lights[{number}]")
    return light


def entry_of(scene: Scene, item: Item) -> FileEntry:
    """Return an object's table and the objects built from it. Raises LucidaError for a light."""
    kind, number = find(scene, item)
    if kind != "objects":
        raise LucidaError("", "is a light", "select an object")
    return origin_of(as_tables(scene))[0].entries[number]


def set_field(scene: Scene, items: Sequence[Item], field: str, value: Any) -> Scene:
    """Return the scene with one field of some items changed.

    field: as in the file, with dots for inner tables: "radius", "checker.size" in a material.
    value: as in the file; tuples and NumPy numbers are also accepted; None for the default. Raises
    LucidaError naming the field.
    """
    return with_changed(scene, items, lambda _item, table: with_field(table, field, value))


def with_changed(
    scene: Scene, items: Sequence[Item], change: Callable[[Item, Table], Table]
) -> Scene:
    """Return the scene with the tables of some items changed. Raises LucidaError as change()
    does.
    """
    scene = as_tables(scene)
    changed: dict[Kind, list[Any]] = {}
    for item in items:
        kind, number = find(scene, item)
        tables = changed.setdefault(kind, list(listed(scene, kind)))
        with under(f"{kind}[{number}]"):
            tables[number] = change(item, tables[number])
    return with_listed(scene, changed)


def set_scene_field(scene: Scene, field: str, value: Any) -> Scene:
    """Return the scene with another name, ambient or background.

    value: as in set_field(). Raises LucidaError naming the field.
    """
    scene = as_tables(scene)
    return with_tables(scene, with_field(origin_of(scene)[1], field, value))


def with_listed(scene: Scene, changed: dict[Kind, list[Any]], keys: Keys | None = None) -> Scene:
    """Return the scene with other lists of objects or lights."""
    tables = dict(origin_of(scene)[1])
    for kind, entries in changed.items():
        tables[kind] = entries
    return with_tables(scene, tables, keys)


def with_field(table: Table, field: str, value: Any) -> Table:
    """Return a table with one field changed.

    Setting a field of an inner table replaces a name in its place by a table.
    """
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
    """Return a value as TOML's reader would return it."""
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, tuple | list):
        return [plain(part) for part in value]
    return value


def ids_of(scene: Scene, item: Item) -> range:
    """Return the ids of an item's objects in images: one, or one per part of a model; none for a
    light.

    Ids are indices into scene.objects.
    """
    kind, number = find(scene, item)
    if kind == "lights":
        return range(0)
    first_ids = origin_of(as_tables(scene))[0].first_ids
    return range(first_ids[number], first_ids[number + 1])


def item_of(scene: Scene, number: int) -> Item | None:
    """Return the item of an id in the id image; None for -1, the background, and for an
    unknown id.
    """
    for entry in origin_of(as_tables(scene))[0].entries:
        if 0 <= number < len(entry.objects):
            return entry.key
        number -= len(entry.objects)
    return None
