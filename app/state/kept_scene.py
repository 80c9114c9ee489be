"""An edited scene in a session file, so that unsaved changes survive the end of the window."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lucida.app.state.paths import restored, stored
from lucida.renderer.editing.changing import as_tables, origin_of
from lucida.renderer.editing.documents import is_unsaved
from lucida.renderer.files.saving import relocated
from lucida.renderer.files.scene_file import changed_scene, new_keys
from lucida.renderer.files.tables import VERSION, parse_toml
from lucida.renderer.files.toml_writing import toml_text
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.scene.origin import Keys, Origin, SavedFile
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.file_dependencies import noting, stamp

MOST_RESCUED = 1000


@dataclass(frozen=True)
class KeptScene:
    """A scene whose tables differ from its file's. Paths are as paths.stored() writes them.

    source, file, folder: as in Origin and SavedFile; file is "" if there is none.
    text: the file's text when it was last read or saved.
    objects, lights: the number of each table's entry in that text; -1 for a new one.
    view: the scene's own.
    """

    source: str
    file: str
    folder: str
    name: str
    view: View
    tables: dict[str, Any]
    text: str = ""
    objects: tuple[int, ...] = ()
    lights: tuple[int, ...] = ()

    def scene(self) -> Scene:
        """Return the scene as it was. Reads its models. Raises LucidaError."""
        base = parse_toml(self.text.removeprefix("\ufeff")) if self.text else None
        was: list[tuple[int, ...]] = []
        now: list[tuple[int, ...]] = []
        for kind, numbers in (("objects", self.objects), ("lights", self.lights)):
            count = max(len((base or {}).get(kind, ())), max(numbers, default=-1) + 1)
            keys = new_keys(count)
            was.append(keys)
            now.append(tuple(keys[n] if n >= 0 else new_keys(1)[0] for n in numbers))
        file = Path(restored(self.file)) if self.file else None
        saved = SavedFile(file, self.text, base, (was[0], was[1]))
        with noting() as noted:
            if file is not None:
                noted[file] = stamp(file)
            origin = Origin(
                restored(self.source), None, Path(restored(self.folder)), noted, saved=saved
            )
            empty = Scene((), view=self.view, name=self.name, origin=origin)
            return changed_scene(empty, self.tables, (now[0], now[1]))

    def rescue(self, folder: Path) -> Path | None:
        """Write a scene that cannot be opened to a new file in a folder, so that nothing is lost.
        Return its path, or None if that fails.
        """
        tables = relocated(self.tables, Path(restored(self.folder)), None)
        free = (folder / f"unsaved-{number}.toml" for number in range(1, MOST_RESCUED))
        path = next((path for path in free if not path.exists()), None)
        try:
            if path is not None:
                with atomic_write(path) as file:
                    file.write(toml_text({"lucida": VERSION, **tables}).encode())
        except (LucidaError, UnicodeEncodeError):
            return None
        return path


def kept_scene(scene: Scene) -> KeptScene | None:
    """Return what to keep of a scene in addition to its source; None if its file has all of it."""
    if not is_unsaved(scene):
        return None
    origin, tables = origin_of(as_tables(scene))
    saved = origin.saved
    return KeptScene(
        stored(origin.source),
        stored(str(saved.path)) if saved.path is not None else "",
        stored(str(origin.folder.absolute())),
        scene.name,
        scene.view,
        tables,
        saved.text,
        *_numbers(origin.keys, saved),
    )


def _numbers(keys: Keys, saved: SavedFile) -> tuple[tuple[int, ...], tuple[int, ...]]:
    found = []
    for mine, its in zip(keys, saved.keys, strict=True):
        number = {key: k for k, key in enumerate(its)} if saved.text else {}
        found.append(tuple(number.get(key, -1) for key in mine))
    return found[0], found[1]
