"""glTF 2.0 files, .gltf and .glb: the tree checked here, the numbers decoded by trimesh.

Owns the tree: which meshes are where, with which material, and whether every range it names lies
inside the file. Knows nothing of files' containers or of meshes' repair. Skins and animations are
not read; cameras are gltf_cameras.py's, textures gltf_textures.py's.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene.gltf_cameras import camera_views
from renderer.scene.gltf_file import (
    TRIANGLE_FAN,
    TRIANGLE_LIST,
    TRIANGLE_STRIP,
    Accessor,
    Gltf,
    GltfBuffers,
    Node,
    Pbr,
    Primitive,
    entry_at,
    open_gltf,
)
from renderer.scene.gltf_nodes import PlacedNode, placed_nodes
from renderer.scene.gltf_shared import (
    ATTRIBUTES,
    check_bytes_shared,
    check_triangles,
    compacted,
    same_primitives,
)
from renderer.scene.gltf_textures import base_texture, coordinates_of, read_coordinates
from renderer.scene.guard import guarded
from renderer.scene.images import ModelImages
from renderer.scene.limits import BINARY_MODEL_BYTES, OBJECTS
from renderer.scene.model import Material, NamedView
from renderer.scene.parts import Part, linear_colors
from renderer.scene.reading import size_text

COMPONENT_BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


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
        all_buffers = GltfBuffers(tree, binary, path)
        instances = _instances(tree, nodes)
        shown = [(entry.mesh, entry.primitive) for entry in instances]
        same = same_primitives(tree, shown, is_mapped)
        keys = sorted(set(same.values()))
        check_triangles(tree, shown, keys)
        smaller, used_buffers = _smaller_tree(tree, keys)
        buffers = {str(number): all_buffers.get(number) for number in used_buffers}
        materials = _materials(tree, instances, path, all_buffers, images)
    except LucidaError as error:
        raise error if error.source else error.in_file(str(path)) from None
    with guarded(path, "glTF"):
        from trimesh.exchange.gltf import load_gltf

        _check_views(smaller, buffers)
        found = load_gltf(io.BytesIO(msgspec.json.encode(smaller)), buffers, skip_materials=True)
    parts = {}
    shared = Counter(tree.meshes[m].primitives[p].attributes["POSITION"] for m, p in keys)
    for number, (mesh, primitive) in enumerate(keys):
        fields = found["geometry"].get(str(number), {})
        shown_primitive = tree.meshes[mesh].primitives[primitive]
        attributes = shown_primitive.attributes
        fields = fields | {
            "uv": _coordinates(tree, shown_primitive, all_buffers, images, is_mapped)
        }
        position = tree.accessors[attributes["POSITION"]]
        if shared[attributes["POSITION"]] > 1:
            fields = compacted(fields)
        vertices = fields.get("vertices")
        if vertices is not None and position.normalized and vertices.dtype.kind in "ui":
            vertices = vertices / np.iinfo(vertices.dtype).max
        parts[mesh, primitive] = Part(
            tree.meshes[mesh].name,
            vertices,
            fields.get("faces"),
            fields.get("vertex_normals"),
            linear_colors(fields.get("vertex_colors"), linear=True),
            uv=fields["uv"],
        )
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
        if primitive.mode == TRIANGLE_FAN:
            raise LucidaError(f"{where}.mode", "is a triangle fan", "export plain triangles")
        if primitive.mode not in (TRIANGLE_LIST, TRIANGLE_STRIP):
            continue  # points and lines have no surface
        if "POSITION" not in primitive.attributes:
            raise LucidaError(where, "has no POSITION", "export it again")
        if primitive.material is not None:
            entry_at(tree.materials, primitive.material, f"{where}.material")
        name = node.name or mesh.name
        instances.append(Instance(node.mesh, number, name, matrix, primitive.material))
    return instances


def _materials(
    tree: Gltf, instances: list[Instance], path: Path, buffers: GltfBuffers, images: ModelImages
) -> dict[int, Material]:
    """The materials that are used, with their textures."""
    found = {}
    for number in sorted({entry.material for entry in instances if entry.material is not None}):
        pbr = tree.materials[number].pbr_metallic_roughness
        material = _material(pbr)
        if pbr.base_color_texture is not None:
            texture = base_texture(tree, pbr.base_color_texture, path, buffers, images)
            material = replace(material, texture=texture)
        found[number] = material
    return found


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


def _material(pbr: Pbr) -> Material:
    """The nearest of this project's materials: base colour, and a highlight by roughness.

    The exponent is 2 / roughness^4 - 2, after Karis 2013, "Specular BRDF reference"; dielectrics
    reflect 4 %, metals their base colour.
    """
    base = np.clip(np.nan_to_num(pbr.base_color_factor[:3]), 0, 1)
    metallic = min(max(pbr.metallic_factor, 0.0), 1.0)
    roughness = min(max(pbr.roughness_factor, 0.05), 1.0)
    specular = 0.04 + (base - 0.04) * metallic
    shininess = min(max(2 / roughness**4 - 2, 1.0), 1000.0)
    return Material(tuple(base.tolist()), tuple(specular.tolist()), shininess)


# The ranges.


def _smaller_tree(tree: Gltf, keys: list[tuple[int, int]]) -> tuple[dict[str, Any], list[int]]:
    """A tree of only what the primitives `keys` need, one mesh each, and the buffers it uses."""
    accessors: dict[int, int] = {}
    views: dict[int, int] = {}
    meshes = []
    for number, (mesh, index) in enumerate(keys):
        primitive = tree.meshes[mesh].primitives[index]
        where = f"meshes[{mesh}].primitives[{index}]"
        wanted = {
            name: primitive.attributes[name] for name in ATTRIBUTES if name in primitive.attributes
        }
        smaller: dict[str, Any] = {"attributes": {}, "mode": primitive.mode}
        for name, source in wanted.items():
            types = ("VEC3", "VEC4") if name == "COLOR_0" else ("VEC3",)
            _check_accessor(tree, source, types, f"{where}.attributes.{name}")
            smaller["attributes"][name] = accessors.setdefault(source, len(accessors))
        if primitive.indices is not None:
            _check_accessor(tree, primitive.indices, ("SCALAR",), f"{where}.indices")
            smaller["indices"] = accessors.setdefault(primitive.indices, len(accessors))
        meshes.append({"name": str(number), "primitives": [smaller]})
    for source in accessors:
        used = tree.accessors[source].buffer_view
        assert used is not None
        views.setdefault(used, len(views))
    buffers = sorted({tree.buffer_views[number].buffer for number in views})
    new_accessors = []
    for accessor in (tree.accessors[source] for source in accessors):
        assert accessor.buffer_view is not None
        new_accessors.append(
            {
                "bufferView": views[accessor.buffer_view],
                "byteOffset": accessor.byte_offset,
                "componentType": accessor.component_type,
                "count": accessor.count,
                "type": accessor.type,
            }
        )
    new_views = []
    for view in (tree.buffer_views[number] for number in views):
        fields = {
            "buffer": buffers.index(view.buffer),
            "byteOffset": view.byte_offset,
            "byteLength": view.byte_length,
        }
        new_views.append(fields | ({"byteStride": view.byte_stride} if view.byte_stride else {}))
    total = sum(view["byteLength"] for view in new_views)
    if total > 2 * BINARY_MODEL_BYTES:
        raise LucidaError("bufferViews", f"hold {size_text(total)}", "split the model")
    items = sum(_item_bytes(tree.accessors[n]) * tree.accessors[n].count for n in accessors)
    there = sum(tree.buffers[number].byte_length for number in buffers)
    check_bytes_shared(total, items, there)
    smaller_tree = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": str(number)} for number in buffers],
        "bufferViews": new_views,
        "accessors": new_accessors,
        "meshes": meshes,
    }
    return smaller_tree, buffers


def _item_bytes(accessor: Accessor) -> int:
    return COMPONENT_BYTES[accessor.component_type] * COMPONENTS[accessor.type]


def _check_accessor(tree: Gltf, number: int, types: tuple[str, ...], field: str) -> None:
    """Raises LucidaError unless all numbers of the accessor lie inside its buffer view."""
    accessor = entry_at(tree.accessors, number, field)
    field = f"accessors[{number}]"
    if accessor.type not in types or accessor.component_type not in COMPONENT_BYTES:
        raise LucidaError(
            field, f"is {accessor.type[:20]} of type {accessor.component_type}", "export it again"
        )
    if accessor.sparse is not None:
        raise LucidaError(field, "is sparse", "export it without sparse accessors")
    if accessor.buffer_view is None:
        raise LucidaError(field, "has no bufferView", "export it uncompressed")
    view = entry_at(tree.buffer_views, accessor.buffer_view, f"{field}.buffer_view")
    entry_at(tree.buffers, view.buffer, f"bufferViews[{accessor.buffer_view}].buffer")
    item = _item_bytes(accessor)
    stride = view.byte_stride or item
    if stride < item:
        raise LucidaError(
            f"bufferViews[{accessor.buffer_view}].byteStride",
            f"{stride} is below the {item} bytes of an element",
            "export it again",
        )
    need = accessor.byte_offset + max(accessor.count - 1, 0) * stride + item
    if accessor.count < 1 or need > view.byte_length:
        raise LucidaError(
            field,
            f"declares {accessor.count} elements, {need} bytes, in a view of {view.byte_length}",
            "it is damaged; export it again",
        )


def _check_views(tree: dict[str, Any], buffers: dict[str, bytes]) -> None:
    for view in tree["bufferViews"]:
        have = len(buffers[tree["buffers"][view["buffer"]]["uri"]])
        if view["byteOffset"] + view["byteLength"] > have:
            raise ValueError(f"a buffer view ends behind its buffer of {have} bytes")
