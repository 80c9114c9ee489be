"""glTF 2.0 files, .gltf and .glb: which meshes are where, with which material.

Skins, morph targets and animations are not read, only reported.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene.cancelling import check_cancelled
from renderer.scene.gltf_cameras import camera_views
from renderer.scene.gltf_file import (
    TRIANGLE_FAN,
    TRIANGLE_LIST,
    TRIANGLE_STRIP,
    Gltf,
    OpenGltf,
    Primitive,
    entry_at,
)
from renderer.scene.gltf_materials import read_materials
from renderer.scene.gltf_nodes import PlacedNode, placed_nodes
from renderer.scene.gltf_numbers import read_numbers, scaled, triangles_of, whole_numbers
from renderer.scene.gltf_shared import (
    TYPES,
    Key,
    check_size,
    compacted,
    same_primitives,
)
from renderer.scene.gltf_textures import coordinates_of, read_coordinates
from renderer.scene.images import ModelImages
from renderer.scene.limits import OBJECTS
from renderer.scene.model import Material, NamedView
from renderer.scene.parts import Part, linear_colors


@dataclass(frozen=True, eq=False)
class Instance:
    """A primitive of a mesh at a node. matrix: world_from_object. material: its index, or None."""

    primitive: Key
    name: str
    matrix: NDArray[np.float64]
    material: int | None


@dataclass(frozen=True, eq=False)
class GltfContent:
    """The instances, the parts and materials that they show, and the views of the cameras."""

    instances: list[Instance]
    parts: dict[Key, Part]
    materials: dict[int, Material]
    views: tuple[NamedView, ...]


def read_gltf(path: Path, images: ModelImages, is_mapped: bool = False) -> GltfContent:
    """Return the content of a .gltf or .glb file. Raises LucidaError.

    images: for its textures.
    is_mapped: all parts with texture coordinates.
    """
    file = OpenGltf(path)
    tree = file.tree
    nodes = list(placed_nodes(tree))
    instances = _instances(tree, nodes)
    if still := list(_not_moved(tree, nodes)):
        images.note(f"not shown: {', '.join(still)}", "shapes")
    shown = [entry.primitive for entry in instances]
    same = same_primitives(tree, shown, is_mapped)
    keys = sorted(set(same.values()))
    check_size(tree, shown, keys)
    materials = read_materials(file, {entry.material for entry in instances}, images)
    shared = Counter(tree.meshes[m].primitives[p].attributes["POSITION"] for m, p in keys)
    users = [
        (same[entry.primitive], materials[entry.material])
        for entry in instances
        if entry.material is not None
    ]
    single_sided = {key for key, material in users if material.single_sided}
    cut_out = {key for key, material in users if material.cutout is not None}
    parts = {}
    for key in keys:
        check_cancelled()
        given = tree.meshes[key[0]].primitives[key[1]]
        fields = _fields(file, given, f"meshes[{key[0]}].primitives[{key[1]}]")
        colors = fields["vertex_colors"]
        fields["vertex_colors"] = linear_colors(colors, linear=True)
        fields["uv"] = _coordinates(file, given, images, is_mapped)
        if shared[given.attributes["POSITION"]] > 1:
            fields = compacted(fields)
        if key in cut_out and _is_clear(colors):
            images.note("the opacity of vertices cuts no holes", "materials")
        parts[key] = Part(tree.meshes[key[0]].name, **fields, has_backs=key in single_sided)
    shown_parts = {key: parts[first] for key, first in same.items()}
    return GltfContent(instances, shown_parts, materials, camera_views(tree, nodes))


def _not_moved(tree: Gltf, nodes: Iterable[PlacedNode]) -> Iterator[str]:
    """Yield what would move the meshes' vertices."""
    if any(placed.node.skin is not None for placed in nodes):
        yield "skins"
    if any(primitive.targets for mesh in tree.meshes for primitive in mesh.primitives):
        yield "morph targets"
    if tree.animations:
        yield "animations"


def _instances(tree: Gltf, nodes: Iterable[PlacedNode]) -> list[Instance]:
    """Return every triangle primitive at every node, depth first, in the file's order."""
    instances: list[Instance] = []
    for placed in nodes:
        number = placed.node.mesh
        if number is None:
            continue
        mesh = entry_at(tree.meshes, number, f"{placed.field}.mesh")
        for k, primitive in enumerate(mesh.primitives):
            where = f"meshes[{number}].primitives[{k}]"
            if primitive.mode not in (TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN):
                continue  # points and lines have no surface
            if "POSITION" not in primitive.attributes:
                raise LucidaError(where, "has no POSITION", "export it again")
            if primitive.material is not None:
                entry_at(tree.materials, primitive.material, f"{where}.material")
            name = placed.node.name or mesh.name
            instances.append(Instance((number, k), name, placed.matrix, primitive.material))
        if len(instances) > OBJECTS:
            raise LucidaError("nodes", f"make more than {OBJECTS} objects", "split the model")
    return instances


def _coordinates(
    file: OpenGltf, primitive: Primitive, images: ModelImages, is_mapped: bool
) -> NDArray[Any] | None:
    """Return the texture coordinates of a primitive's vertices; None if it needs or has none."""
    number = coordinates_of(file.tree, primitive, is_mapped)
    try:
        return None if number is None else read_coordinates(file, number)
    except LucidaError as error:
        images.note(str(error))
        return None


def _is_clear(colors: NDArray[Any] | None) -> bool:
    """Return True if the colours of a primitive's vertices have an opacity below 1."""
    if colors is None or colors.shape[1] < 4:
        return False
    most = np.iinfo(colors.dtype).max if colors.dtype.kind in "ui" else 1
    return bool((colors[:, 3] < most).any())


def _fields(file: OpenGltf, primitive: Primitive, where: str) -> dict[str, Any]:
    """Return the fields of a primitive's Part, the colours as they are in the file."""

    def read(name: str) -> NDArray[Any] | None:
        source = primitive.indices if name == "indices" else primitive.attributes.get(name)
        if source is None:
            return None
        return read_numbers(file, source, TYPES[name], f"{where}.{name}")

    vertices, corners = read("POSITION"), read("indices")
    assert vertices is not None
    if corners is None:
        numbers = np.arange(len(vertices))
    else:
        numbers = whole_numbers(corners, f"{where}.indices")
    return {
        "vertices": scaled(vertices, file, primitive.attributes["POSITION"]),
        "faces": triangles_of(numbers, primitive.mode),
        "normals": read("NORMAL"),
        "vertex_colors": read("COLOR_0"),
    }
