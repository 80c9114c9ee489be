"""Editing scenes: each function takes a scene and returns another one; see changing.py.

    changing    a single change: items (objects and lights by their keys), fields, rebuilding
    outline     the contents of a scene, as a list
    objects     add, delete, duplicate, rename, hide
    moving      objects and lights moved in the world, and their bounds
    materials   change the objects' materials
    documents   the file of a scene, and its unsaved changes

A scene is an immutable value: edits return a new one, and undo keeps the old one.
"""

from .changing import (
    Item,
    as_tables,
    fields_of,
    ids_of,
    item_of,
    present,
    set_field,
    set_scene_field,
    table_of,
)
from .documents import ChangedOnDiskError, file_of, is_unsaved, save, suggested_file
from .materials import set_material
from .moving import bounds_of, shift
from .objects import LIGHTS, SHAPES, add, delete, duplicate, hide, model_table, new_table, rename
from .outline import OutlineRow, outline

__all__ = [
    "LIGHTS",
    "SHAPES",
    "ChangedOnDiskError",
    "Item",
    "OutlineRow",
    "add",
    "as_tables",
    "bounds_of",
    "delete",
    "duplicate",
    "fields_of",
    "file_of",
    "hide",
    "ids_of",
    "is_unsaved",
    "item_of",
    "model_table",
    "new_table",
    "outline",
    "present",
    "rename",
    "save",
    "set_field",
    "set_material",
    "set_scene_field",
    "shift",
    "suggested_file",
    "table_of",
]
