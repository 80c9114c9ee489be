"""glTF 2.0 files, .gltf and .glb: the meshes, their placements and their materials.

Skins, morph targets and animations are not read, only reported.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.cameras.rotations import rotation_of
from lucida.renderer.files.reading import check_count
from lucida.renderer.files.texture_images import ModelImages
from lucida.renderer.scene.limits import OBJECTS, TRIANGLES
from lucida.renderer.scene.material import Material
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError

from .gltf_file import (
    AGAIN,
    MATERIALS,
    READ,
    TRIANGLE_FAN,
    TRIANGLE_LIST,
    TRIANGLE_STRIP,
    Gltf,
    Node,
    OpenGltf,
    Primitive,
)
from .gltf_materials import read_materials
from .parts import Part, linear_colors

SURFACES = TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN


@dataclass(frozen=True, eq=False)
class PlacedNode:
    """matrix: float64 (4, 4), world_from_node."""

    node: Node
    matrix: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PlacedPart:
    """A primitive of a mesh at a node. Instances of the same numbers share their part."""

    part: Part
    name: str
    matrix: NDArray[np.float64]
    material: Material | None


@dataclass(frozen=True, eq=False)
class GltfContent:
    """The primitives at their nodes; the tree and its placed nodes, for cameras and lights."""

    parts: list[PlacedPart]
    tree: Gltf
    nodes: list[PlacedNode]


def read_gltf(path: Path, images: ModelImages) -> GltfContent:
    """Return the content of a .gltf or .glb file. images: for its textures. Raises LucidaError."""
    file = OpenGltf(path)
    tree = file.tree
    nodes = list(placed_nodes(tree))
    if still := list(_not_moved(tree)):
        images.note(f"not shown: {', '.join(still)}", "shapes")
    if left := [n for n in tree.extensions_used if n not in READ and not MATERIALS.match(n)]:
        images.note(f"not read: {', '.join(left)}", "extensions")
    shown = [
        (placed, mesh, primitive)
        for placed in nodes
        if placed.node.mesh is not None
        for mesh in (tree.entry("meshes", placed.node.mesh),)
        for primitive in mesh.primitives
        if primitive.mode in SURFACES
    ]
    check_count(len(shown), OBJECTS, "objects", "nodes")
    triangles = sum(_triangles(tree, primitive) for _, _, primitive in shown)
    check_count(triangles, TRIANGLES, "triangles")
    materials = read_materials(file, {primitive.material for _, _, primitive in shown}, images)
    parts: dict[Hashable, Part] = {}
    found = []
    for placed, mesh, primitive in shown:
        material = None if primitive.material is None else materials[primitive.material]
        has_backs = material is not None and material.single_sided
        # A few bytes of JSON can show one buffer a thousand times; it is built only once.
        used = _accessors(tree, primitive)
        views = (None if number is None else tree.entry("accessors", number) for number in used)
        key = primitive.mode, has_backs, *views
        if key not in parts:
            check_cancelled()
            parts[key] = _part(file, mesh.name, primitive.mode, used, has_backs, images)
        found.append(PlacedPart(parts[key], placed.node.name or mesh.name, placed.matrix, material))
    return GltfContent(found, tree, nodes)


def placed_nodes(tree: Gltf) -> Iterator[PlacedNode]:
    """Yield the nodes of the scene, depth first, in the file's order. Raises LucidaError if they
    are not a tree.
    """
    if tree.scenes:
        roots = tree.entry("scenes", tree.scene).nodes
    else:
        children = {child for node in tree.nodes for child in node.children}
        roots = [number for number in range(len(tree.nodes)) if number not in children]
    seen: set[int] = set()
    stack = [(number, np.eye(4)) for number in reversed(roots)]
    while stack:
        number, parent = stack.pop()
        node: Node = tree.entry("nodes", number)
        if number in seen:
            problem = "has two parents, or is its own ancestor"
            raise LucidaError(f"nodes[{number}]", problem, "give each node one parent")
        seen.add(number)
        with np.errstate(all="ignore"):
            matrix = parent @ _node_matrix(node)
        yield PlacedNode(node, matrix)
        stack += [(child, matrix) for child in reversed(node.children)]


def _node_matrix(node: Node) -> NDArray[np.float64]:
    """Return parent_from_node: `matrix` (column-major), or translation * rotation * scale."""
    if node.matrix is not None:
        matrix = np.array(node.matrix).reshape(4, 4).T
        matrix[3] = 0, 0, 0, 1
        return matrix
    x, y, z, w = node.rotation
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_of([w, x, y, z]) * node.scale
    matrix[:3, 3] = node.translation
    return matrix


def _not_moved(tree: Gltf) -> Iterator[str]:
    """Yield the features that would move the meshes' vertices, and primitives without surface."""
    primitives = [primitive for mesh in tree.meshes for primitive in mesh.primitives]
    if any(node.skin is not None for node in tree.nodes):
        yield "skins"
    if any(primitive.targets for primitive in primitives):
        yield "morph targets"
    if tree.animations:
        yield "animations"
    if any(primitive.mode not in SURFACES for primitive in primitives):
        yield "points and lines"


def _accessors(tree: Gltf, primitive: Primitive) -> tuple[int | None, ...]:
    """Return the accessors of a primitive's positions, normals, colours, indices, and texture
    coordinates (the set that its material's image uses).
    """
    if "POSITION" not in primitive.attributes:
        raise LucidaError("meshes", "have a primitive without POSITION", AGAIN)
    places = "TEXCOORD_0"
    if primitive.material is not None:
        pbr = tree.materials[primitive.material].pbr_metallic_roughness
        if info := pbr.base_color_texture or pbr.metallic_roughness_texture:
            places = info.attribute
    given = primitive.attributes.get
    return given("POSITION"), given("NORMAL"), given("COLOR_0"), primitive.indices, given(places)


def _triangles(tree: Gltf, primitive: Primitive) -> int:
    """Return the number of triangles of a primitive, which has not been read."""
    number = primitive.indices
    if number is None:
        number = primitive.attributes.get("POSITION")
    count = 0 if number is None else tree.entry("accessors", number).count
    return count // 3 if primitive.mode == TRIANGLE_LIST else max(count - 2, 0)


def _part(
    file: OpenGltf,
    name: str,
    mode: int,
    used: tuple[int | None, ...],
    has_backs: bool,
    images: ModelImages,
) -> Part:
    """Return a primitive's part. used: the result of _accessors()."""
    position, normal, color, indices, place = used
    assert position is not None
    vertices = file.fractions(position, "VEC3")
    corners = np.arange(len(vertices))
    if indices is not None:
        found = file.numbers(indices, "SCALAR")
        if found.dtype.kind != "u":
            raise LucidaError(f"accessors[{indices}]", f"has indices of {found.dtype}", AGAIN)
        corners = found[:, 0].astype(np.int64)
    uv = None
    if place is not None:
        try:
            uv = file.fractions(place, "VEC2").astype(np.float32)
            uv[:, 1] = 1 - uv[:, 1]
        except LucidaError as error:
            images.note(str(error))
    colors = None if color is None else file.numbers(color, "VEC3", "VEC4")
    return Part(
        name,
        vertices,
        triangles_of(corners, mode),
        None if normal is None else file.numbers(normal, "VEC3"),
        linear_colors(colors, linear=True),
        uv=uv,
        has_backs=has_backs,
    )


def triangles_of(corners: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    """Return the triangles (m, 3) of a list, strip or fan of vertices, counter-clockwise from the
    front. Triangles that repeat a vertex only join strips, and are left out.
    """
    if mode == TRIANGLE_LIST:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    first, second, third = corners[:-2], corners[1:-1], corners[2:]
    if mode == TRIANGLE_FAN:
        return np.stack([second, third, np.broadcast_to(corners[:1], second.shape)], axis=1)
    faces = np.stack([first, second, third], axis=1)
    faces[1::2, 1:] = faces[1::2, :0:-1]  # every other triangle has the opposite winding
    return faces
