"""Read scene files: from TOML, by the tables of schema.py, to a Scene."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene import framing, shapes
from lucida.renderer.scene.limits import LIGHTS, OBJECTS, TOML_BYTES, TRIANGLES
from lucida.renderer.scene.material import Material, parse_color
from lucida.renderer.scene.model import (
    Checker,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
    View,
    triangle_count,
)
from lucida.renderer.scene.origin import FileEntry, Keys, Origin, SavedFile
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError, under

from .models.models import ModelFile
from .outside import check_inside
from .reading import check_count, decode_text, naming, read_file, suggestion
from .scene_parts import SceneParts, made_triangles, unmapped
from .schema import (
    AnyLight,
    AnyObject,
    DirectionalLightTable,
    MaterialTable,
    MeshTable,
    ModelTable,
    PointLightTable,
    SceneFile,
    SphereTable,
)
from .tables import parse_toml, to_struct
from .views import view_from_table

SPLIT = "give at most {}, or split the scene"
_keys = itertools.count(1)


def new_keys(count: int) -> tuple[int, ...]:
    """Return keys that no other object or light has in this process."""
    return tuple(itertools.islice(_keys, count))


def read_scene_file(path: Path) -> Scene:
    """Return the scene in a file. Raises LucidaError naming the file, the field and the remedy."""
    data = read_file(path, TOML_BYTES)
    decode_text(data, str(path))
    return scene_from_toml(data.decode(), path.parent, str(path), path.stem)


def scene_from_toml(text: str, folder: Path, source: str = "", name: str = "") -> Scene:
    """Return the scene in a text, which may begin with a byte order mark.

    folder: the start of its paths.
    source: the file, for errors.
    name: the scene's, if the file has none.
    """
    with naming(source):
        return scene_from_tables(parse_toml(text), folder, name, text)


def scene_from_tables(
    tables: dict[str, Any], folder: Path, name: str = "", text: str = ""
) -> Scene:
    """Return the scene of a scene file's tables.
    text: the file's; "" for tables in another file.
    """
    keys = _keys_of(tables, "objects", ()), _keys_of(tables, "lights", framing.LIGHTS)
    return _scene(Origin("", tables, folder), keys, name, SavedFile(None, text, tables, keys))


def _keys_of(tables: dict[str, Any], kind: str, default: Sequence[Any]) -> tuple[int, ...]:
    entries = tables.get(kind, default)
    return new_keys(len(entries)) if isinstance(entries, list | tuple) else ()


def changed_scene(scene: Scene, tables: dict[str, Any], keys: Keys) -> Scene:
    """Return the scene with other tables.

    keys: of their objects and lights, in order.
    Objects with the same key and table stay the same, moved objects keep their arrays, and model
    files are not read again. Raises LucidaError.
    """
    assert scene.origin is not None
    changed = _scene(replace(scene.origin, tables=tables), keys, scene.name, scene.origin.saved)
    changed = replace(changed, views=scene.views)
    return replace(changed, view=scene.view) if "camera" not in tables else changed


def _scene(origin: Origin, keys: Keys, name: str, saved: SavedFile) -> Scene:
    """Build a scene. origin: the tables, and the entries of the scene before a change."""
    assert origin.tables is not None
    tables: SceneFile = to_struct(origin.tables, SceneFile)
    builder = _Builder(tables, origin)
    entries = builder.entries(tables.objects, keys[0])
    objects = [made for entry in entries for made in entry.objects]
    lights: tuple[PointLight | DirectionalLight, ...] = framing.LIGHTS
    if tables.lights is not None:
        check_count(len(tables.lights), LIGHTS, "lights", "lights", SPLIT)
        found = [_light(table, f"lights[{i}]") for i, table in enumerate(tables.lights)]
        lights = tuple(light for light in found if light is not None)
    if tables.camera is not None:
        view = view_from_table(tables.camera)
    elif origin.entries:
        view = View(Camera.canonical())  # the changed scene keeps its own
    else:
        view = framing.framing_view([entry for entry in objects if not entry.hidden])
    ambient, background = tables.ambient, tables.background
    return Scene(
        tuple(objects),
        lights,
        framing.AMBIENT if ambient is None else parse_color("ambient", ambient),
        framing.BACKGROUND if background is None else parse_color("background", background),
        view,
        tables.name or name,
        replace(origin, entries=entries, light_keys=keys[1], saved=saved),
        notes=tuple(dict.fromkeys(note for entry in entries for note in entry.notes)),
    )


class _Builder:
    """Builds the objects of a scene. Unchanged objects are taken from the previous scene."""

    def __init__(self, tables: SceneFile, origin: Origin) -> None:
        self._parts = SceneParts(origin.folder, origin.entries)
        self._folder = origin.folder
        self._old = {entry.key: entry for entry in origin.entries}
        self._materials = {}
        for name, table in tables.materials.items():
            field = f"materials.{name}"
            fields = to_struct(table, MaterialTable, field)
            with under(field):
                self._materials[name] = self._material(fields)

    def entries(self, tables: list[Any], keys: tuple[int, ...]) -> tuple[FileEntry, ...]:
        check_count(len(tables), OBJECTS, "objects", "objects", SPLIT)
        known = [
            was if (was := self._old.get(key)) is not None and was.table is table else None
            for key, table in zip(keys, tables, strict=True)
        ]
        fields: list[SphereTable | MeshTable] = [
            to_struct(table, AnyObject, f"objects[{number}]") if was is None else was.fields
            for number, (table, was) in enumerate(zip(tables, known, strict=True))
        ]
        models = (entry.file for entry in fields if isinstance(entry, ModelTable))
        check_inside(self._folder / file for file in models)
        # Count them before building: a few lines can make more triangles than memory holds.
        triangles = sum(map(made_triangles, fields))
        check_count(triangles, TRIANGLES, "triangles", "objects", SPLIT)
        objects = 0
        entries: list[FileEntry] = []
        for number, entry in enumerate(fields):
            check_cancelled()
            with under(f"objects[{number}]"):
                material = self._material_of(entry.material)
                if isinstance(entry, ModelTable):
                    triangles += triangle_count(self._parts.model(entry.file).objects)
            check_count(triangles, TRIANGLES, "triangles", "objects", SPLIT)
            with under(f"objects[{number}]"):
                was = known[number]
                if was is None or was.material != material:
                    was = self._entry(keys[number], tables[number], entry, material)
            entries.append(was)
            objects += len(was.objects)
            check_count(objects, OBJECTS, "objects", "objects", SPLIT)
        return tuple(entries)

    def _entry(
        self,
        key: int,
        table: dict[str, Any],
        fields: SphereTable | MeshTable,
        material: Material | None,
    ) -> FileEntry:
        """Return the objects of one table: a single one, or one for each part of a model."""
        if isinstance(fields, SphereTable):
            sphere = Sphere(fields.center, fields.radius)
            alone = SceneObject(sphere, material or Material(), fields.name, fields.hidden)
            return FileEntry(key, table, fields, material, (), (alone,))
        has_image = material is not None and material.image is not None
        path, single_sided = "", None
        if isinstance(fields, ModelTable):
            path, single_sided = self._parts.path(fields.file), fields.single_sided
            model = self._parts.model(fields.file)
            if has_image and (part := unmapped(model.objects)) is not None:
                name = "/".join(filter(None, (fields.name, part.name)))
                problem = f"has a texture; {name!r} of {fields.file!r} has no texture coordinates"
                remedy = "export the model with them (UVs), or give a material without texture"
                raise LucidaError("material", problem, remedy)
        else:
            model = ModelFile(self._parts.mesh(fields, has_image))
        made, notes = model.objects, model.notes
        if model.lights:
            notes += (f"{path}: lights: not shown; a scene file has its own",)
        if model.views:
            notes += (f"{path}: cameras: listed where the model is opened alone",)
        was = self._old.get(key)
        if was is not None and was.made is made and _place(was.fields) == _place(fields):
            placed = [entry.shape for entry in was.objects]
        else:
            matrix = shapes.placement(*_place(fields))
            meshes = (part.shape for part in made if isinstance(part.shape, Mesh))
            placed = [shapes.transformed(mesh, matrix) for mesh in meshes]
        objects = []
        for part, shape in zip(made, placed, strict=True):
            name = fields.name or part.name
            if fields.name and part.name and len(made) > 1:
                name = f"{fields.name}/{part.name}"
            shown = material or part.material
            if single_sided is not None:
                shown = replace(shown, single_sided=single_sided)
            # A part is read as hidden if its own material cuts it away altogether.
            is_gone = material is None and part.hidden
            objects.append(SceneObject(shape, shown, name, fields.hidden or is_gone))
        return FileEntry(key, table, fields, material, made, tuple(objects), path, notes)

    def _material_of(self, value: str | MaterialTable | None) -> Material | None:
        if isinstance(value, MaterialTable):
            with under("material"):
                return self._material(value)
        if value is not None and value not in self._materials:
            known = self._materials
            remedy = suggestion(value, known) if known else "define it under [materials]"
            raise LucidaError("material", f"{value[:40]!r} is unknown", remedy)
        return None if value is None else self._materials[value]

    def _material(self, table: MaterialTable) -> Material:
        checker = None
        if (given := table.checker) is not None:
            with under("checker"):
                checker = Checker(parse_color("diffuse", given.diffuse), given.size)
        parts, has_opacity = self._parts, table.cutout is not None
        texture = None if table.texture is None else parts.texture(table.texture, has_opacity)
        metal = None if table.metal is None else parts.metal(table.metal)
        default = (1.0, 1.0, 1.0) if texture or metal else Material().diffuse
        return Material(
            default if table.diffuse is None else parse_color("diffuse", table.diffuse),
            parse_color("specular", table.specular),
            table.shininess,
            checker,
            texture,
            metal,
            table.cutout,
            table.single_sided,
        )


def _place(table: MeshTable) -> tuple[Any, ...]:
    return table.translate, table.rotate_deg, table.scale


def _light(table: Any, field: str) -> PointLight | DirectionalLight | None:
    """Return a light; None for a hidden one."""
    fields: PointLightTable | DirectionalLightTable = to_struct(table, AnyLight, field)
    with under(field):
        rgb = parse_color("color", fields.color)
        light: PointLight | DirectionalLight
        if isinstance(fields, PointLightTable):
            light = PointLight(fields.position, rgb)
        else:
            light = DirectionalLight(fields.direction, rgb)
        return None if fields.hidden else light
