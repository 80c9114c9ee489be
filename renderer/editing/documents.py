"""A scene and its file: unsaved changes, and saving without losing anything.

save() checks that the file is still the one that was read.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from lucida.renderer.files.load import SCENE_NAMES
from lucida.renderer.files.reading import full_path, read_file
from lucida.renderer.files.saving import file_tables, relocated, scene_text
from lucida.renderer.files.scene_file import changed_scene
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.scene.origin import SavedFile
from lucida.renderer.system.atomic import atomic_write, file_stem
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.file_dependencies import stamp

from .changing import as_tables, origin_of


class ChangedOnDiskError(LucidaError):
    """The file was changed by another program since it was read; nothing was written."""


def is_unsaved(scene: Scene) -> bool:
    """Return True if the scene differs from its file, as last read or saved.

    A built-in scene is compared with its original, and a scene of only a model with the model.
    """
    origin = scene.origin
    if origin is None or origin.tables is None:
        return False
    saved, tables = origin.saved, origin.tables
    if tables is saved.tables:
        return False
    if saved.tables is None:
        return True
    if saved.path is not None and saved.path.parent != origin.folder:
        tables = relocated(tables, origin.folder, saved.path.parent)
    # The name defaults to the file's, and the camera to one that shows everything, which is saved
    # if it changes.
    default = saved.path.stem if saved.path is not None else scene.name
    if (tables.get("name") or scene.name) != (saved.tables.get("name") or default):
        return True
    own = ["name"] if "camera" in tables else ["name", "camera"]
    return _without(tables, own) != _without(saved.tables, own)


def are_versions(one: Scene, other: Scene) -> bool:
    """Return True if one scene is an edited version of the other, or both are of the same scene."""
    if one is other:
        return True
    origins = one.origin, other.origin
    return all(origins) and origins[0].saved is origins[1].saved  # type: ignore[union-attr]


def file_of(scene: Scene) -> Path | None:
    """Return the file that saving writes without asking; None if the scene has no file yet."""
    return scene.origin.saved.path if scene.origin is not None else None


def suggested_file(scene: Scene) -> Path:
    """Return the file to propose when asking where to save.

    That is the scene's own file; one next to the model; or a name without a folder.
    """
    own = file_of(as_tables(scene))
    if own is not None:
        return own
    source = scene.origin.source if scene.origin is not None else ""
    if source and source not in SCENE_NAMES:
        return Path(source).absolute().with_suffix(".toml")
    return Path(f"{file_stem(scene.name) or 'scene'}.toml")


def save(
    scene: Scene, path: str | Path | None = None, view: View | None = None, force: bool = False
) -> Scene:
    """Save the scene atomically. Return it, now belonging to that file, with the same objects.

    path: None for its own file. The author's text is kept wherever nothing has changed. view: the
    file's camera; None for the scene's own. force: save even if another program has changed the
    scene's own file since it was read; without it, that raises ChangedOnDiskError. Raises
    CommentsLostError if the file's comments cannot be kept, and LucidaError naming the file;
    nothing is lost in that case.
    """
    scene = as_tables(scene)
    chosen = path or file_of(scene)
    if chosen is None:
        raise LucidaError("", "the scene has no file yet", "choose where to save it")
    target = full_path(chosen)
    origin, _ = origin_of(scene)
    saved = origin.saved
    if target == saved.path and not force:
        _check_unchanged(target, saved)
    text, tables = scene_text(scene, target, view), file_tables(scene, target, view)
    if len(text.encode()) > TOML_BYTES:
        raise LucidaError("", "would be too large to be read again", "delete objects", str(target))
    with atomic_write(target) as file:
        file.write(text.encode())
    files = {**origin.files, target: stamp(target)}
    moved = replace(origin, source=str(target), folder=target.parent, files=files)
    found = changed_scene(replace(scene, origin=moved), tables, origin.keys)
    saved.path, saved.text, saved.tables, saved.keys = target, text, tables, origin.keys
    return found if view is None else replace(found, view=view)


def _check_unchanged(path: Path, saved: SavedFile) -> None:
    try:
        now = read_file(path, TOML_BYTES).decode("utf-8", "surrogateescape")
    except LucidaError:
        if path.exists():
            raise
        return  # it was deleted; saving restores it
    if now != saved.text:
        raise ChangedOnDiskError(
            "",
            "was changed by another program since it was read",
            "save under another name, or overwrite it",
            str(path),
        )


def _without(tables: dict[str, Any], keys: list[str]) -> dict[str, Any]:
    return {key: value for key, value in tables.items() if key not in keys}
