"""The transforms of a glTF tree's nodes.

Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.cameras.rotations import rotation_of
from lucida.renderer.files.models.gltf_file import Gltf, Node, entry_at
from lucida.renderer.system.errors import LucidaError


@dataclass(frozen=True, eq=False)
class PlacedNode:
    """matrix: float64 (4, 4), world_from_node. field: of the node, for errors."""

    node: Node
    matrix: NDArray[np.float64]
    field: str


def placed_nodes(tree: Gltf) -> Iterator[PlacedNode]:
    """Yield the nodes of the scene that have a mesh, a camera or a light, depth first, in the
    file's order. Raises LucidaError if they are not a tree.
    """
    if tree.scenes:
        roots = entry_at(tree.scenes, tree.scene, "scene").nodes
    else:
        children = {child for node in tree.nodes for child in node.children}
        roots = [number for number in range(len(tree.nodes)) if number not in children]
    seen: set[int] = set()
    stack = [(number, np.eye(4)) for number in reversed(roots)]
    while stack:
        number, parent = stack.pop()
        field = f"nodes[{number}]"
        node = entry_at(tree.nodes, number, "nodes")
        if number in seen:
            raise LucidaError(
                field, "has two parents, or is its own ancestor", "give each node one parent"
            )
        seen.add(number)
        with np.errstate(all="ignore"):
            matrix = parent @ node_matrix(node)
        if (node.mesh, node.camera, node.extensions.light) != (None, None, None):
            yield PlacedNode(node, matrix, field)
        stack += [(child, matrix) for child in reversed(node.children)]


def node_matrix(node: Node) -> NDArray[np.float64]:
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
