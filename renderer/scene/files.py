"""Scene files: TOML into a Scene.

Owns the way from the tables of schema.py to a scene, and the paths of fields in errors. Knows
nothing of model files beyond that they become objects.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from renderer.errors import LucidaError
from renderer.scene import framing, shape_coordinates, shapes
from renderer.scene.cancelling import check_cancelled
from renderer.scene.colors import parse_color
from renderer.scene.limits import (
    LIGHTS,
    MADE_TRIANGLES,
    OBJECTS,
    SEGMENTS,
    TOML_BYTES,
    TRIANGLES,
    VIEWS,
)
from renderer.scene.model import (
    Checker,
    DirectionalLight,
    Material,
    Mesh,
    NamedView,
    Origin,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)
from renderer.scene.models import ModelFile, load_model
from renderer.scene.outside import check_inside
from renderer.scene.reading import decode_text, read_file, suggestion
from renderer.scene.scene_images import SceneImages
from renderer.scene.schema import (
    AnyLight,
    AnyObject,
    BoxTable,
    ConeTable,
    CylinderTable,
    DirectionalLightTable,
    DiskTable,
    MaterialTable,
    MeshTable,
    ModelTable,
    PointLightTable,
    RectangleTable,
    SceneFile,
    SphereTable,
    TorusTable,
)
from renderer.scene.tables import parse_toml, to_struct
from renderer.scene.views import transformed_view, view_from_table

Materials = dict[str, Material]
Models = dict[Path, ModelFile]


def read_scene_file(path: Path) -> Scene:
    """The scene in a file. Raises LucidaError naming the file, the field and the remedy."""
    text = decode_text(read_file(path, TOML_BYTES), str(path))
    return scene_from_toml(text, path.parent, str(path), path.stem)


def scene_from_toml(text: str, folder: Path, source: str = "", name: str = "") -> Scene:
    """The scene in a text. folder: where its models' paths begin. source: the file, for errors.

    name: the scene's, where the file gives none.
    """
    try:
        return scene_from_tables(parse_toml(text), folder, name)
    except LucidaError as error:
        raise error.in_file(source) from None


def scene_from_tables(tables: dict[str, Any], folder: Path, name: str = "") -> Scene:
    """The scene in tables as a scene file has them: for scenes inside other files."""
    scene = _scene(to_struct(tables, SceneFile), folder, name)
    return replace(scene, origin=Origin("", tables, folder))


def _scene(tables: SceneFile, folder: Path, name: str) -> Scene:
    images = SceneImages(folder)
    materials = {
        key: _material(table, f"materials.{key}", images) for key, table in tables.materials.items()
    }
    models: Models = {}
    objects, views = _objects(tables.objects, materials, folder, models, images)
    lights: tuple[PointLight | DirectionalLight, ...] = framing.LIGHTS
    if tables.lights is not None:
        _check_count("lights", len(tables.lights), LIGHTS)
        lights = tuple(_light(table, f"lights[{i}]") for i, table in enumerate(tables.lights))
    ambient, background = (
        default if value is None else parse_color(field, value)
        for field, value, default in (
            ("ambient", tables.ambient, framing.AMBIENT),
            ("background", tables.background, framing.BACKGROUND),
        )
    )
    if tables.camera is None:
        view = framing.framing_view(objects)
    else:
        view = view_from_table(tables.camera)
    return Scene(
        tuple(objects),
        lights,
        ambient,
        background,
        view,
        tables.name or name,
        views=tuple(views),
        notes=tuple(note for model in models.values() for note in model.notes),
    )


def _objects(
    tables: list[Any], materials: Materials, folder: Path, models: Models, images: SceneImages
) -> tuple[list[SceneObject], list[NamedView]]:
    """The scene's objects, and the views of its models' own cameras."""
    _check_count("objects", len(tables), OBJECTS)
    objects: list[SceneObject] = []
    views: list[NamedView] = []
    entries: list[SphereTable | MeshTable] = [
        to_struct(table, AnyObject, f"objects[{number}]") for number, table in enumerate(tables)
    ]
    check_inside(folder / entry.file for entry in entries if isinstance(entry, ModelTable))
    # Counted before they are built: a few lines can make more than memory holds.
    made = sum(map(_made_triangles, entries))
    _check_made(made)
    stored = 0
    for number, entry in enumerate(entries):
        check_cancelled()
        with _under(f"objects[{number}]"):
            if isinstance(entry, ModelTable):
                again = folder / entry.file in models
                parts = _model(entry.file, folder, models).objects
                count = sum(len(p.shape.faces) for p in parts if isinstance(p.shape, Mesh))
                made, stored = made + again * count, stored + (not again) * count
        _check_made(made)
        _check_count("objects", stored + made, TRIANGLES, "triangles")
        with _under(f"objects[{number}]"):
            objects += _parts(entry, materials, folder, models, images)
        _check_count("objects", len(objects), OBJECTS)
        if isinstance(entry, ModelTable):
            views += _views(entry, models[folder / entry.file].views)
    return objects, views[:VIEWS]


def _views(table: ModelTable, views: tuple[NamedView, ...]) -> Iterator[NamedView]:
    """A model's cameras where the model was put: they see of it what they saw."""
    matrix = shapes.placement(table.translate, table.rotate_deg, table.scale)
    for named in views:
        with contextlib.suppress(LucidaError):  # too far away for a camera
            name = f"{table.name}/{named.name}" if table.name else named.name
            yield NamedView(name, transformed_view(named.view, matrix))


def _made_triangles(table: SphereTable | MeshTable) -> int:
    """How many triangles a shape is made of; 0 for a sphere, which has none, and for a model."""
    match table:
        case BoxTable():
            return 12
        case RectangleTable():
            return 2
        case DiskTable():
            return _bounded(table.segments)
        case CylinderTable():
            return 4 * _bounded(table.segments)
        case ConeTable():
            return 2 * _bounded(table.segments)
        case TorusTable():
            return 2 * _bounded(table.segments) * _bounded(table.sides)
    return 0


def _bounded(count: int) -> int:
    """A number of segments as far as it is legal; the shape refuses others."""
    return min(max(count, 0), SEGMENTS)


def _check_made(triangles: int) -> None:
    if triangles > MADE_TRIANGLES:
        raise LucidaError(
            "objects",
            f"make {triangles} triangles of shapes and copies of models",
            f"stay within {MADE_TRIANGLES}: fewer segments, sides or copies",
        )


def _parts(
    table: SphereTable | MeshTable,
    materials: Materials,
    folder: Path,
    models: Models,
    images: SceneImages,
) -> list[SceneObject]:
    """The scene's objects for one table: one, or as many as a model has parts."""
    material = _material_of(table.material, materials, images)
    if isinstance(table, SphereTable):
        return [SceneObject(Sphere(table.center, table.radius), material or Material(), table.name)]
    matrix = shapes.placement(table.translate, table.rotate_deg, table.scale)
    if not isinstance(table, ModelTable):
        mesh = _mesh(table)
        if material is not None and material.texture is not None:
            mesh = _with_coordinates(mesh, table)
        mesh = shapes.transformed(mesh, matrix)
        return [SceneObject(mesh, material or Material(), table.name)]
    parts = []
    for part in _model(table.file, folder, models).objects:
        assert isinstance(part.shape, Mesh)
        name = f"{table.name}/{part.name}" if table.name and part.name else table.name or part.name
        if material is not None and material.texture is not None and part.shape.uv is None:
            raise LucidaError(
                "material",
                f"has a texture, and {name!r} of {table.file!r} has none of its own",
                "texture it in the model's own file, or give a material without texture",
            )
        mesh = shapes.transformed(part.shape, matrix)
        parts.append(SceneObject(mesh, material or part.material, name))
    if table.name and len(parts) == 1:
        parts = [SceneObject(parts[0].shape, parts[0].material, table.name)]
    return parts


def _mesh(table: MeshTable) -> Mesh:
    match table:
        case BoxTable():
            return shapes.box(table.size)
        case RectangleTable():
            return shapes.rectangle(table.width, table.depth)
        case DiskTable():
            return shapes.disk(table.radius, table.segments)
        case CylinderTable():
            return shapes.cylinder(table.radius, table.height, table.segments, table.smooth)
        case ConeTable():
            return shapes.cone(table.radius, table.height, table.segments, table.smooth)
        case TorusTable():
            return shapes.torus(
                table.radius, table.tube_radius, table.segments, table.sides, table.smooth
            )
    raise AssertionError(f"no mesh for {table!r}")


def _with_coordinates(mesh: Mesh, table: MeshTable) -> Mesh:
    match table:
        case BoxTable():
            return shape_coordinates.on_box(mesh)
        case CylinderTable() | ConeTable():
            return shape_coordinates.on_cylinder(mesh)
        case TorusTable():
            return shape_coordinates.on_torus(mesh, table.radius)
    return shape_coordinates.on_plane(mesh)


def _model(file: str, folder: Path, models: Models) -> ModelFile:
    """A model's parts and views; each file is read once a scene."""
    path = folder / file
    if path not in models:
        try:
            models[path] = load_model(path)
        except LucidaError as error:
            where = ": ".join(part for part in (str(path), error.field) if part)
            raise LucidaError("file", f"{where}: {error.problem}", error.remedy) from None
    return models[path]


def _material_of(
    value: str | MaterialTable | None, materials: Materials, images: SceneImages
) -> Material | None:
    if value is None:
        return None
    if isinstance(value, MaterialTable):
        with _under("material"):
            return _built_material(value, images)
    if value not in materials:
        remedy = suggestion(value, materials) if materials else "define it under [materials]"
        raise LucidaError("material", f"{value[:40]!r} is unknown", remedy)
    return materials[value]


def _material(table: Any, field: str, images: SceneImages) -> Material:
    fields = to_struct(table, MaterialTable, field)
    with _under(field):
        return _built_material(fields, images)


def _built_material(table: MaterialTable, images: SceneImages) -> Material:
    checker = None
    if (given := table.checker) is not None:
        with _under("checker"):
            checker = Checker(parse_color("diffuse", given.diffuse), given.size)
    texture = None if table.texture is None else images.texture(table.texture)
    default = (1.0, 1.0, 1.0) if texture else Material().diffuse
    return Material(
        default if table.diffuse is None else parse_color("diffuse", table.diffuse),
        parse_color("specular", table.specular),
        table.shininess,
        checker,
        texture,
    )


def _light(table: Any, field: str) -> PointLight | DirectionalLight:
    fields: PointLightTable | DirectionalLightTable = to_struct(table, AnyLight, field)
    with _under(field):
        rgb = parse_color("color", fields.color)
        if isinstance(fields, PointLightTable):
            return PointLight(fields.position, rgb)
        return DirectionalLight(fields.direction, rgb)


@contextlib.contextmanager
def _under(field: str) -> Iterator[None]:
    """Errors inside get their field under `field`."""
    try:
        yield
    except LucidaError as error:
        raise error.within(field) from None


def _check_count(field: str, count: int, most: int, what: str = "") -> None:
    if count > most:
        raise LucidaError(
            field, f"holds {count} {what or field}", f"give at most {most}, or split the scene"
        )
