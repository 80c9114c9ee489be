"""A scene as flat arrays: the one form that both renderers read.

FlatScene defines the arrays' layout. The rasterizer uploads these arrays as textures, and the
tracer's kernel indexes them, so neither uses SceneObjects.

The world is float64; float32 only holds distances from a near point. A mesh's vertices are float32
in the object's own space, relative to its origin; a float64 matrix places them in the world.
Compute a world point in float64, and make it relative to a point at or near the eye, before
converting it to float32. A scene a million units from the world's origin therefore looks as it does
at the origin, and all renderers use the same triangles. float64 has its limit where its steps
become visible: at 1e9 units, they are 1e-7 units.

A primitive is a triangle or a sphere. Triangles have the numbers 0 to m - 1, in the order of the
objects, and sphere s has the number m + s.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import arrays_text
from lucida.renderer.images.shared_numbers import CHECKERED
from lucida.renderer.system.errors import LucidaError

from .boxes import extent, world_boxes
from .flat_textures import TextureArrays, on_sphere, texture_arrays
from .model import Checker, Mesh, PointLight, Scene, SceneObject, Shape, Sphere

F32 = NDArray[np.float32]
F64 = NDArray[np.float64]
I32 = NDArray[np.int32]

# Rows of a material, each four numbers.
DIFFUSE_SHININESS, SPECULAR_CHECKERED, CHECKER_DIFFUSE = range(3)
PLAIN, TEXTURED = 0, 2  # its pattern, if it is not CHECKERED
# The arrays that do not change when objects are moved.
_LAYOUT = (
    *("vertices", "colors", "faces", "face_object", "sphere_object"),
    *("object_faces", "object_vertices", "object_sphere"),
)
BLOCK = 4096  # normals at a time, so that intermediate results stay in the cache


class FlatScene(NamedTuple):
    """Arrays in C order, read-only; any of them may have length 0. A hidden object keeps its rows,
    but has no vertices, faces or sphere.

    vertices (n, 3): float32, in the space of their object
    normals (n, 3; 0: flat), colors (n, 3): float32, world space, linear light
    faces (m, 3): int32, vertices of triangle m. face_object (m,): int32, its object
    spheres (k, 4): float64, centre, radius, world space. sphere_object (k,): int32, its object
    object_faces (objects, 2): int32, first triangle and number of triangles of each object
    object_vertices (objects, 2): int32, first vertex and number of vertices
    object_sphere (objects,): int32, its sphere, or -1
    object_bounds (objects, 2, 3): float64, lowest and highest corner in its own space
    world_from_object (objects, 4, 4): float64; a sphere's own space begins at its centre
    materials (objects, 3, 4): float32, diffuse rgb, shininess | specular rgb, the pattern: PLAIN,
        CHECKERED or TEXTURED | for a checker, the other cells' diffuse rgb, 0; for a texture, a, b,
        c, d: (u, v) has the texel coordinates (a u + b, c v + d)
    cells (objects, 3, 4): float64, cell_from_world, an affine map of world points to checker cells:
        the cell of point p is floor(cell_from_world p), and a cell whose three numbers have an odd
        sum takes the other diffuse
    uv (n, 2): float32, vertices' texel coordinates, column and row from the upper left corner of
        their object's image; 0 if it has none. The shape is (0, 2) if no object has any
    textures (objects, 2, 4): int32, first texel, width, height and wraps (shared_numbers) of each
        object's image, 0 if it has none | the first texels of two more images of that size, or -1:
            the specular light, which multiplies the material's, and the opacity, negative in holes;
            -1, -1
    texels (k,): int32, packed_texels() of all images, or packed_opacity(), one after another; each
        image has one more column and one more row, which repeat the texels that follow there
    single_sided (objects,): uint8, 1 if triangles are visible on one side only (model.py)
    lights (l, 2, 4): float64 (float32 from lights_from()), x, y, z, 1 if a point, 0 if a unit
        direction towards the light | rgb, 0
    ambient (3,), background (3,): float32
    bounds (2, 3): float64, lowest and highest corner of everything in the world, around each
        object's own bounds; both 0 for an empty scene
    """

    vertices: F32
    normals: F32
    colors: F32
    faces: I32
    face_object: I32
    spheres: F64
    sphere_object: I32
    object_faces: I32
    object_vertices: I32
    object_sphere: I32
    object_bounds: F64
    world_from_object: F64
    materials: F32
    cells: F64
    uv: F32
    textures: I32
    texels: I32
    single_sided: NDArray[np.uint8]
    lights: F64 | F32
    ambient: F32
    background: F32
    bounds: F64

    def __repr__(self) -> str:
        return arrays_text(self)


def flatten(scene: Scene, known: tuple[Scene, FlatScene] | None = None) -> FlatScene:
    """Return the scene's arrays. Raises LucidaError if a transformed mesh leaves float32's range.

    known: a scene that was flattened before, and its arrays. If the two differ only in places and
    materials, their common arrays are reused.
    """
    old = known[1] if known and _layout_of(known[0]) == _layout_of(scene) else None
    layout = _same_layout(old) if old is not None else _new_layout(scene)
    world_from_object = _world_from_object(scene)
    object_bounds = _object_bounds(scene, old)
    low, high = _checked_boxes(scene, world_from_object, object_bounds)
    seen = [entry.shape for _, entry in scene.visible]
    spheres = [(*s.center, s.radius) for s in seen if isinstance(s, Sphere)]
    is_seen = [not entry.hidden for entry in scene.objects]
    textured = texture_arrays(scene, layout["object_vertices"], known and _known_textures(*known))
    flat = FlatScene(
        **layout,
        normals=_normals(scene, old, world_from_object),
        spheres=np.array(spheres, np.float64).reshape(-1, 4),
        object_bounds=object_bounds,
        world_from_object=world_from_object,
        materials=_material_rows(scene, textured.textures),
        cells=_cell_rows(scene, world_from_object),
        **textured._asdict(),
        single_sided=np.array([e.material.single_sided for e in scene.objects], np.uint8),
        lights=_light_rows(scene),
        ambient=np.array(scene.ambient, np.float32),
        background=np.array(scene.background, np.float32),
        bounds=np.array([low[is_seen].min(0), high[is_seen].max(0)]) if seen else np.zeros((2, 3)),
    )
    for array in flat:
        array.setflags(write=False)
    return flat


def same_places(scene: Scene, old: Scene) -> list[int]:
    """Return, for each object of a scene, the number of a visible one in the old scene with the
    same arrays and place, or -1.
    """
    return _same(scene, old, lambda mesh: (_arrays(mesh), mesh.transform.tobytes()))


def same_meshes(scene: Scene, old: Scene) -> list[int]:
    """Return same_places() regardless of the objects' places."""
    return _same(scene, old, _arrays)


def _same(scene: Scene, old: Scene, key: Callable[[Mesh], Hashable]) -> list[int]:
    known = {key(e.shape): number for number, e in old.visible if isinstance(e.shape, Mesh)}
    return [
        known.get(key(e.shape), -1) if isinstance(e.shape, Mesh) and not e.hidden else -1
        for e in scene.objects
    ]


def _known_textures(scene: Scene, flat: FlatScene) -> tuple[Scene, I32, TextureArrays]:
    arrays = TextureArrays(flat.uv, flat.textures, flat.texels)
    return scene, flat.object_vertices, arrays


def _same_layout(flat: FlatScene) -> dict[str, Any]:
    return {name: getattr(flat, name) for name in _LAYOUT}


def _new_layout(scene: Scene) -> dict[str, Any]:
    meshes = [entry.shape for _, entry in scene.visible if isinstance(entry.shape, Mesh)]
    counts = [_room(entry) for entry in scene.objects]
    object_vertices, object_faces = (
        _ranges([count[kind] for count in counts]) for kind in range(2)
    )
    spheres = np.array([isinstance(e.shape, Sphere) and not e.hidden for e in scene.objects], bool)
    colors = [np.ones_like(m.vertices) if m.colors is None else m.colors for m in meshes]
    firsts = object_vertices[object_faces[:, 1] > 0, 0]
    faces = [m.faces + k if k else m.faces for m, k in zip(meshes, firsts, strict=True)]
    numbers = np.arange(len(scene.objects), dtype=np.int32)
    return dict(
        vertices=_stack([mesh.vertices for mesh in meshes], np.float32),
        colors=_stack(colors, np.float32),
        faces=_stack(faces, np.int32),
        face_object=np.repeat(numbers, object_faces[:, 1]),
        sphere_object=numbers[spheres],
        object_faces=object_faces,
        object_vertices=object_vertices,
        object_sphere=np.where(spheres, np.cumsum(spheres) - 1, -1).astype(np.int32),
    )


def _shapes(scene: Scene) -> list[Shape]:
    return [entry.shape for entry in scene.objects]


def _layout_of(scene: Scene) -> list[tuple[int, ...]]:
    """Return a key of each object's arrays: one number for a sphere, () if it is hidden."""
    return [() if entry.hidden else _arrays(entry.shape) for entry in scene.objects]


def _arrays(shape: Shape) -> tuple[int, ...]:
    if isinstance(shape, Sphere):
        return (0,)
    return id(shape.vertices), id(shape.faces), id(shape.normals), id(shape.colors)


def _room(entry: SceneObject) -> tuple[int, int]:
    """Return the number of vertices and faces that an object takes."""
    shape = entry.shape
    if entry.hidden or not isinstance(shape, Mesh):
        return 0, 0
    return len(shape.vertices), len(shape.faces)


def _ranges(counts: list[int]) -> I32:
    """Return (first, count) of each of several parts of an array, one after another."""
    return np.column_stack([np.cumsum(counts) - counts, counts]).astype(np.int32)


def _stack(parts: list[NDArray[Any]], dtype: type) -> NDArray[Any]:
    if len(parts) == 1:
        return parts[0]
    return np.concatenate(parts) if parts else np.zeros((0, 3), dtype)


def _world_from_object(scene: Scene) -> F64:
    matrices = np.tile(np.eye(4), (len(scene.objects), 1, 1))
    for matrix, shape in zip(matrices, _shapes(scene), strict=True):
        if isinstance(shape, Sphere):
            matrix[:3, 3] = shape.center
        else:
            matrix[:] = shape.transform
    return matrices


def _object_bounds(scene: Scene, old: FlatScene | None) -> F64:
    bounds = np.empty((len(scene.objects), 2, 3))
    for number, shape in enumerate(_shapes(scene)):
        if isinstance(shape, Sphere):
            bounds[number, 0], bounds[number, 1] = -shape.radius, shape.radius
        elif old is not None and not scene.objects[number].hidden:
            bounds[number] = old.object_bounds[number]
        else:
            bounds[number] = extent(shape.vertices)
    return bounds


def _checked_boxes(scene: Scene, world_from_object: F64, object_bounds: F64) -> tuple[F64, F64]:
    """Return the objects' boxes in the world. Raises LucidaError if float32 cannot square one."""
    with np.errstate(over="ignore", invalid="ignore"):
        low, high = world_boxes(world_from_object, object_bounds)
        usable = ((np.abs(low) < 1e15) & (np.abs(high) < 1e15)).all(axis=1)
    if not usable.all():
        number = int(np.argmin(usable))
        name = scene.objects[number].name
        field = f"object {number} ({name})" if name else f"object {number}"
        raise LucidaError(field, "its transform is too large", "scale it down")
    return low, high


def _normals(scene: Scene, old: FlatScene | None, world_from_object: F64) -> F32:
    """Return the world normals. Objects that have not been rotated keep known ones."""
    turns = world_from_object[:, :3, :3]
    if old is not None and np.array_equal(turns, old.world_from_object[:, :3, :3]):
        return old.normals
    parts = []
    for number, entry in scene.visible:
        if not isinstance(mesh := entry.shape, Mesh):
            continue
        if old is not None and (turns[number] == old.world_from_object[number, :3, :3]).all():
            first, count = old.object_vertices[number]
            parts.append(old.normals[first : first + count])
        else:
            parts.append(_world_normals(mesh))
    return _stack(parts, np.float32)


def _world_normals(mesh: Mesh) -> F32:
    """Return a mesh's normals in the world, by the inverse transpose; rows of 0 stay 0."""
    if mesh.normals is None:
        return np.zeros(mesh.vertices.shape, np.float32)  # unlike zeros_like(), of untouched memory
    across = np.linalg.inv(mesh.transform[:3, :3]).T
    normals = np.empty_like(mesh.normals)
    for start in range(0, len(normals), BLOCK):
        own = mesh.normals[start : start + BLOCK].T.astype(np.float64, order="C")
        x, y, z = world = across @ own
        lengths = np.sqrt(x * x + y * y + z * z)
        world /= np.where(lengths > 0, lengths, 1.0)
        normals[start : start + BLOCK] = world.T
    return normals


def _material_rows(scene: Scene, textures: I32) -> F32:
    rows = np.zeros((len(scene.objects), 3, 4), np.float32)
    for row, entry, (_, width, height, _) in zip(rows, scene.objects, textures[:, 0], strict=True):
        material, image = entry.material, entry.material.image
        row[DIFFUSE_SHININESS] = *material.diffuse, material.shininess
        pattern = CHECKERED if material.checker else TEXTURED if image else PLAIN
        specular = material.specular if material.metal is None else (1.0, 1.0, 1.0)
        row[SPECULAR_CHECKERED] = *specular, pattern
        if image is not None and not image.rotate_deg:
            row[CHECKER_DIFFUSE] = on_sphere(image, (int(width), int(height)))
        else:
            row[CHECKER_DIFFUSE, :3] = (material.checker or Checker()).diffuse
    return rows


def _cell_rows(scene: Scene, world_from_object: F64) -> F64:
    size = np.array([(e.material.checker or Checker()).size for e in scene.objects])
    rows = np.linalg.inv(world_from_object)[:, :3] / size[:, None, None]
    # Half a cell moves an object's own planes (a floor's y = 0) to the middle of a cell.
    rows[:, :, 3] += 0.5
    return rows


def _light_rows(scene: Scene) -> F64:
    rows = np.zeros((len(scene.lights), 2, 4))
    for row, light in zip(rows, scene.lights, strict=True):
        if isinstance(light, PointLight):
            row[0] = *light.position, 1
        else:
            row[0, :3] = -np.asarray(light.direction) / np.linalg.norm(light.direction)
        row[1, :3] = light.color
    return rows
