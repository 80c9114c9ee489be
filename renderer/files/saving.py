"""Save scenes: the TOML file that loads as the same scene.

A scene from a scene file keeps its author's text, with new paths of its models. A scene of a model
file alone, or one made in Python, is written from its parts.
"""

from __future__ import annotations

import contextlib
import copy
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lucida.renderer.scene import framing
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    DirectionalLight,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
    View,
)
from lucida.renderer.scene.origin import Origin
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError, under

from .load import BUILTIN_SCENES
from .reading import full_path
from .rewriting import CommentsLostError, rewritten
from .tables import VERSION
from .toml_writing import toml_text
from .views import view_table

FILES = ("file", "texture", "metal")  # keys whose text names a file


def save_scene(path: str | Path, scene: Scene, view: View | None = None) -> None:
    """Write a scene file atomically. load_scene returns the same scene.

    view: the file's camera; None for the scene's own.

    Models are named by their paths, relative to the new file if they are below its folder. Raises
    LucidaError naming the file, or the object that the format cannot hold.
    """
    text = scene_text(scene, full_path(path), view)
    with atomic_write(path) as file:
        file.write(text.encode())


def scene_text(scene: Scene, path: Path, view: View | None = None) -> str:
    """Return the text of a scene file at `path`, which is absolute. Unchanged parts stay as their
    author wrote them.

    Raises LucidaError, or CommentsLostError if the scene's own file would lose its comments.
    """
    tables, origin = file_tables(scene, path, view), scene.origin
    if origin is not None and (saved := origin.saved).tables is not None and saved.text:
        text = rewritten(saved.text, saved.tables, saved.keys, tables, origin.keys)
        if text is not None:
            return text
        if path == saved.path:
            problem = "would lose its comments: they cannot be kept in this arrangement of tables"
            raise CommentsLostError("", problem, "save the scene as a new file", str(path))
    return toml_text({"lucida": VERSION, **tables})


def file_tables(scene: Scene, path: Path, view: View | None = None) -> dict[str, Any]:
    """Return scene_tables() for a file at `path`, without the values that the file would have by
    default.
    """
    tables = scene_tables(scene, path.parent, view)
    given = scene.origin.tables if scene.origin is not None else None
    if given is None:
        return tables
    if "name" not in given and scene.name == path.stem:
        del tables["name"]
    if "camera" not in given and view in (None, scene.view):
        with contextlib.suppress(LucidaError):
            if framing.framing_view([entry for _, entry in scene.visible]) == scene.view:
                del tables["camera"]
    return tables


def scene_tables(scene: Scene, folder: Path, view: View | None = None) -> dict[str, Any]:
    """Return a scene as the tables of a scene file in `folder`.

    view: its new camera, if it is not the scene's own. Raises LucidaError.
    """
    origin = scene.origin
    if origin is not None and origin.tables is not None:
        tables = {"name": scene.name, **relocated(origin.tables, origin.folder, folder)}
        _check_images(tables)
    else:
        tables = {
            "name": scene.name,
            "ambient": list(scene.ambient),
            "background": list(scene.background),
            "objects": _objects(scene, origin, folder),
            "lights": [light_table(light) for light in scene.lights],
        }
    if "camera" not in tables or view not in (None, scene.view):
        tables["camera"] = view_table(scene.view if view is None else view)
    order = ("name", "ambient", "background", "camera", "materials", "lights", "objects")
    return {key: tables[key] for key in order if key in tables}


def _objects(scene: Scene, origin: Origin | None, folder: Path) -> list[dict[str, Any]]:
    if origin is not None and origin.source and origin.source not in BUILTIN_SCENES:
        return [{"type": "model", "file": path_text(Path(origin.source), folder)}]
    return [_object(number, entry, folder) for number, entry in enumerate(scene.objects)]


def _object(number: int, entry: SceneObject, folder: Path) -> dict[str, Any]:
    if not isinstance(entry.shape, Sphere):
        raise LucidaError(
            f"objects[{number}]",
            f"{entry.name or 'a mesh'!r} is a mesh made in Python, which is in no file",
            "save the mesh as a model file and load that",
        )
    table: dict[str, Any] = {"type": "sphere", "name": entry.name}
    table |= {"center": list(entry.shape.center), "radius": entry.shape.radius}
    with under(f"objects[{number}].material"):
        return table | {"material": material_table(entry.material, folder)}


def material_table(material: Material, folder: Path) -> dict[str, Any]:
    """Return a material as a table of a scene file in `folder`, including default values. Raises
    LucidaError for an image that is in no file, or not in that folder.
    """
    table: dict[str, Any] = {
        "diffuse": list(material.diffuse),
        "specular": list(material.specular),
        "shininess": material.shininess,
    }
    if (checker := material.checker) is not None:
        table["checker"] = {"diffuse": list(checker.diffuse), "size": checker.size}
    if (texture := material.texture) is not None:
        table["texture"] = {
            "file": _image_path("texture", texture.file, folder),
            "wrap": list(texture.wrap),
            "scale": list(texture.scale),
            "offset": list(texture.offset),
        }
        if texture.rotate_deg:
            table["texture"]["rotate_deg"] = texture.rotate_deg
    if (metal := material.metal) is not None:
        table["metal"] = {"metalness": metal.metalness, "roughness": metal.roughness}
        if not metal.is_everywhere:
            table["metal"]["file"] = _image_path("metal", metal.file, folder)
    if material.cutout is not None:
        table["cutout"] = material.cutout
    if material.single_sided:
        table["single_sided"] = True
    _check_images(table)
    return table


def _image_path(field: str, file: Path | None, folder: Path) -> str:
    if file is None:
        problem = "is an image that was made in Python, or is inside another file"
        raise LucidaError(field, problem, "save it, and load the scene with it")
    return path_text(file, folder)


def _files(value: Any, where: str = "") -> Iterator[tuple[str, dict[str, Any], str]]:
    """Yield the place, the table and the key of each file that a scene file's tables name."""
    for key, part in value.items() if isinstance(value, dict) else enumerate(value):
        place = f"{where}[{key}]" if isinstance(key, int) else f"{where}.{key}".lstrip(".")
        if isinstance(part, dict | list):
            yield from _files(part, place)
        elif key in FILES and isinstance(part, str):
            yield place, value, key


def _check_images(tables: dict[str, Any]) -> None:
    """Check that images are below the folder of their scene file, which may name no others."""
    for place, table, key in _files(tables):
        if table.get("type") != "model" and Path(table[key]).is_absolute():
            raise LucidaError(
                place.removesuffix(".file"),
                f"{Path(table[key]).name!r} is not in the new file's folder",
                "save the scene where its images are",
            )


def light_table(light: PointLight | DirectionalLight) -> dict[str, Any]:
    """Return a light as one of [[lights]]."""
    color = {"color": list(light.color)}
    if isinstance(light, PointLight):
        return {"type": "point", "position": list(light.position), **color}
    return {"type": "directional", "direction": list(light.direction), **color}


def relocated(tables: dict[str, Any], old: Path, new: Path | None) -> dict[str, Any]:
    """Return a scene file's tables with their paths relative to another folder, or absolute if it
    is None.
    """
    if new == old:
        return tables
    found = copy.deepcopy(tables)
    for _, table, key in _files(found):
        table[key] = path_text(old / table[key], new)
    return found


def path_text(file: Path, folder: Path | None) -> str:
    """Return a file's path for a scene file in `folder`: relative if the file is below it, or else
    absolute.
    """
    file = Path(os.path.abspath(file))
    is_below = folder is not None and file.is_relative_to(folder)
    name = file.relative_to(folder).as_posix() if is_below and folder else str(file)
    try:
        name.encode()
    except UnicodeEncodeError:
        problem = f"the model's name is not UTF-8, as scene files are: {name}"
        raise LucidaError("", problem, "rename the model") from None
    return name
