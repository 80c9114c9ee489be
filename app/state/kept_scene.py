"""The unsaved changes of a scene as the text of a scene file, so that they survive a crash."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from lucida.renderer.editing.changing import as_tables, origin_of
from lucida.renderer.editing.documents import is_unsaved
from lucida.renderer.files.saving import relocated
from lucida.renderer.files.tables import VERSION
from lucida.renderer.files.toml_writing import toml_text
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .paths import restored


def unsaved_text(scene: Scene) -> str:
    """Return a scene with unsaved changes as the text of a scene file, with absolute paths.

    Return "" if there are no such changes, or no file can hold the scene.
    """
    if not is_unsaved(scene):
        return ""
    origin, tables = origin_of(as_tables(scene))
    return _text(tables, origin.folder.absolute())


def text_of_older(edited: dict[str, Any]) -> str:
    """Return the same for the data of earlier versions: tables, and the folder of their paths."""
    try:
        return _text(edited["tables"], Path(restored(edited["folder"])))
    except (AttributeError, KeyError, TypeError, ValueError):  # damaged
        return ""


def _text(tables: dict[str, Any], folder: Path) -> str:
    try:
        return toml_text({"lucida": VERSION, **relocated(tables, folder, None)})
    except LucidaError:
        return ""
