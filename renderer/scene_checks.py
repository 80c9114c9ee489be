"""Checks for oddities in a scene: meshes that are open or inside out, degenerate faces, lights
inside objects, objects too small to be visible.

All of them are legal: the renderers draw them as they are. Takes some seconds for a million
triangles, without a Python loop over them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from renderer.scene.flat import flatten
from renderer.scene.model import Mesh, PointLight, Scene, Sphere
from renderer.scene.normals import face_normals, merge_positions
from renderer.scene.parts import LARGEST_UV
from renderer.scene.repairs import Repair
from renderer.scene.schema import DiskTable, RectangleTable

Points = NDArray[np.float64]

SMALL = 1e-6  # relative to the scene's size
MOST_SHELLS = 100  # tested for being inside another one
_NO_AREA = 1e-12  # relative to a triangle's longest side squared
_SURFACES = (RectangleTable, DiskTable)  # open by design
_DIRECTION = np.array([0.5773, 0.5137, 0.6347])  # along no axis, and in no common plane


@dataclass(frozen=True)
class Oddity:
    """An oddity of a scene.

    kind: one word, for programs. text: for people, without the object's name. object: its id;
    light: its number in scene.lights; each None if it does not apply.
    """

    kind: str
    text: str
    object: int | None = None
    light: int | None = None


@dataclass(frozen=True)
class MeshFacts:
    """Facts about a mesh in its own space.

    open_edges: edges of only one face. crowded_edges: of more than two. torn_edges: whose two faces
    have inconsistent winding. shells: the number of closed parts, if all are closed with consistent
    winding. inside_out: the number of shells with a negative volume that are not a hollow inside
    another one. against: the number of vertex normals that oppose their face's winding.
    """

    open_edges: int
    crowded_edges: int
    torn_edges: int
    shells: int
    inside_out: int
    repeated_faces: int
    flat_faces: int
    against: int

    @property
    def is_closed(self) -> bool:
        return self.open_edges == 0


def oddities(scene: Scene, repairs: Sequence[Repair] = ()) -> tuple[Oddity, ...]:
    """Return the oddities of a scene. repairs: those made when its models were read."""
    facts = _facts_of(scene)
    found = [_repaired(repair) for repair in repairs]
    surfaces = _surfaces(scene)
    for number, fact in facts.items():
        found += _told(fact, number, number in surfaces)
    return (*found, *_small(scene), *_lights_inside(scene, facts))


def mesh_facts(mesh: Mesh) -> MeshFacts:
    """Return the facts about a mesh, from a few sorts of its edges."""
    joined = merge_positions(mesh.vertices)
    faces = joined[mesh.faces]
    normals = face_normals(mesh.vertices, faces)
    longest = np.zeros(len(faces))
    for k in range(3):
        side = mesh.vertices[faces[:, k]].astype(float) - mesh.vertices[faces[:, k - 1]]
        longest = np.maximum(longest, np.einsum("ij,ij->i", side, side))
    flat = np.linalg.norm(normals, axis=1) <= _NO_AREA * longest
    a, b, c = np.sort(faces, axis=1).T
    order = np.lexsort((c, b, a))
    corners = np.stack([a, b, c], axis=1)[order]
    repeated = int(np.count_nonzero((corners[1:] == corners[:-1]).all(axis=1)))
    starts, ends = faces.reshape(-1), faces[:, [1, 2, 0]].reshape(-1)
    real = starts != ends
    starts, ends = starts[real], ends[real]
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    keys = low * np.int64(len(mesh.vertices)) + high
    order = np.argsort(keys)
    keys, along = keys[order], (starts < ends)[order]
    new = np.concatenate([[True], keys[1:] != keys[:-1]]) if len(keys) else np.zeros(0, bool)
    first = np.flatnonzero(new)
    count = np.diff(np.append(first, len(keys)))
    forward = np.add.reduceat(along.astype(np.int64), first) if len(first) else count
    torn = int(np.count_nonzero((count == 2) & (forward != 1)))
    opened = int(np.count_nonzero(count == 1))
    crowded = int(np.count_nonzero(count > 2))
    shells, inside_out = (0, 0) if opened or torn else _shells(mesh, faces, normals)
    against = 0
    if mesh.normals is not None:
        summed = mesh.normals[mesh.faces].sum(axis=1)
        against = int(np.count_nonzero(np.einsum("ij,ij->i", summed, normals) < 0))
    flat_faces = int(flat.sum())
    return MeshFacts(opened, crowded, torn, shells, inside_out, repeated, flat_faces, against)


def _shells(mesh: Mesh, faces: NDArray[np.int64], normals: Points) -> tuple[int, int]:
    """Return the number of parts of a closed mesh, and how many are inside out and not in another
    part.

    faces: with coincident corners merged.
    """
    part = np.arange(len(mesh.vertices))  # for each vertex, the least vertex connected to it
    while True:
        least = part[faces].min(axis=1)
        before = part.copy()
        np.minimum.at(part, faces, least[:, None])
        part = part[part]
        if np.array_equal(part, before):
            break
    _, number = np.unique(part[faces[:, 0]], return_inverse=True)
    middle = mesh.vertices.mean(axis=0, dtype=float)
    volumes = np.bincount(
        number, np.einsum("ij,ij->i", mesh.vertices[faces[:, 0]] - middle, normals)
    )
    turned = np.flatnonzero(volumes < 0)
    hollows = 0
    for shell in turned[:MOST_SHELLS] if len(turned) < len(volumes) else ():
        mine = number == shell
        point = mesh.vertices[faces[mine][0]].mean(axis=0, dtype=float)
        hollows += _crossings(mesh.vertices, faces[~mine], point) % 2
    return len(volumes), len(turned) - hollows


def _facts_of(scene: Scene) -> dict[int, MeshFacts]:
    """Return the facts by the objects' ids; meshes that share arrays are examined once."""
    known: dict[tuple[int, int], MeshFacts] = {}
    found = {}
    for number, entry in enumerate(scene.objects):
        if isinstance(mesh := entry.shape, Mesh):
            key = id(mesh.vertices), id(mesh.faces)
            if key not in known:
                known[key] = mesh_facts(mesh)
            found[number] = known[key]
    return found


def _surfaces(scene: Scene) -> set[int]:
    """Return the ids of objects that are open by design."""
    found: set[int] = set()
    number = 0
    for entry in scene.origin.entries if scene.origin is not None else ():
        if isinstance(entry.fields, _SURFACES):
            found.add(number)
        number += len(entry.objects)
    return found


def _told(fact: MeshFacts, number: int, is_surface: bool) -> list[Oddity]:
    texts = []
    if fact.inside_out and fact.inside_out == fact.shells:
        texts.append(("inside-out", "is closed, and its faces are turned inwards"))
    elif fact.inside_out:
        some = f"{fact.inside_out} of {fact.shells} closed parts"
        texts.append(("inside-out", f"has faces that are turned inwards, of {some}"))
    elif fact.torn_edges:
        edges = _counted(fact.torn_edges, "edge that joins", "edges that join")
        texts.append(("turned-differently", f"has {edges} faces turned differently"))
    if fact.open_edges and not is_surface:
        edges = _counted(fact.open_edges, "edge has", "edges have")
        texts.append(("open", f"is open: {edges} one face only"))
    if fact.crowded_edges:
        edges = _counted(fact.crowded_edges, "edge", "edges")
        texts.append(("crowded-edges", f"has {edges} with more than two faces"))
    if fact.repeated_faces:
        faces = _counted(fact.repeated_faces, "face", "faces")
        texts.append(("repeated-faces", f"has {faces} with another one's corners"))
    if fact.flat_faces:
        faces = _counted(fact.flat_faces, "face", "faces")
        texts.append(("flat-faces", f"has {faces} without an area"))
    if fact.against:
        faces = _counted(fact.against, "face", "faces")
        texts.append(("normals-against", f"has vertex normals against the turn of {faces}"))
    return [Oddity(kind, text, number) for kind, text in texts]


def _repaired(repair: Repair) -> Oddity:
    parts = [
        f"{_counted(count, 'face', 'faces')} {what}, left out"
        for count, what in (
            (repair.flat_faces, "without an area"),
            (repair.repeated_faces, "with another one's corners"),
        )
        if count
    ]
    if repair.lost_normals:
        normals = _counted(repair.lost_normals, "normal is", "normals are")
        parts.append(f"{normals} NaN or infinite, its faces are flat there")
    if repair.lost_places:
        places = _counted(repair.lost_places, "texture coordinate is", "texture coordinates are")
        parts.append(f"{places} NaN or beyond {LARGEST_UV:g}, 0 is taken")
    name = f"{repair.name!r}: " if repair.name else ""
    return Oddity("repaired", f"was mended as it was read: {name}{'; '.join(parts)}")


def _small(scene: Scene) -> list[Oddity]:
    """Return the objects that are too small to be visible in any image with the others."""
    flat = flatten(scene)
    size = float(np.linalg.norm(flat.bounds[1] - flat.bounds[0]))
    extent = flat.object_bounds[:, 1] - flat.object_bounds[:, 0]
    stretch = np.linalg.norm(flat.world_from_object[:, :3, :3], axis=1)
    sizes = np.linalg.norm(extent * stretch, axis=1)
    return [
        Oddity("small", f"is {sizes[k]:.3g} across, in a scene of {size:.3g}", k)
        for k, _ in scene.visible
        if sizes[k] < SMALL * size
    ]


def _lights_inside(scene: Scene, facts: dict[int, MeshFacts]) -> list[Oddity]:
    found = []
    for number, light in enumerate(scene.lights):
        if not isinstance(light, PointLight):
            continue
        point = np.asarray(light.position)
        for k, entry in scene.visible:
            shape = entry.shape
            if isinstance(shape, Sphere):
                inside = bool(np.linalg.norm(point - shape.center) < shape.radius)
            else:
                inside = facts[k].is_closed and _is_inside(shape, point)
            if inside:
                name = repr(entry.name) if entry.name else f"object {k}"
                text = f"is inside {name}, which it lights from within only"
                found.append(Oddity("light-inside", text, k, number))
    return found


def _is_inside(mesh: Mesh, point: Points) -> bool:
    """Return True if a ray from the point crosses a closed mesh an odd number of times."""
    inverse = np.linalg.inv(mesh.transform)
    own = inverse[:3, :3] @ point + inverse[:3, 3]
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    if not ((low < own) & (own < high)).all():
        return False
    return _crossings(mesh.vertices, mesh.faces, own) % 2 == 1


def _crossings(vertices: NDArray[np.float32], faces: NDArray[np.integer], point: Points) -> int:
    """Return how many triangles a ray from a point hits."""
    a, b, c = (vertices[faces[:, k]].astype(float) for k in range(3))
    # Möller and Trumbore 1997, all triangles at once.
    first, second = b - a, c - a
    across = np.cross(_DIRECTION, second)
    determinant = np.einsum("ij,ij->i", first, across)
    with np.errstate(all="ignore"):
        offset = point - a
        u = np.einsum("ij,ij->i", offset, across) / determinant
        turned = np.cross(offset, first)
        v = turned @ _DIRECTION / determinant
        t = np.einsum("ij,ij->i", second, turned) / determinant
        hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return int(np.count_nonzero(hit))


def _counted(count: int, one: str, several: str) -> str:
    return f"{count} {one if count == 1 else several}"
