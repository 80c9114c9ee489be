"""Writing a scene down: the TOML file that loads back to the same scene.

Owns the way from a scene to the tables of schema.py. A scene that was read from a scene file is
written as it stood there, with models named by where they are; one of a model file alone, or made
in Python, from its parts. Knows nothing of how files are read.
"""

from __future__ import annotations

import copy
import json
import os
from pathlib import Path
from typing import Any

from renderer.atomic import atomic_write
from renderer.errors import LucidaError
from renderer.scene.load import BUILTIN_SCENES
from renderer.scene.model import Material, Origin, PointLight, Scene, SceneObject, Sphere, View
from renderer.scene.tables import VERSION
from renderer.scene.views import view_table


def save_scene(path: str | Path, scene: Scene, view: View | None = None) -> None:
    """Writes a scene file: whole or not at all. load_scene gives back the same scene.

    view: what the file's camera is to be; None for the scene's own. Models are named by their
    paths, relative to the new file where they lie below its folder. Raises LucidaError naming
    the file, or the object that the format cannot hold.
    """
    folder = Path(path).absolute().parent
    text = _toml({"lucida": VERSION, **scene_tables(scene, folder, view)})
    with atomic_write(path) as file:
        file.write(text.encode())


def scene_tables(scene: Scene, folder: Path, view: View | None = None) -> dict[str, Any]:
    """A scene as the tables of a scene file in `folder`. Raises LucidaError."""
    origin = scene.origin
    if origin is not None and origin.tables is not None:
        tables = copy.deepcopy(origin.tables)
        for entry in tables.get("objects", []):
            if isinstance(entry.get("file"), str):
                entry["file"] = _path(origin.folder / entry["file"], folder)
        _move_textures(tables, origin.folder, folder)
        tables.setdefault("name", scene.name)
    else:
        tables = {
            "name": scene.name,
            "ambient": list(scene.ambient),
            "background": list(scene.background),
            "objects": _objects(scene, origin, folder),
            "lights": [_light(light) for light in scene.lights],
        }
    if view is not None or "camera" not in tables:
        tables["camera"] = view_table(scene.view if view is None else view)
    order = ("name", "ambient", "background", "camera", "materials", "lights", "objects")
    return {key: tables[key] for key in order if key in tables}


def _move_textures(tables: dict[str, Any], origin: Path, folder: Path) -> None:
    """Names the images of a scene file's tables from another folder. Raises LucidaError for one
    that does not lie below that, where a scene file may not name it."""
    named = {f"materials.{key}": table for key, table in tables.get("materials", {}).items()}
    for number, entry in enumerate(tables.get("objects", [])):
        named[f"objects[{number}].material"] = entry.get("material")
    for field, table in named.items():
        given = table.get("texture") if isinstance(table, dict) else None
        if isinstance(given, dict):
            given["file"] = _image_path(origin / given["file"], folder, field)
        elif given is not None:
            table["texture"] = _image_path(origin / given, folder, field)


def _image_path(file: Path, folder: Path, field: str) -> str:
    if not Path(os.path.abspath(file)).is_relative_to(folder):
        raise LucidaError(
            f"{field}.texture",
            f"{file.name!r} does not lie in the new file's folder",
            "save the scene where its images are",
        )
    return _path(file, folder)


def _objects(scene: Scene, origin: Origin | None, folder: Path) -> list[dict[str, Any]]:
    if origin is not None and origin.source and origin.source not in BUILTIN_SCENES:
        return [{"type": "model", "file": _path(Path(origin.source), folder)}]
    return [_object(number, entry, folder) for number, entry in enumerate(scene.objects)]


def _object(number: int, entry: SceneObject, folder: Path) -> dict[str, Any]:
    if not isinstance(entry.shape, Sphere):
        raise LucidaError(
            f"objects[{number}]",
            f"{entry.name or 'a mesh'!r} is a mesh that was made in Python, in no file",
            "save the mesh as a model file and load that",
        )
    table: dict[str, Any] = {"type": "sphere", "name": entry.name}
    table |= {"center": list(entry.shape.center), "radius": entry.shape.radius}
    return table | {"material": _material(entry.material, f"objects[{number}].material", folder)}


def _material(material: Material, field: str, folder: Path) -> dict[str, Any]:
    table: dict[str, Any] = {
        "diffuse": list(material.diffuse),
        "specular": list(material.specular),
        "shininess": material.shininess,
    }
    if (checker := material.checker) is not None:
        table["checker"] = {"diffuse": list(checker.diffuse), "size": checker.size}
    if (texture := material.texture) is not None:
        if texture.file is None:
            problem = "is an image that was made in Python, in no file"
            raise LucidaError(f"{field}.texture", problem, "save it, and load the scene with it")
        table["texture"] = {
            "file": _image_path(texture.file, folder, field),
            "wrap": list(texture.wrap),
            "scale": list(texture.scale),
            "offset": list(texture.offset),
        }
    return table


def _light(light: Any) -> dict[str, Any]:
    color = {"color": list(light.color)}
    if isinstance(light, PointLight):
        return {"type": "point", "position": list(light.position), **color}
    return {"type": "directional", "direction": list(light.direction), **color}


def _path(file: Path, folder: Path) -> str:
    """A model's path for a scene file in `folder`: relative if the model lies below it."""
    file = Path(os.path.abspath(file))
    name = file.relative_to(folder).as_posix() if file.is_relative_to(folder) else str(file)
    try:
        name.encode()
    except UnicodeEncodeError:
        problem = f"the model's name is not UTF-8, as scene files are: {name}"
        raise LucidaError("", problem, "rename the model") from None
    return name


def _toml(tables: dict[str, Any]) -> str:
    """The text of a scene file: a table a section, everything inside it in one line."""
    lines = [f"{key} = {_value(v)}" for key, v in tables.items() if _is_plain(key, v)]
    for key, value in tables.items():
        if key == "camera":
            lines += ["", "[camera]", *_entries(value)]
        elif key == "materials":
            for name, material in value.items():
                lines += ["", f"[materials.{_key(name)}]", *_entries(material)]
        elif key in ("lights", "objects") and value:
            for entry in value:
                lines += ["", f"[[{key}]]", *_entries(entry)]
    return "\n".join(lines) + "\n"


def _is_plain(key: str, value: Any) -> bool:
    return key not in ("camera", "materials", "lights", "objects") or value == []


def _entries(table: dict[str, Any]) -> list[str]:
    return [f"{name} = {_value(value)}" for name, value in table.items()]


def _value(value: Any) -> str:
    """A value in TOML 1.0. Numbers are written so that they are read back exactly."""
    if isinstance(value, str):
        # JSON's strings are TOML's, but for one character that TOML wants escaped.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(map(_value, value)) + "]"


def _key(name: str) -> str:
    return name if name.isidentifier() and name.isascii() else _value(name)
