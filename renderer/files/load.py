"""Load a scene by the name that a user types: a built-in scene or a file."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.origin import Origin
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.file_dependencies import Noted, noting

from .models.models import model_scene
from .reading import MODEL_ENDINGS, absence, full_path, path_of, suggestion
from .scene_file import read_scene_file

BUILTIN_SCENES = (
    "still-life",
    "canonical",
    "columns",
    "spheres",
    "primitives",
)  # the default first
EMPTY_SCENE = "empty"
SCENE_NAMES = (*BUILTIN_SCENES, EMPTY_SCENE)
SCENE_ENDINGS = (".toml", *MODEL_ENDINGS)

_BUILTIN_FOLDER = Path(__file__).parent / "builtin"


def load_scene(source: str | Path) -> Scene:
    """Return the scene of a built-in name, a scene file (.toml) or a model file.

    A built-in name wins over a file of the same name; write ./name for the file. A model file alone
    gets the default lights and a view that shows all of it. Raises LucidaError naming the file, the
    field and the remedy.
    """
    path = path_of(source, "scene")
    if source in SCENE_NAMES:
        return _from(str(source), read_scene_file(_BUILTIN_FOLDER / f"{source}.toml"), {})
    if not str(source):
        raise LucidaError("scene", "'' is empty", suggestion("", BUILTIN_SCENES))
    ending = path.suffix.lower()
    if ending in SCENE_ENDINGS:
        with noting() as noted:
            scene = read_scene_file(path) if ending == ".toml" else model_scene(path)
        noted = {full_path(file): found for file, found in noted.items()}
        return _from(str(full_path(path)), scene, noted)
    endings = f"files ending in {' '.join(SCENE_ENDINGS)}"
    if os.path.exists(path):
        problem = f"ends in {ending!r}" if ending else "has no ending"
        raise LucidaError("", problem, f"give {endings}", str(path))
    if ending or path.parent != Path():
        remedy = f"check its name and folder; scenes are {endings}"
        raise LucidaError("", absence(path), remedy, str(path))
    problem = f"{str(source)[:80]!r} is neither a built-in scene nor a file"
    remedy = f"{suggestion(str(source), BUILTIN_SCENES)} or {endings}"
    raise LucidaError("scene", problem, remedy)


def _from(source: str, scene: Scene, files: Noted) -> Scene:
    origin = replace(scene.origin or Origin(""), source=source, files=files)
    if origin.tables is not None and source not in SCENE_NAMES:
        origin.saved.path = Path(source)
        origin = replace(origin, folder=origin.saved.path.parent)
    return replace(scene, origin=origin)
