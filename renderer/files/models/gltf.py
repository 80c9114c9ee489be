"""glTF 2.0 files, .gltf and .glb: which meshes are where, with which material.

Skins, morph targets and animations are not read, only reported.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.models.gltf_file import (
    MATERIALS,
    READ,
    TRIANGLE_FAN,
    TRIANGLE_LIST,
    TRIANGLE_STRIP,
    Accessor,
    Gltf,
    OpenGltf,
    Primitive,
    entry_at,
)
from lucida.renderer.files.models.gltf_materials import read_materials
from lucida.renderer.files.models.gltf_nodes import PlacedNode, placed_nodes
from lucida.renderer.files.models.gltf_numbers import (
    read_numbers,
    scaled,
    triangles_of,
    whole_numbers,
)
from lucida.renderer.files.models.gltf_textures import read_coordinates
from lucida.renderer.files.models.parts import Part, linear_colors
from lucida.renderer.files.reading import check_count
from lucida.renderer.files.texture_images import ModelImages
from lucida.renderer.scene.limits import OBJECTS, TRIANGLES
from lucida.renderer.scene.material import Material
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError

# The types of accessors that primitives may name.
TYPES = {
    "POSITION": ("VEC3",),
    "NORMAL": ("VEC3",),
    "COLOR_0": ("VEC3", "VEC4"),
    "indices": ("SCALAR",),
}
SURFACES = TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN


@dataclass(frozen=True, eq=False)
class Instance:
    """A primitive of a mesh at a node. matrix: world_from_object. field: of the primitive."""

    primitive: Primitive
    name: str
    mesh_name: str
    matrix: NDArray[np.float64]
    field: str


@dataclass(frozen=True, eq=False)
class PlacedPart:
    """The primitive that an instance draws. Instances of the same numbers share their part."""

    part: Part
    name: str
    matrix: NDArray[np.float64]
    material: Material | None


@dataclass(frozen=True, eq=False)
class GltfContent:
    """The instances; the tree and its placed nodes, for cameras and lights."""

    parts: list[PlacedPart]
    tree: Gltf
    nodes: list[PlacedNode]


def read_gltf(path: Path, images: ModelImages) -> GltfContent:
    """Return the content of a .gltf or .glb file. images: for its textures. Raises LucidaError."""
    file = OpenGltf(path)
    tree = file.tree
    nodes = list(placed_nodes(tree))
    instances = _instances(tree, nodes)
    check_count(
        sum(_triangles(tree, entry.primitive) for entry in instances), TRIANGLES, "triangles"
    )
    if still := list(_not_moved(tree, nodes)):
        images.note(f"not shown: {', '.join(still)}", "shapes")
    if left := [n for n in tree.extensions_used if n not in READ and not MATERIALS.match(n)]:
        images.note(f"not read: {', '.join(left)}", "extensions")
    materials = read_materials(file, {entry.primitive.material for entry in instances}, images)
    parts: dict[Hashable, Part] = {}
    placed = []
    for entry in instances:
        given = entry.primitive
        material = None if given.material is None else materials[given.material]
        has_backs = material is not None and material.single_sided
        places = _coordinates_of(tree, given)
        # A few bytes of JSON can show one buffer a thousand times: it is built once.
        numbers = given.indices, *map(given.attributes.get, TYPES), places
        key = given.mode, has_backs, *(_accessor(tree, number) for number in numbers)
        if key not in parts:
            check_cancelled()
            fields = _fields(file, given, entry.field)
            fields["vertex_colors"] = linear_colors(fields["vertex_colors"], linear=True)
            fields["uv"] = _coordinates(file, places, images)
            parts[key] = Part(entry.mesh_name, **fields, has_backs=has_backs)
        placed.append(PlacedPart(parts[key], entry.name, entry.matrix, material))
    return GltfContent(placed, tree, nodes)


def _not_moved(tree: Gltf, nodes: Iterable[PlacedNode]) -> Iterator[str]:
    """Yield what would move the meshes' vertices."""
    if any(placed.node.skin is not None for placed in nodes):
        yield "skins"
    if any(primitive.targets for mesh in tree.meshes for primitive in mesh.primitives):
        yield "morph targets"
    if tree.animations:
        yield "animations"
    if any(part.mode not in SURFACES for mesh in tree.meshes for part in mesh.primitives):
        yield "points and lines"


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
            if primitive.mode not in SURFACES:
                continue
            if "POSITION" not in primitive.attributes:
                raise LucidaError(where, "has no POSITION", "export it again")
            if primitive.material is not None:
                entry_at(tree.materials, primitive.material, f"{where}.material")
            name = placed.node.name or mesh.name
            instances.append(Instance(primitive, name, mesh.name, placed.matrix, where))
        if len(instances) > OBJECTS:
            raise LucidaError("nodes", f"make more than {OBJECTS} objects", "split the model")
    return instances


def _accessor(tree: Gltf, number: int | None) -> Accessor | None:
    return None if number is None else entry_at(tree.accessors, number, "accessors")


def _triangles(tree: Gltf, primitive: Primitive) -> int:
    """Return the number of triangles of a primitive, which has not been read."""
    number = primitive.indices
    corners = _accessor(tree, primitive.attributes["POSITION"] if number is None else number)
    count = 0 if corners is None else corners.count
    return count // 3 if primitive.mode == TRIANGLE_LIST else max(count - 2, 0)


def _coordinates_of(tree: Gltf, primitive: Primitive) -> int | None:
    """Return the accessor of a primitive's texture coordinates: those of its material's image."""
    name = "TEXCOORD_0"
    if primitive.material is not None:
        pbr = tree.materials[primitive.material].pbr_metallic_roughness
        if info := pbr.base_color_texture or pbr.metallic_roughness_texture:
            name = info.attribute
    return primitive.attributes.get(name)


def _coordinates(file: OpenGltf, number: int | None, images: ModelImages) -> NDArray[Any] | None:
    """Return texture coordinates; None if there are none, or they cannot be read."""
    try:
        return None if number is None else read_coordinates(file, number)
    except LucidaError as error:
        images.note(str(error))
        return None


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
