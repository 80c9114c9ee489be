"""The scene in two levels: a wide tree for each mesh, and an upper tree of instances.

Instances builds a scene's trees, and updates them when objects move. Rays and packets traverse
them.

A mesh's tree is in the mesh's own space. An object is an instance of its mesh: a transform and the
root of a tree. A moved object therefore costs only a new box in the upper tree, and objects that
share a mesh share its tree. Spheres are in the upper tree next to the instances. The upper tree's
space is world space relative to the scene's centre, which keeps its boxes accurate in float32.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.scene.boxes import world_boxes
from lucida.renderer.scene.flat import DIFFUSE_SHININESS, FlatScene
from lucida.renderer.scene.model import Mesh, Scene
from lucida.renderer.trace.threads.thread_pool import Team

from .bvh16 import FIRST_LEAF, WIDTH, WideTree, aligned, tree_of_boxes, tree_of_mesh

# Bits of an instance. Its vertices have normals or colours; its transform changes angles, or is the
# identity; its material has a texture, is single-sided, or has a cutout.
HAS_NORMALS, HAS_COLORS, IS_STRETCHED, IS_UNMOVED, HAS_TEXTURE = 1, 2, 4, 8, 16
IS_SINGLE_SIDED, HAS_HOLES = 32, 64
_SQUASHED = 1e-6  # a transform with a smaller change of angles counts as a similarity
_NO_HIGHLIGHT = 2.0**-24  # relative to the light; smaller highlights are lost in float32
_OUTWARDS = 4e-7  # relative to the coordinates: more than the rounding of bounds to float32
_UNMOVED = np.eye(4)
# The indices of a 3 x 3 matrix's numbers for its cofactors a b - c d, row by row.
_CROSSED = np.array(
    [
        [3 * ((i + m) % 3) + (k + n) % 3 for i in range(3) for k in range(3)]
        for m, n in ((1, 1), (2, 2), (1, 2), (2, 1))
    ]
)


class World(NamedTuple):
    """The data that kernels traverse. Arrays are flat, in C order, as in WideTree unless noted.

    box, child, corner, face, normal: the nodes and leaves of all meshes, one after another.
    top_box, top_child: the upper tree; its leaf k is item k: instance k, or sphere k - instances.
    top: the start of a traversal: node 0, or the leaf if there is only one item.
    root: int32, the root node of an instance's tree. root_object: int32, its object.
    first_primitive: int32, the offset from a triangle's face number to its primitive number.
    object_from_world: float64, 12 per instance: the upper three rows of the matrix.
    normal_matrix: float32, 9 per instance, row by row: transforms a normal to world space and keeps
        it on the winding's side; its length changes only if the transform changes angles.
    attributes: int32, HAS_NORMALS, HAS_COLORS, IS_STRETCHED, IS_UNMOVED, HAS_TEXTURE,
        IS_SINGLE_SIDED, HAS_HOLES.
    dark_cosine: float32, for each object the cosine below which its highlights are negligible.
    spheres: float64, 4 per sphere: centre, radius, in the world. sphere_object: int32.
    faces, uv, textures, texels: of the FlatScene, for holes; None for images without textures.
    middle: float64, 3: the world point at the origin of the upper tree's space.
    instances, triangles: their numbers; sphere k has the primitive number triangles + k.
    is_empty: there is nothing to hit.
    """

    box: NDArray[np.float32]
    child: NDArray[np.int32]
    corner: NDArray[np.float32]
    face: NDArray[np.int32]
    normal: NDArray[np.float32]
    top_box: NDArray[np.float32]
    top_child: NDArray[np.int32]
    root: NDArray[np.int32]
    root_object: NDArray[np.int32]
    first_primitive: NDArray[np.int32]
    object_from_world: NDArray[np.float64]
    normal_matrix: NDArray[np.float32]
    attributes: NDArray[np.int32]
    dark_cosine: NDArray[np.float32]
    spheres: NDArray[np.float64]
    sphere_object: NDArray[np.int32]
    faces: NDArray[np.int32]
    uv: NDArray[np.float32] | None
    textures: NDArray[np.int32] | None
    texels: NDArray[np.int32] | None
    middle: NDArray[np.float64]
    top: int
    instances: int
    triangles: int
    is_empty: bool


class Instances:
    """The two levels of one scene.

    world: the data that kernels traverse. world_from_space: float64 (instances + 1, 4, 4), the
    transform of each instance, and of the upper tree's space. bounds: float64 (instances + 1, 2,
    3), lowest and highest corner in each of these spaces.
    """

    def __init__(self, scene: Scene, flat: FlatScene, team: Team) -> None:
        self._team = team
        self._trees: dict[tuple[int, int], WideTree] = {}
        self._meshes: list[Mesh] = []
        self._numbers: dict[tuple[int, int], int] = {}
        self._build_trees(scene)
        self._place(scene, flat)

    def update(self, scene: Scene, flat: FlatScene) -> None:
        """Update to a changed scene; meshes whose arrays are the same objects keep their trees."""
        if not {_key(mesh) for mesh in _meshes(scene)} <= set(self._trees):
            self._build_trees(scene)
        self._place(scene, flat)

    @property
    def stack_size(self) -> int:
        """The maximum number of waiting nodes in a traversal, of the upper tree and then of a
        mesh's.
        """
        levels = self._top_levels + max((tree.levels for tree in self._trees.values()), default=0)
        return (WIDTH - 1) * levels + 2 * WIDTH

    def _build_trees(self, scene: Scene) -> None:
        """Build a tree for each mesh that has none; drop those of unused meshes."""
        trees: dict[tuple[int, int], WideTree] = {}
        meshes: list[Mesh] = []
        for mesh in _meshes(scene):
            key = _key(mesh)
            if key not in trees:
                meshes.append(mesh)
                trees[key] = self._trees.get(key) or tree_of_mesh(
                    mesh.vertices, mesh.faces, self._team
                )
        for entry in scene.objects:  # hidden objects keep their trees, too
            if entry.hidden and isinstance(entry.shape, Mesh):
                key = _key(entry.shape)
                if key in self._trees and key not in trees:
                    meshes.append(entry.shape)
                    trees[key] = self._trees[key]
        # Assign only now, because building may be abandoned. Keep the meshes alive, because their
        # arrays' ids are the keys.
        self._trees, self._meshes = trees, meshes
        self._join()

    def _join(self) -> None:
        """Join all trees into one array of each kind; children and leaves are renumbered."""
        nodes = leaves = 0
        parts: list[tuple[np.ndarray, ...]] = []
        self._roots: dict[tuple[int, int], int] = {}
        for key, tree in self._trees.items():
            child = tree.child
            if nodes:
                child = np.where(child >= 0, child + np.int32(nodes), child)
                child[tree.child <= FIRST_LEAF] -= np.int32(leaves)
            parts.append((tree.box, child, tree.corner, tree.face, tree.normal))
            self._roots[key] = nodes
            nodes += len(tree.child) // WIDTH
            leaves += len(tree.face) // WIDTH
        dtypes = (np.float32, np.int32, np.float32, np.int32, np.float32)
        if len(parts) == 1:
            self._joined = parts[0]
        else:
            self._joined = tuple(
                _concatenated([part[k] for part in parts], dtype) for k, dtype in enumerate(dtypes)
            )

    def _place(self, scene: Scene, flat: FlatScene) -> None:
        """Compute the instances, the spheres and the tree over them."""
        objects = [
            (number, entry.shape)
            for number, entry in scene.visible
            if isinstance(entry.shape, Mesh)
        ]
        meshes = [mesh for _, mesh in objects]
        object_number = np.array([number for number, _ in objects], np.int32)
        matrix = np.array([mesh.transform for mesh in meshes]).reshape(-1, 4, 4)
        bounds = np.array([self._trees[_key(mesh)].bounds for mesh in meshes]).reshape(-1, 2, 3)
        middle, spheres = (flat.bounds[0] + flat.bounds[1]) / 2, flat.spheres
        low, high = world_boxes(matrix, bounds)
        low = np.concatenate([low, spheres[:, :3] - spheres[:, 3:]]) - middle
        high = np.concatenate([high, spheres[:, :3] + spheres[:, 3:]]) - middle
        margin = _OUTWARDS * np.maximum(np.abs(low), np.abs(high))
        low, high = low - margin, high + margin
        whole = np.array([low.min(0), high.max(0)]) if len(low) else np.zeros((2, 3))
        of_top = _UNMOVED.copy()
        of_top[:3, 3] = middle
        self.world_from_space = np.concatenate([matrix, of_top[None]])
        self.bounds = np.concatenate([bounds, whole[None]])
        top_box, top_child, self._top_levels = np.empty(0, np.float32), np.empty(0, np.int32), 1
        if len(low) > 1:
            top_box, top_child, self._top_levels = tree_of_boxes(
                low.astype(np.float32), high.astype(np.float32), self._team
            )
        normal_matrix, is_stretched = _normal_matrices(matrix)
        shininess = flat.materials[:, DIFFUSE_SHININESS, 3]
        self.world = World(
            box=self._joined[0],
            child=self._joined[1],
            corner=self._joined[2],
            face=self._joined[3],
            normal=self._joined[4],
            top_box=top_box,
            top_child=top_child,
            root=np.array([self._roots[_key(mesh)] for mesh in meshes], np.int32),
            root_object=object_number,
            first_primitive=flat.object_faces[object_number, 0],
            object_from_world=np.linalg.inv(matrix)[:, :3].reshape(-1),
            normal_matrix=normal_matrix.astype(np.float32).reshape(-1),
            attributes=_attributes(meshes, is_stretched)
            + HAS_TEXTURE * (flat.textures[object_number, 0, 1] > 0).astype(np.int32)
            + HAS_HOLES * (flat.textures[object_number, 1, 1] >= 0).astype(np.int32)
            + IS_SINGLE_SIDED * flat.single_sided[object_number].astype(np.int32),
            dark_cosine=(_NO_HIGHLIGHT ** (1 / shininess)).astype(np.float32),
            spheres=spheres.reshape(-1).copy(),
            sphere_object=flat.sphere_object.copy(),
            faces=flat.faces,
            uv=flat.uv,
            textures=flat.textures,
            texels=flat.texels,
            middle=middle,
            top=FIRST_LEAF if len(low) == 1 else 0,
            instances=len(meshes),
            triangles=len(flat.faces),
            is_empty=not len(low),
        )


def _concatenated(parts: list[np.ndarray], dtype: type) -> np.ndarray:
    whole = aligned(sum(len(part) for part in parts), dtype)
    return np.concatenate(parts, out=whole) if parts else whole


def _meshes(scene: Scene) -> list[Mesh]:
    return [entry.shape for _, entry in scene.visible if isinstance(entry.shape, Mesh)]


def _key(mesh: Mesh) -> tuple[int, int]:
    return id(mesh.vertices), id(mesh.faces)


def _attributes(meshes: list[Mesh], is_stretched: NDArray[np.bool_]) -> NDArray[np.int32]:
    bits = [
        HAS_NORMALS * (mesh.normals is not None)
        + HAS_COLORS * (mesh.colors is not None)
        + IS_STRETCHED * bool(stretched)
        + IS_UNMOVED * np.array_equal(mesh.transform, _UNMOVED)
        for mesh, stretched in zip(meshes, is_stretched, strict=True)
    ]
    return np.array(bits, np.int32)


def _normal_matrices(
    world_from_object: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the cofactor matrices (n, 3, 3), and a mask (n,) of transforms that change angles.

    cross(M a, M b) = cofactor(M) cross(a, b). They are scaled so that a similarity results in a
    rotation.
    """
    linear = world_from_object[:, :3, :3]
    rows = linear.reshape(-1, 9)
    a, b, c, d = _CROSSED
    cofactor = (rows[:, a] * rows[:, b] - rows[:, c] * rows[:, d]).reshape(-1, 3, 3)
    volume = np.abs((linear[:, 0] * cofactor[:, 0]).sum(axis=1))
    cofactor /= np.cbrt(volume)[:, None, None] ** 2
    gram = np.swapaxes(cofactor, 1, 2) @ cofactor
    return cofactor, np.abs(gram - _UNMOVED[:3, :3]).max(axis=(1, 2)) > _SQUASHED
