"""Read model files (.obj .ply .stl .off .glb .gltf) into a scene's objects, or into a scene."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lucida.renderer.files.reading import MODEL_ENDINGS, check_count, naming
from lucida.renderer.files.texture_images import ModelImages, shown
from lucida.renderer.scene import framing, shapes
from lucida.renderer.scene.limits import OBJECTS, TRIANGLES
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    DirectionalLight,
    Mesh,
    NamedView,
    PointLight,
    Scene,
    SceneObject,
    is_flat,
    triangle_count,
    without_metal,
)
from lucida.renderer.system.cancelling import check_cancelled, during
from lucida.renderer.system.errors import LucidaError, under

from .gltf import PlacedPart, read_gltf
from .gltf_cameras import camera_views
from .gltf_lights import scene_lights
from .obj import read_obj
from .parts import Part, build_mesh
from .readers import read_off, read_ply, read_stl

READERS = {".obj": read_obj, ".ply": read_ply, ".stl": read_stl, ".off": read_off}


@dataclass(frozen=True, eq=False)
class ModelFile:
    """The content of a model file.

    views, lights: the file's own; only glTF has any. notes: a line for each thing not shown.
    """

    objects: tuple[SceneObject, ...]
    views: tuple[NamedView, ...] = ()
    notes: tuple[str, ...] = ()
    lights: tuple[PointLight | DirectionalLight, ...] = ()


Reader = Callable[[Path], ModelFile]


def load_model(path: str | Path) -> ModelFile:
    """Return the objects and views of a model file, as read_model() does; see read_by()."""
    return _reader.get()(Path(path))


def read_by(reader: Reader) -> AbstractContextManager[object]:
    """Make load_model() use `reader` during the block, on this thread.

    It must behave like read_model(), but may read models in another process, or be cancelled.
    """
    return during(_reader, reader)


def read_model(path: Path) -> ModelFile:
    """Return a model file's views and its objects, one for each of its geometries (glTF: each
    instance).

    Units and axes are the file's own. Materials are the file's base colours, and the images that
    multiply them, if they can be read: see images.py. Vertex colours are read as sRGB, except in
    glTF, where they are linear. Raises LucidaError naming the file if it is of another kind, is
    damaged, holds no triangle, or too many.
    """
    ending = path.suffix.lower()
    if ending not in MODEL_ENDINGS:
        what = "is a scene file" if ending == ".toml" else f"ends in {ending!r}"
        raise LucidaError("", what, f"give one of {' '.join(MODEL_ENDINGS)}", str(path))
    images = ModelImages()
    views: tuple[NamedView, ...] = ()
    lights: tuple[PointLight | DirectionalLight, ...] = ()
    with naming(path):
        try:
            if ending in (".glb", ".gltf"):
                found = read_gltf(path, images)
                objects = _objects(path, found.parts, images)
                views = camera_views(found.tree, found.nodes)
                lights = scene_lights(found.tree, found.nodes, objects, images)
            else:
                parts = READERS[ending](path, images)
                alone = len(parts) == 1
                instances = [
                    PlacedPart(part, "" if alone else part.name, np.eye(4), part.material)
                    for part in parts
                ]
                objects = _objects(path, instances, images)
        except MemoryError:
            raise LucidaError("", "does not fit into memory", "give a smaller model") from None
        if not objects:
            raise LucidaError("", "holds no triangle with an area", "give a model with a surface")
        check_count(len(objects), OBJECTS, "objects")
        check_count(triangle_count(objects), TRIANGLES, "triangles")
    notes = tuple(f"{path}: {note}" for note in images.notes)
    return ModelFile(tuple(objects), views, notes, lights)


_reader: ContextVar[Reader] = ContextVar("reader of models", default=read_model)


def model_scene(path: str | Path) -> Scene:
    """Return a scene of one model file, with the default lights and a camera that shows all of it.
    The file's own cameras are among its views, and its own lights replace the default ones.
    """
    model = load_model(path)
    with naming(path):
        view = framing.framing_view([entry for entry in model.objects if not entry.hidden])
    return Scene(
        model.objects,
        model.lights or framing.LIGHTS,
        framing.AMBIENT,
        framing.BACKGROUND,
        view,
        Path(path).stem,
        views=model.views,
        notes=model.notes,
    )


def _objects(path: Path, instances: list[PlacedPart], images: ModelImages) -> list[SceneObject]:
    """Return the objects of a file's parts. Instances of one part share its arrays."""
    built: dict[int, Mesh | None] = {}
    objects = []
    for instance in instances:
        part, matrix = instance.part, instance.matrix
        linear = matrix[:3, :3]
        if not linear.any():  # a scale of 0, by which files hide a node
            continue
        check_cancelled()
        if is_flat(linear):
            points = np.asarray(part.vertices, np.float64) @ linear.T
            mesh = build_mesh(replace(part, vertices=points, normals=None))
            matrix = shapes.placement(matrix[:3, 3])
        else:
            if id(part) not in built:
                built[id(part)] = build_mesh(part)
            mesh = built[id(part)]
        if mesh is None:
            continue
        name = instance.name or path.stem
        material = _shown_on(mesh, instance.material or _material(part), name, images)
        with under(f"node {name!r}"[:80]):
            placed = mesh.placed(matrix @ mesh.transform)
        is_gone = material.cutout is not None and material.cutout > 1  # a hole everywhere
        objects.append(SceneObject(placed, material, name, is_gone))
    return objects


def _shown_on(mesh: Mesh, material: Material, name: str, images: ModelImages) -> Material:
    """Return the material, without its images if the mesh has no texture coordinates."""
    if material.image is None or mesh.uv is not None:
        return material
    images.note(f"{shown(name)} has no texture coordinates; the plain colour is shown")
    return replace(without_metal(material), texture=None)


def _material(part: Part) -> Material:
    """Return the default material, white if the file has colours, which multiply it."""
    if part.colors is None:
        return framing.MATERIAL
    return replace(framing.MATERIAL, diffuse=(1.0, 1.0, 1.0))
