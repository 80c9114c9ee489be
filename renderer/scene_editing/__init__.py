"""Editing scenes: each function takes a scene and returns another one; see changing.py.

    changing    a single change: items (objects and lights by their keys), fields, rebuilding
    outline     the contents of a scene, as a list
    objects     add, delete, duplicate, reorder, rename, hide, lock
    moving      conversion between matrices and the file's numbers, for handles
    materials   shared ones and objects' own
    clipping    items as text: copy and paste
    documents   saved and unsaved: the file that a scene belongs to

A scene is an immutable value: edits return a new one, and undo keeps the old one.
"""

from renderer.scene_editing.changing import (
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
from renderer.scene_editing.clipping import copy_text, paste_text
from renderer.scene_editing.documents import (
    ChangedOnDiskError,
    file_of,
    is_unsaved,
    save,
    suggested_file,
)
from renderer.scene_editing.materials import (
    MaterialUse,
    add_material,
    delete_material,
    material_names,
    material_of,
    own_material,
    rename_material,
    set_material,
    set_shared_material,
    share_material,
    use_material,
    users_of,
)
from renderer.scene_editing.moving import bounds_of, matrix_of, place_at, transform
from renderer.scene_editing.objects import (
    LIGHTS,
    SHAPES,
    add,
    delete,
    duplicate,
    hide,
    lock,
    model_table,
    new_table,
    rename,
    reorder,
)
from renderer.scene_editing.outline import ModelPart, OutlineRow, outline

__all__ = [
    "LIGHTS",
    "SHAPES",
    "ChangedOnDiskError",
    "Item",
    "MaterialUse",
    "ModelPart",
    "OutlineRow",
    "add",
    "add_material",
    "as_tables",
    "bounds_of",
    "copy_text",
    "delete",
    "delete_material",
    "duplicate",
    "fields_of",
    "file_of",
    "hide",
    "ids_of",
    "is_unsaved",
    "item_of",
    "lock",
    "material_names",
    "material_of",
    "matrix_of",
    "model_table",
    "new_table",
    "outline",
    "own_material",
    "paste_text",
    "place_at",
    "present",
    "rename",
    "rename_material",
    "reorder",
    "save",
    "set_field",
    "set_material",
    "set_scene_field",
    "set_shared_material",
    "share_material",
    "suggested_file",
    "table_of",
    "transform",
    "use_material",
    "users_of",
]
