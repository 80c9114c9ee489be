"""A scene as flat arrays in world space: the one form that both renderers read.

Owns the arrays' layout. Knows nothing of cameras, BVHs or GL. The rasterizer uploads these arrays
as textures, the tracer's kernel indexes them: neither sees a SceneObject.

A primitive is a triangle or a sphere: triangles have the numbers 0 to m - 1, in the order of the
objects, and sphere s has the number m + s.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.errors import LucidaError
from renderer.scene.model import (
    Checker,
    Material,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Shape,
    Sphere,
)

F32 = NDArray[np.float32]
I32 = NDArray[np.int32]

# Rows of a material, each four numbers.
DIFFUSE_SHININESS, SPECULAR_CHECKERED, CHECKER_DIFFUSE, CELL_X, CELL_Y, CELL_Z = range(6)

# Cells: how far below the surface a checker is looked up, so that a face that lies in a cell's
# border stays inside one cell. shaders/chunks/shading.glsl has the same number.
CELL_NUDGE = 1e-3


class FlatScene(NamedTuple):
    """float32 and int32 arrays, C order, read-only; any of them may have length 0.

    vertices (n, 3), normals (n, 3; 0: flat), colors (n, 3): world space, linear light
    faces (m, 3): vertices of triangle m. face_object (m,): its object
    spheres (k, 4): centre, radius. sphere_object (k,): its object
    object_faces (objects, 2): first triangle and number of triangles of each object
    object_sphere (objects,): its sphere, or -1
    materials (objects, 6, 4): diffuse rgb, shininess | specular rgb, 1 if checkered | the other
        cells' diffuse rgb, 0 | three rows of cell_from_world, an affine map of world points to
        checker cells: the cell of point p is floor(cell_from_world p), and a cell whose three
        numbers have an odd sum takes the other diffuse
    lights (l, 2, 4): x, y, z, 1 if a point, 0 if a unit direction towards the light | rgb, 0
    ambient (3,), background (3,)
    bounds (2, 3): lowest and highest corner of everything; both 0 for an empty scene
    """

    vertices: F32
    normals: F32
    colors: F32
    faces: I32
    face_object: I32
    spheres: F32
    sphere_object: I32
    object_faces: I32
    object_sphere: I32
    materials: F32
    lights: F32
    ambient: F32
    background: F32
    bounds: F32


def flatten(scene: Scene, known: tuple[Scene, FlatScene] | None = None) -> FlatScene:
    """The scene's arrays. Raises LucidaError where a transformed mesh leaves float32's range.

    known: a scene that was flattened before, and its arrays; what the two scenes have in common
    (the same objects of Python's, at the same place) is copied from them.
    """
    count = len(scene.objects)
    vertices: list[F32] = []
    normals: list[F32] = []
    colors: list[F32] = []
    faces: list[I32] = []
    face_object: list[I32] = []
    spheres: list[tuple[float, float, float, float]] = []
    sphere_object: list[int] = []
    object_faces = np.zeros((count, 2), np.int32)
    object_sphere = np.full(count, -1, np.int32)
    materials = np.zeros((count, 6, 4), np.float32)
    first_vertex = first_face = 0
    same_so_far = known is not None
    for number, entry in enumerate(scene.objects):
        shape = entry.shape
        old = known[0].objects[number] if known and number < len(known[0].objects) else None
        transform: NDArray[np.float64] = np.eye(4)
        object_faces[number] = first_face, 0
        if isinstance(shape, Sphere):
            transform[:3, 3] = shape.center
            object_sphere[number] = len(spheres)
            spheres.append((*shape.center, shape.radius))
            sphere_object.append(number)
        else:
            transform = shape.transform
            if known and old and same_so_far and old.shape is shape:
                parts = _known_parts(known[1], shape, first_vertex, first_face)
            else:
                parts = _world_parts(number, entry, shape, first_vertex)
            vertices.append(parts[0])
            normals.append(parts[1])
            colors.append(parts[2])
            faces.append(parts[3])
            face_object.append(np.full(len(shape.faces), number, np.int32))
            object_faces[number, 1] = len(shape.faces)
            first_vertex += len(shape.vertices)
            first_face += len(shape.faces)
        if known and old is entry:
            materials[number] = known[1].materials[number]
        else:
            materials[number] = _material_rows(entry.material, transform)
        same_so_far = same_so_far and old is not None and _room(old.shape) == _room(shape)
    flat_vertices = _stack(vertices, (0, 3), np.float32)
    flat_spheres = np.array(spheres, np.float32).reshape(-1, 4)
    flat = FlatScene(
        vertices=flat_vertices,
        normals=_stack(normals, (0, 3), np.float32),
        colors=_stack(colors, (0, 3), np.float32),
        faces=_stack(faces, (0, 3), np.int32),
        face_object=_stack(face_object, (0,), np.int32),
        spheres=flat_spheres,
        sphere_object=np.array(sphere_object, np.int32),
        object_faces=object_faces,
        object_sphere=object_sphere,
        materials=materials,
        lights=_light_rows(scene),
        ambient=np.array(scene.ambient, np.float32),
        background=np.array(scene.background, np.float32),
        bounds=_bounds(flat_vertices, flat_spheres),
    )
    for array in flat:
        array.setflags(write=False)
    return flat


def _world_parts(
    number: int, entry: SceneObject, mesh: Mesh, first_vertex: int
) -> tuple[F32, F32, F32, I32]:
    """A mesh's part of the vertices, normals, colors and faces."""
    transform = mesh.transform
    with np.errstate(over="ignore", invalid="ignore"):
        world = mesh.vertices @ transform[:3, :3].T + transform[:3, 3]
        usable = (np.abs(world) < 1e15).all()
    if not usable:
        field = f"object {number} ({entry.name})" if entry.name else f"object {number}"
        raise LucidaError(field, "its transform is too large", "scale it down")
    colors = np.ones_like(mesh.vertices) if mesh.colors is None else mesh.colors
    faces = mesh.faces + np.int32(first_vertex)
    return world.astype(np.float32), _world_normals(mesh), colors, faces


def _known_parts(
    flat: FlatScene, mesh: Mesh, first_vertex: int, first_face: int
) -> tuple[F32, F32, F32, I32]:
    """The same, of a mesh that is at the same place of flattened arrays."""
    vertices = slice(first_vertex, first_vertex + len(mesh.vertices))
    faces = slice(first_face, first_face + len(mesh.faces))
    return flat.vertices[vertices], flat.normals[vertices], flat.colors[vertices], flat.faces[faces]


def _room(shape: Shape) -> tuple[int, int]:
    """How many vertices and faces a shape takes."""
    return (len(shape.vertices), len(shape.faces)) if isinstance(shape, Mesh) else (0, 0)


def _stack(parts: list, shape: tuple[int, ...], dtype: type) -> np.ndarray:
    return np.concatenate(parts) if parts else np.zeros(shape, dtype)


def _world_normals(mesh: Mesh) -> F32:
    """Normals go by the inverse transpose; rows of 0 stay 0."""
    if mesh.normals is None:
        return np.zeros_like(mesh.vertices)
    inverse = np.linalg.inv(mesh.transform[:3, :3])
    world = mesh.normals.astype(float) @ inverse
    lengths = np.linalg.norm(world, axis=1, keepdims=True)
    return np.divide(world, lengths, out=np.zeros_like(world), where=lengths > 0).astype(np.float32)


def _material_rows(material: Material, world_from_object: np.ndarray) -> F32:
    rows = np.zeros((6, 4), np.float32)
    rows[DIFFUSE_SHININESS] = *material.diffuse, material.shininess
    rows[SPECULAR_CHECKERED] = *material.specular, material.checker is not None
    checker = material.checker or Checker()
    rows[CHECKER_DIFFUSE, :3] = checker.diffuse
    # The half cell puts an object's own planes (a floor's y = 0) in the middle of a cell.
    object_from_world = np.linalg.inv(world_from_object)
    rows[CELL_X:] = object_from_world[:3] / checker.size
    rows[CELL_X:, 3] += 0.5
    return rows


def _light_rows(scene: Scene) -> F32:
    rows = np.zeros((len(scene.lights), 2, 4), np.float32)
    for row, light in zip(rows, scene.lights, strict=True):
        if isinstance(light, PointLight):
            row[0] = *light.position, 1
        else:
            row[0, :3] = -np.asarray(light.direction) / np.linalg.norm(light.direction)
        row[1, :3] = light.color
    return rows


def extent(vertices: F32) -> tuple[F32, F32]:
    """The lowest and the highest corner (3,) of points (n, 3), n > 0, in C order."""
    # Many numbers a row: along rows of three, NumPy takes ten times as long.
    whole = len(vertices) // 64 * 64
    parts = [vertices[whole:]]
    if whole:
        rows = vertices[:whole].reshape(-1, 64 * 3)
        parts += [rows.min(0).reshape(64, 3), rows.max(0).reshape(64, 3)]
    corners = np.concatenate(parts)
    return corners.min(0), corners.max(0)


def _bounds(vertices: F32, spheres: F32) -> F32:
    low, high = [], []
    if len(vertices):
        lowest, highest = extent(vertices)
        low, high = [lowest], [highest]
    if len(spheres):
        low.append((spheres[:, :3] - spheres[:, 3:]).min(0))
        high.append((spheres[:, :3] + spheres[:, 3:]).max(0))
    if not low:
        return np.zeros((2, 3), np.float32)
    return np.stack([np.min(low, 0), np.max(high, 0)]).astype(np.float32)
