"""Scene files: TOML into a Scene.

Owns the way from the tables of schema.py to a scene, and the paths of fields in errors. Knows
nothing of model files beyond that they become objects.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene import framing, shapes
from renderer.scene.cancelling import check_cancelled
from renderer.scene.colors import parse_color
from renderer.scene.limits import (
    LIGHTS,
    MADE_TRIANGLES,
    OBJECTS,
    TOML_BYTES,
    TRIANGLES,
    VIEWS,
)
from renderer.scene.model import (
    Checker,
    DirectionalLight,
    FileEntry,
    Keys,
    Material,
    Mesh,
    NamedView,
    Origin,
    PointLight,
    SavedFile,
    Scene,
    SceneObject,
    Sphere,
    View,
    triangles_of,
)
from renderer.scene.models import ModelFile
from renderer.scene.outside import check_inside
from renderer.scene.reading import check_count, decode_text, naming, read_file, suggestion, within
from renderer.scene.scene_images import SceneImages
from renderer.scene.scene_parts import SceneParts, check_mapped, is_textured, made_triangles
from renderer.scene.schema import (
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
from renderer.scene.tables import parse_toml, to_struct
from renderer.scene.views import transformed_view, view_from_table

Materials = dict[str, Material]
Models = dict[str, ModelFile]  # by absolute path

SPLIT = "give at most {}, or split the scene"
_keys = itertools.count(1)


def new_keys(count: int) -> tuple[int, ...]:
    """Keys that no other object or light has in this process."""
    return tuple(itertools.islice(_keys, count))


def read_scene_file(path: Path) -> Scene:
    """The scene in a file. Raises LucidaError naming the file, the field and the remedy."""
    data = read_file(path, TOML_BYTES)
    scene = scene_from_toml(decode_text(data, str(path)), path.parent, str(path), path.stem)
    assert scene.origin is not None
    scene.origin.saved.text = data.decode()  # with its byte order mark
    return scene


def scene_from_toml(text: str, folder: Path, source: str = "", name: str = "") -> Scene:
    """Return the scene in a text. folder: the start of its models' paths. source: the file, for
    errors.

    name: the scene's, if the file has none.
    """
    with naming(source):
        scene = scene_from_tables(parse_toml(text), folder, name)
    assert scene.origin is not None
    scene.origin.saved.text = text
    return scene


def scene_from_tables(tables: dict[str, Any], folder: Path, name: str = "") -> Scene:
    """The scene in tables as a scene file has them: for scenes inside other files."""
    keys = _keys_of(tables, "objects", ()), _keys_of(tables, "lights", framing.LIGHTS)
    return _scene(Origin("", tables, folder), keys, name, SavedFile(None, "", tables, keys))


def _keys_of(tables: dict[str, Any], kind: str, default: Sequence[Any]) -> tuple[int, ...]:
    entries = tables.get(kind, default)
    return new_keys(len(entries)) if isinstance(entries, list | tuple) else ()


def changed_scene(scene: Scene, tables: dict[str, Any], keys: Keys) -> Scene:
    """The scene of other tables in the place of its own. keys: of their objects and lights, in
    order. What has kept its key and its table is the same objects; what was only moved, the same
    arrays; a model that the scene has is not read again. Raises LucidaError."""
    assert scene.origin is not None
    changed = _scene(replace(scene.origin, tables=tables), keys, scene.name, scene.origin.saved)
    return replace(changed, view=scene.view) if "camera" not in tables else changed


def _scene(origin: Origin, keys: Keys, name: str, saved: SavedFile) -> Scene:
    """origin: of the scene whose entries are known, with the tables of the new one."""
    assert origin.tables is not None
    tables: SceneFile = to_struct(origin.tables, SceneFile)
    images = SceneImages(origin.folder, _own_materials(origin))
    materials = {
        key: _material(table, f"materials.{key}", images) for key, table in tables.materials.items()
    }
    entries = _entries(tables.objects, keys[0], materials, origin, images)
    objects = [made for entry in entries for made in entry.objects]
    views = [view for entry in entries if entry.views for view in _views(entry)]
    lights: tuple[PointLight | DirectionalLight, ...] = framing.LIGHTS
    if tables.lights is not None:
        check_count(len(tables.lights), LIGHTS, "lights", "lights", SPLIT)
        found = [_light(table, f"lights[{i}]") for i, table in enumerate(tables.lights)]
        lights = tuple(light for light in found if light is not None)
    ambient, background = (
        default if value is None else parse_color(field, value)
        for field, value, default in (
            ("ambient", tables.ambient, framing.AMBIENT),
            ("background", tables.background, framing.BACKGROUND),
        )
    )
    if tables.camera is not None:
        view = view_from_table(tables.camera)
    elif origin.entries:
        view = View(Camera.canonical())  # the changed scene keeps its own
    else:
        view = framing.framing_view([entry for entry in objects if not entry.hidden])
    return Scene(
        tuple(objects),
        lights,
        ambient,
        background,
        view,
        tables.name or name,
        replace(origin, entries=entries, light_keys=keys[1], saved=saved),
        tuple(views[:VIEWS]),
        tuple(dict.fromkeys(note for entry in entries for note in entry.notes)),
    )


def _own_materials(origin: Origin) -> list[Material]:
    """Return those of the scene that is changed: their images are not read again."""
    return [entry.material for entry in origin.entries if entry.material is not None]


def _entries(
    tables: list[Any],
    keys: tuple[int, ...],
    materials: Materials,
    origin: Origin,
    images: SceneImages,
) -> tuple[FileEntry, ...]:
    """The objects of a scene, from tables; what the origin's entries have already is taken."""
    check_count(len(tables), OBJECTS, "objects", "objects", SPLIT)
    folder, old = origin.folder, {entry.key: entry for entry in origin.entries}
    known = [
        was if (was := old.get(key)) is not None and was.table is table else None
        for key, table in zip(keys, tables, strict=True)
    ]
    fields: list[SphereTable | MeshTable] = [
        to_struct(table, AnyObject, f"objects[{number}]") if was is None else was.fields
        for number, (table, was) in enumerate(zip(tables, known, strict=True))
    ]
    check_inside(folder / entry.file for entry in fields if isinstance(entry, ModelTable))
    # Counted before they are built: a few lines can make more than memory holds.
    made = sum(map(made_triangles, fields))
    _check_made(made)
    stored = 0
    models: Models = {}
    parts = SceneParts(folder, origin.entries)
    entries: list[FileEntry] = []
    objects = 0
    for number, entry in enumerate(fields):
        check_cancelled()
        with within(f"objects[{number}]"):
            material = _material_of(entry.material, materials, images)
            if isinstance(entry, ModelTable):
                path = parts.path(entry.file)
                again = path in models
                models[path] = parts.model(entry.file, is_textured(material))
                count = triangles_of(models[path].objects)
                made, stored = made + again * count, stored + (not again) * count
        _check_made(made)
        check_count(stored + made, TRIANGLES, "triangles", "objects", SPLIT)
        with within(f"objects[{number}]"):
            was = known[number]
            if was is None or was.material != material:
                was = _entry(keys[number], tables[number], entry, material, parts, old)
        entries.append(was)
        objects += len(was.objects)
        check_count(objects, OBJECTS, "objects", "objects", SPLIT)
    return tuple(entries)


def _views(entry: FileEntry) -> Iterator[NamedView]:
    """A model's cameras where the model was put: they see of it what they saw."""
    table = entry.fields
    matrix = shapes.placement(table.translate, table.rotate_deg, table.scale)
    for named in entry.views:
        with contextlib.suppress(LucidaError):  # too far away for a camera
            name = f"{table.name}/{named.name}" if table.name else named.name
            yield NamedView(name, transformed_view(named.view, matrix))


def _check_made(triangles: int) -> None:
    if triangles > MADE_TRIANGLES:
        raise LucidaError(
            "objects",
            f"make {triangles} triangles of shapes and copies of models",
            f"stay within {MADE_TRIANGLES}: fewer segments, sides or copies",
        )


def _entry(
    key: int,
    table: dict[str, Any],
    fields: SphereTable | MeshTable,
    material: Material | None,
    parts: SceneParts,
    old: dict[int, FileEntry],
) -> FileEntry:
    """Return what one table becomes: one object, or as many as a model has parts.

    old: the entries of the scene before; shapes that have not changed stay the same objects.
    """
    hidden = fields.hidden
    if isinstance(fields, SphereTable):
        sphere = Sphere(fields.center, fields.radius)
        alone = SceneObject(sphere, material or Material(), fields.name, hidden)
        return FileEntry(key, table, fields, material, (), (alone,))
    views: tuple[NamedView, ...] = ()
    notes: tuple[str, ...] = ()
    path = ""
    mapped = is_textured(material)
    if isinstance(fields, ModelTable):
        model, path = parts.model(fields.file, mapped), parts.path(fields.file)
        made, views, notes = model.objects, model.views, model.notes
        if mapped:
            check_mapped(fields, made)
    else:
        made = parts.mesh(fields, mapped)
    was = old.get(key)
    if was is not None and was.made is made and _place(was.fields) == _place(fields):
        placed = [entry.shape for entry in was.objects]
    else:
        matrix = shapes.placement(*_place(fields))
        placed = [
            shapes.transformed(part.shape, matrix) for part in made if isinstance(part.shape, Mesh)
        ]
    objects = []
    for part, shape in zip(made, placed, strict=True):
        name = fields.name
        if len(made) > 1 or not name:
            name = f"{name}/{part.name}" if name and part.name else name or part.name
        shown = material or (part.material if isinstance(fields, ModelTable) else Material())
        if isinstance(fields, ModelTable) and fields.single_sided is not None:
            shown = replace(shown, single_sided=fields.single_sided)
        # A part that its own material cuts away altogether is hidden as it is read.
        gone = isinstance(fields, ModelTable) and material is None and part.hidden
        objects.append(SceneObject(shape, shown, name, hidden or gone))
    return FileEntry(key, table, fields, material, made, tuple(objects), views, path, notes)


def _place(table: MeshTable) -> tuple[Any, ...]:
    return table.translate, table.rotate_deg, table.scale


def _material_of(
    value: str | MaterialTable | None, materials: Materials, images: SceneImages
) -> Material | None:
    if value is None:
        return None
    if isinstance(value, MaterialTable):
        with within("material"):
            return _built_material(value, images)
    if value not in materials:
        remedy = suggestion(value, materials) if materials else "define it under [materials]"
        raise LucidaError("material", f"{value[:40]!r} is unknown", remedy)
    return materials[value]


def _material(table: Any, field: str, images: SceneImages) -> Material:
    fields = to_struct(table, MaterialTable, field)
    with within(field):
        return _built_material(fields, images)


def _built_material(table: MaterialTable, images: SceneImages) -> Material:
    checker = None
    if (given := table.checker) is not None:
        with within("checker"):
            checker = Checker(parse_color("diffuse", given.diffuse), given.size)
    has_opacity = table.cutout is not None
    texture = None if table.texture is None else images.texture(table.texture, has_opacity)
    metal = None if table.metal is None else images.metal(table.metal)
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


def _light(table: Any, field: str) -> PointLight | DirectionalLight | None:
    """None for one that is hidden."""
    fields: PointLightTable | DirectionalLightTable = to_struct(table, AnyLight, field)
    with within(field):
        rgb = parse_color("color", fields.color)
        light: PointLight | DirectionalLight
        if isinstance(fields, PointLightTable):
            light = PointLight(fields.position, rgb)
        else:
            light = DirectionalLight(fields.direction, rgb)
        return None if fields.hidden else light
