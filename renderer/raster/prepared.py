"""The slow part of uploading a scene to the rasterizer, which needs no OpenGL.

Any thread may prepare a scene while the thread with the context draws.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import Floats
from lucida.renderer.images.shared_numbers import (
    CHECKERED,
    OBJECT_TEXELS,
    ROW_CELLS,
    ROW_CHECKER,
    ROW_DIFFUSE,
    ROW_WORLD,
)
from lucida.renderer.scene.flat import SPECULAR_CHECKERED, FlatScene, flatten, same_meshes
from lucida.renderer.scene.model import Scene, check_scene


class SceneSetup(NamedTuple):
    """The part of the setup that does not depend on the camera.

    planes: (m, 4), normal and -offset in the object space of the triangle, relative to the centre
    of the object's bounds there, so that N.p - offset is 0 on the triangle; float64. They stay the
    same when the object moves. object_from_world: (objects, 3, 3), for directions. vertex_object:
    (n,), int32. middles: (objects, 3), the centres of the objects' bounds, in their own spaces;
    turned_middles: from their origins, in the world. is_seen: (objects,), False for hidden ones.
    object_rows: the part of object_rows() that does not depend on the camera.
    """

    planes: Floats
    object_from_world: Floats
    vertex_object: NDArray[np.int32]
    middles: Floats
    turned_middles: Floats
    is_seen: NDArray[np.bool_]
    object_rows: NDArray[np.float32]


class Prepared(NamedTuple):
    """The scene's arrays, and those that the triangle setup needs."""

    flat: FlatScene
    setup: SceneSetup


def prepare(scene: Scene, known: tuple[Scene, Prepared] | None = None) -> Prepared:
    """Prepare a scene for Rasterizer(), or set_scene().

    known: an earlier scene and its result, whose common parts are reused. Raises LucidaError (see
    flatten).
    """
    check_scene(scene)
    if known is None:
        flat = flatten(scene)
        return Prepared(flat, scene_setup(flat))
    old, prepared = known
    flat = flatten(scene, (old, prepared.flat))
    return Prepared(flat, scene_setup(flat, prepared, same_meshes(scene, old)))


def scene_setup(
    flat: FlatScene,
    known: tuple[FlatScene, SceneSetup] | None = None,
    same: Sequence[int] = (),
) -> SceneSetup:
    """Return planes of triangles, the objects' inverses and the vertices' objects.

    known: of an earlier scene. same: for each object, the number of one in it with the same mesh,
    in any transform, or -1; its planes are reused.
    """
    linear, middles = flat.world_from_object[:, :3, :3], flat.object_bounds.mean(axis=1)
    return SceneSetup(
        known[1].planes
        if known and _is_same_layout(flat, known[0])
        else _planes(flat, known, same),
        np.asarray(np.linalg.inv(linear), np.float64),
        np.repeat(np.arange(len(flat.materials), dtype=np.int32), flat.object_vertices[:, 1]),
        middles,
        np.einsum("nij,nj->ni", linear, middles),
        (flat.object_faces[:, 1] > 0) | (flat.object_sphere >= 0),
        _fixed_rows(flat),
    )


def _is_same_layout(flat: FlatScene, old: FlatScene) -> bool:
    return flat.vertices is old.vertices and flat.faces is old.faces


def _planes(
    flat: FlatScene, known: tuple[FlatScene, SceneSetup] | None, same: Sequence[int]
) -> Floats:
    planes = np.empty((len(flat.faces), 4))
    for number, (first, count) in enumerate(flat.object_faces):
        mine = planes[first : first + count]
        if known is not None and same[number] >= 0:
            start = known[0].object_faces[same[number], 0]
            mine[:] = known[1].planes[start : start + count]
            continue
        mine[:] = object_planes(flat, number)
    return planes


def object_planes(flat: FlatScene, number: int) -> Floats:
    """Return the planes (m, 4) of an object's m triangles, relative to the centre of its box."""
    (first, count), (start, vertices) = flat.object_faces[number], flat.object_vertices[number]
    points = flat.vertices[start : start + vertices] - flat.object_bounds[number].mean(axis=0)
    a, b, c = (points[flat.faces[first : first + count, k] - start] for k in range(3))
    normals = np.cross(b - a, c - a)
    return np.column_stack([normals, -np.einsum("ij,ij->i", normals, a)])


def _fixed_rows(flat: FlatScene) -> NDArray[np.float32]:
    """Return the result of object_rows() that fits any camera, and 0 for the rest."""
    rows = np.zeros((len(flat.materials), OBJECT_TEXELS, 4), np.float32)
    linear = flat.world_from_object[:, :3, :3]
    rows[:, ROW_WORLD : ROW_WORLD + 3, :3] = linear
    rows[:, ROW_DIFFUSE : ROW_DIFFUSE + 3] = flat.materials
    scale = np.einsum("ni,ni->n", flat.cells[:, 0, :3], linear[:, :, 0])
    is_checkered = flat.materials[:, SPECULAR_CHECKERED, 3] == CHECKERED
    rows[:, ROW_CHECKER, 3] = np.where(is_checkered, scale, rows[:, ROW_CHECKER, 3])
    rows[:, ROW_CELLS:, :3] = flat.cells[:, :, :3]
    return rows
