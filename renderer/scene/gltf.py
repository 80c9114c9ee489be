"""glTF 2.0 files, .gltf and .glb.

Owns the tree: which meshes are where, with which material. Knows nothing of files' containers or of
meshes' repair. Skins and animations are not read; cameras are gltf_cameras.py's, numbers
gltf_numbers.py's, materials gltf_materials.py's.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
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
    GltfBuffers,
    Node,
    Primitive,
    entry_at,
    open_gltf,
)
from renderer.scene.gltf_materials import read_materials
from renderer.scene.gltf_nodes import PlacedNode, placed_nodes
from renderer.scene.gltf_numbers import (
    check_accessor,
    check_sizes,
    read_numbers,
    triangles_of,
    whole_numbers,
)
from renderer.scene.gltf_shared import (
    ATTRIBUTES,
    check_bytes_shared,
    check_triangles,
    compacted,
    same_primitives,
)
from renderer.scene.gltf_textures import coordinates_of, read_coordinates
from renderer.scene.images import ModelImages
from renderer.scene.limits import OBJECTS
from renderer.scene.model import Material, NamedView
from renderer.scene.parts import Part, linear_colors

# Of what accessors may be.
TYPES = {
    "POSITION": ("VEC3",),
    "NORMAL": ("VEC3",),
    "COLOR_0": ("VEC3", "VEC4"),
    "indices": ("SCALAR",),
}


@dataclass(frozen=True, eq=False)
class Instance:
    """A primitive of a mesh in the place of a node: indices, name, and world_from_object. material:
    its index, or None."""

    mesh: int
    primitive: int
    name: str
    matrix: NDArray[np.float64]
    material: int | None


@dataclass(frozen=True, eq=False)
class GltfFile:
    """instances, the parts (mesh, primitive) that they show, their materials, and the views of its
    cameras."""

    instances: list[Instance]
    parts: dict[tuple[int, int], Part]
    materials: dict[int, Material]
    views: tuple[NamedView, ...]


def read_gltf(path: Path, images: ModelImages, is_mapped: bool = False) -> GltfFile:
    """The instances and parts of a .gltf or .glb file. images: for its textures. is_mapped: all
    parts with texture coordinates. Raises LucidaError naming the file."""
    try:
        tree, binary = open_gltf(path)
        nodes = list(placed_nodes(tree))
        buffers = GltfBuffers(tree, binary, path)
        instances = _instances(tree, nodes)
        shown = [(entry.mesh, entry.primitive) for entry in instances]
        same = same_primitives(tree, shown, is_mapped)
        keys = sorted(set(same.values()))
        check_triangles(tree, shown, keys)
        _check_accessors(tree, keys, buffers)
        materials = read_materials(
            tree, {entry.material for entry in instances}, path, buffers, images
        )
        shared = Counter(tree.meshes[m].primitives[p].attributes["POSITION"] for m, p in keys)
        users = [
            (same[entry.mesh, entry.primitive], materials[entry.material])
            for entry in instances
            if entry.material is not None
        ]
        single_sided = {key for key, material in users if material.single_sided}
        cut_out = {key for key, material in users if material.cutout is not None}
        parts = {}
        for mesh, primitive in keys:
            check_cancelled()
            fields = _fields(tree, mesh, primitive, buffers)
            given = tree.meshes[mesh].primitives[primitive]
            fields["uv"] = _coordinates(tree, given, buffers, images, is_mapped)
            if shared[given.attributes["POSITION"]] > 1:
                fields = compacted(fields)
            fields["has_backs"] = (mesh, primitive) in single_sided
            if (mesh, primitive) in cut_out and _is_clear(tree, given, buffers):
                images.note("the opacity of vertices cuts no holes", "materials")
            parts[mesh, primitive] = Part(tree.meshes[mesh].name, **fields)
    except LucidaError as error:
        raise error if error.source else error.in_file(str(path)) from None
    shown_parts = {key: parts[first] for key, first in same.items()}
    return GltfFile(instances, shown_parts, materials, camera_views(tree, nodes))


# The tree.


def _instances(tree: Gltf, nodes: Iterable[PlacedNode]) -> list[Instance]:
    """Every triangle primitive at every node of the scene, depth first, in the file's order."""
    instances: list[Instance] = []
    for placed in nodes:
        if placed.node.mesh is not None:
            instances += _mesh_instances(tree, placed.node, placed.matrix, placed.field)
        if len(instances) > OBJECTS:
            raise LucidaError("nodes", f"make more than {OBJECTS} objects", "split the model")
    return instances


def _mesh_instances(
    tree: Gltf, node: Node, matrix: NDArray[np.float64], field: str
) -> list[Instance]:
    assert node.mesh is not None
    mesh = entry_at(tree.meshes, node.mesh, f"{field}.mesh")
    instances = []
    for number, primitive in enumerate(mesh.primitives):
        where = f"meshes[{node.mesh}].primitives[{number}]"
        if primitive.mode not in (TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN):
            continue  # points and lines have no surface
        if "POSITION" not in primitive.attributes:
            raise LucidaError(where, "has no POSITION", "export it again")
        if primitive.material is not None:
            entry_at(tree.materials, primitive.material, f"{where}.material")
        name = node.name or mesh.name
        instances.append(Instance(node.mesh, number, name, matrix, primitive.material))
    return instances


def _coordinates(
    tree: Gltf, primitive: Primitive, buffers: GltfBuffers, images: ModelImages, is_mapped: bool
) -> NDArray[Any] | None:
    """The texture coordinates of a primitive's vertices; None where it needs or has none."""
    number = coordinates_of(tree, primitive, is_mapped)
    if number is None:
        return None
    try:
        return read_coordinates(tree, number, buffers)
    except LucidaError as error:
        images.note(str(error))
        return None


def _is_clear(tree: Gltf, primitive: Primitive, buffers: GltfBuffers) -> bool:
    """Return whether the colours of a primitive's vertices have an opacity below 1."""
    source = primitive.attributes.get("COLOR_0")
    if source is None or tree.accessors[source].type != "VEC4":
        return False
    opacity = read_numbers(tree, source, buffers, TYPES["COLOR_0"], "COLOR_0")[:, 3]
    return bool(
        (opacity < (np.iinfo(opacity.dtype).max if opacity.dtype.kind in "ui" else 1)).any()
    )


# The numbers.


def _check_accessors(tree: Gltf, keys: list[tuple[int, int]], buffers: GltfBuffers) -> None:
    """Raise LucidaError where the primitives name accessors that cannot be, or too much."""
    used: dict[int, None] = {}
    for mesh, index in keys:
        primitive = tree.meshes[mesh].primitives[index]
        where = f"meshes[{mesh}].primitives[{index}]"
        wanted = [(n, f"{where}.attributes.{n}", primitive.attributes.get(n)) for n in ATTRIBUTES]
        for name, field, source in (*wanted, ("indices", f"{where}.indices", primitive.indices)):
            if source is not None:
                accessor = entry_at(tree.accessors, source, field)
                check_accessor(accessor, buffers, TYPES[name], f"accessors[{source}]")
                used[source] = None
    check_bytes_shared(*check_sizes(tree, list(used)))


def _fields(tree: Gltf, mesh: int, index: int, buffers: GltfBuffers) -> dict[str, Any]:
    """Return a primitive's fields of its Part."""
    primitive = tree.meshes[mesh].primitives[index]
    where = f"meshes[{mesh}].primitives[{index}]"

    def read(name: str) -> NDArray[Any] | None:
        source = primitive.indices if name == "indices" else primitive.attributes.get(name)
        if source is None:
            return None
        return read_numbers(tree, source, buffers, TYPES[name], f"{where}.{name}")

    vertices, corners = read("POSITION"), read("indices")
    assert vertices is not None
    if vertices.dtype.kind in "ui" and tree.accessors[primitive.attributes["POSITION"]].normalized:
        vertices = np.maximum(vertices / np.iinfo(vertices.dtype).max, -1)
    if corners is None:
        numbers = np.arange(len(vertices))
    else:
        numbers = whole_numbers(corners, f"{where}.indices")
    return {
        "vertices": vertices,
        "faces": triangles_of(numbers, primitive.mode),
        "normals": read("NORMAL"),
        "vertex_colors": linear_colors(read("COLOR_0"), linear=True),
    }
