"""The outline of an object as a camera sees it: the edges where its surface turns away or ends.
Pure.

The triangles that share an edge are found once for each mesh. The surface turns away at an edge if
both of its triangles are on the same side of the plane through it and the eye. Only edges with
nothing of the object on one side are drawn on the screen. Boxes replace the outlines of many
objects, and of large ones.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import trimesh
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.scene.boxes import extent
from lucida.renderer.scene.model import SceneObject, Sphere
from lucida.renderer.system.memo import Memo

Floats = NDArray[np.float64]

MOST_TRIANGLES = 100_000  # of a mesh; one with more has a box instead
MOST_EXACT = 32  # objects; if there are more, each mesh has its box
CORNERS = 128  # of a sphere's ring

# A box's corners: bit k of a corner's number is set if it is high along axis k.
_HIGH = np.array([[corner >> k & 1 for k in range(3)] for corner in range(8)], bool)
_BOX = np.array([(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b) in (1, 2, 4)])


PIECE_PX = 6.0  # the longest piece of an outline that is drawn or not
ASIDE_PX = 1.5  # from a piece to the samples on its two sides


class MeshEdges(NamedTuple):
    """The edges of a mesh, in its own space.

    ends (n, 2, 3). planes (n, 2, 4): the planes of an edge's two triangles, or twice that of its
    only one, n . p + d = 0, with normals that turn about the edge in one sense. layers (n,): the
    number of its triangles.
    """

    ends: Floats
    planes: Floats
    layers: Floats


class Outline(NamedTuple):
    """Lines where a surface turns away or ends.

    segments (n, 2, 3): in the world. layers (n,): the number of additional layers of surface on the
    left of a segment, as the camera sees it, over the right; 0 for a line that is always drawn.
    """

    segments: Floats
    layers: Floats


def outlines_of(entries: Sequence[SceneObject], camera: Camera) -> list[Outline]:
    """Return the outlines of some objects, including hidden parts."""
    most = MOST_TRIANGLES if len(entries) <= MOST_EXACT else 0
    return [outline_of(entry, camera, most) for entry in entries]


def outline_of(entry: SceneObject, camera: Camera, most: int = MOST_TRIANGLES) -> Outline:
    """Return an object's outline; the edges of its box for a mesh of more than `most` triangles."""
    shape = entry.shape
    if isinstance(shape, Sphere):
        ring = _ring(shape, camera)
        return Outline(ring, np.zeros(len(ring)))
    if len(shape.faces) > most:
        low, high = np.array(extent(shape.vertices), float)
        segments: Floats = np.where(_HIGH, high, low)[_BOX]
        layers = np.zeros(len(segments))
    else:
        # The eye of parallel rays is a direction, whose last component is 0.
        eye = np.append(camera.w, 0.0) if camera.is_parallel else np.append(camera.eye, 1.0)
        edges = edges_of(shape.vertices, shape.faces)
        front = edges.planes @ (np.linalg.inv(shape.transform) @ eye) > 0
        turns = front[:, 0] == front[:, 1]
        segments = edges.ends[turns]
        layers = np.where(front[turns, 0], edges.layers[turns], -edges.layers[turns])
    return Outline(segments @ shape.transform[:3, :3].T + shape.transform[:3, 3], layers)


def outer(points: Floats, layers: Floats, size: Size) -> Floats:
    """Return the pieces (m, 2, 2) of an object's outline that have nothing of it on one side.

    points (n, 2, 2), layers (n,): an outline on a screen of `size` pixels, see Outline. The number
    of layers at a pixel is the sum over the lines left of it in its row.
    """
    ways = points[:, 1] - points[:, 0]
    counts = np.ceil(np.linalg.norm(ways, axis=1) / PIECE_PX).astype(int)
    of = np.repeat(np.arange(len(points)), counts)
    ends = np.arange(len(of))[:, None] - (np.cumsum(counts) - counts)[of, None] + (0, 1)
    pieces = points[of, :1] + (ends / counts[of, None])[..., None] * ways[of, None]
    depth = _layers(points, layers, size)
    along = ways[of] / np.linalg.norm(ways[of], axis=1, keepdims=True)
    aside = ASIDE_PX * np.stack([-along[:, 1], along[:, 0]], axis=1)
    spots = pieces.mean(axis=1) + np.stack([aside, -aside])
    column, row = np.moveaxis(np.clip(spots, 0, np.subtract(size, 1)).astype(int), -1, 0)
    is_open = depth[:, -1] != 0  # a part of the outline is missing, behind the eye
    is_outer = (depth[row, column] == 0) | is_open[row] | (layers[of] == 0)
    found: Floats = pieces[is_outer.any(axis=0)]
    return found


def _layers(points: Floats, layers: Floats, size: Size) -> Floats:
    """Return the number of layers at each pixel, (height, width + 1), one column beyond the
    image.
    """
    width, height = size
    (x, y), (x_end, y_end) = points.transpose(1, 2, 0)
    low, high = np.clip(np.ceil(np.sort([y, y_end], axis=0) - 0.5), 0, height).astype(int)
    of = np.repeat(np.arange(len(points)), high - low)
    row = np.arange(len(of)) - np.repeat(np.cumsum(high - low) - high, high - low)
    share = (row + 0.5 - y[of]) / (y_end - y)[of]
    column = np.clip(np.ceil(x[of] + share * (x_end - x)[of] - 0.5), 0, width).astype(int)
    steps = (np.sign(y_end - y) * layers)[of]
    sums = np.bincount(row * (width + 1) + column, steps, height * (width + 1))
    return sums.reshape(height, width + 1).cumsum(axis=1)


def _ring(sphere: Sphere, camera: Camera) -> Floats:
    """Return the circle where a sphere is seen edge on, (n, 2, 3); none from inside."""
    center, radius, back = np.asarray(sphere.center, float), sphere.radius, 0.0
    way = np.asarray(camera.w if camera.is_parallel else camera.eye - center, float)
    distance = float(np.linalg.norm(way))
    if not camera.is_parallel:
        if distance <= radius * (1 + 1e-9):
            return np.zeros((0, 2, 3))
        back = radius * radius / distance
        radius *= math.sqrt(1 - (radius / distance) ** 2)
    way /= distance
    first = np.cross(way, np.eye(3)[np.abs(way).argmin()])
    first /= np.linalg.norm(first)
    angles = np.arange(CORNERS)[:, None] * (2 * math.pi / CORNERS)
    ring = np.cos(angles) * first + np.sin(angles) * np.cross(way, first)
    ring = center + back * way + radius * ring
    return np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)


def _edges(vertices: NDArray[Any], faces: NDArray[Any]) -> MeshEdges:
    # Merge vertices at one place; meshes have several where their normals differ.
    mesh = trimesh.Trimesh(vertices.astype(float), faces, process=True)
    alone = trimesh.grouping.group_rows(mesh.edges_sorted, require_count=1)  # type: ignore[no-untyped-call]
    borders = mesh.edges_sorted[alone]
    third = mesh.faces[mesh.edges_face[alone]].sum(axis=1) - borders.sum(axis=1)
    ends = mesh.vertices[np.concatenate([mesh.face_adjacency_edges, borders])]
    others = np.concatenate([mesh.face_adjacency_unshared, np.stack([third, third], axis=1)])
    start, end = ends[:, :1], ends[:, 1:]
    normals = np.cross(end - start, mesh.vertices[others] - start)
    planes = np.concatenate([normals, -(normals * start).sum(axis=2, keepdims=True)], axis=2)
    layers = np.repeat([2.0, 1.0], [len(ends) - len(borders), len(borders)])
    return MeshEdges(ends, planes, layers)


edges_of = Memo(_edges, MOST_EXACT)
