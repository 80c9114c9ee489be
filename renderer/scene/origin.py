"""The origin of a scene: its file as it was read, for saving it and for undoing edits.

The renderers do not need it. It is below model.py, whose objects it holds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from pathlib import Path
from typing import Any, Literal

from lucida.renderer.system.file_dependencies import Noted

from .material import Material

ItemKind = Literal["objects", "lights"]
Keys = tuple[tuple[int, ...], tuple[int, ...]]  # of a scene's objects, and of its lights


@dataclass(frozen=True, eq=False)
class FileEntry:
    """One of the [[objects]] of a scene file, and the objects made from it. Never modified.

    key: a number that no other entry has in this process, and that editing keeps.
    table, fields: as in the file, and as a structure of schema.py.
    material: its material, named or inline; None without one.
    made: SceneObjects, its shapes before they were placed; none for a sphere.
    objects: the scene's, in their order; one for each part of a model.
    path: of the model's file, absolute.
    notes: on properties of its textures that are not shown.
    """

    key: int
    table: dict[str, Any]
    fields: Any
    material: Material | None
    made: tuple[Any, ...]
    objects: tuple[Any, ...]
    path: str = ""
    notes: tuple[str, ...] = ()


class SavedFile:
    """The contents of a scene's file when it was last read or written.

    All edited versions of a scene share it, including those that undo restores, so that saving one
    updates all. Only saving changes it, on one window's thread at a time.

    path: None if there is no such file yet.
    text: the file's text, the basis for writing another one; "" for none.
    tables: its contents; None for none yet.
    keys: of its objects and of its lights, in the file's order.
    """

    def __init__(
        self,
        path: Path | None = None,
        text: str = "",
        tables: dict[str, Any] | None = None,
        keys: Keys = ((), ()),
    ) -> None:
        self.path, self.text, self.tables, self.keys = path, text, tables, keys


@dataclass(frozen=True, eq=False)
class Origin:
    """The origin of a scene, for writing it again.

    source: an argument of load_scene, a built-in scene's name or an absolute path; "" for neither.
    tables: of its scene file, as read or edited, never modified; None for a model alone.
    folder: the start of its paths.
    files: the files that it was read from, with their versions; none for a built-in scene.
    entries: one for each of the tables' objects.
    light_keys: one for each of their lights, as FileEntry.key.
    saved: the file itself.
    """

    source: str
    tables: dict[str, Any] | None = None
    folder: Path = Path()
    files: Noted = field(default_factory=dict)
    entries: tuple[FileEntry, ...] = ()
    light_keys: tuple[int, ...] = ()
    saved: SavedFile = field(default_factory=SavedFile)

    @cached_property
    def keys(self) -> Keys:
        """Return the keys of the objects and of the lights."""
        return tuple(entry.key for entry in self.entries), self.light_keys

    @cached_property
    def places(self) -> dict[int, tuple[ItemKind, int]]:
        """Return the list of tables and the index of each item, by its key."""
        kinds: tuple[ItemKind, ItemKind] = ("objects", "lights")
        return {
            key: (kind, number)
            for kind, keys in zip(kinds, self.keys, strict=True)
            for number, key in enumerate(keys)
        }

    @cached_property
    def first_ids(self) -> tuple[int, ...]:
        """Return the first id of each entry in images, and then the number of all ids."""
        return tuple(accumulate((len(entry.objects) for entry in self.entries), initial=0))
