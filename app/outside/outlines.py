"""The outlines of a scene's objects for a camera, for line drawings.

A mesh's outline consists of the edges between a triangle that faces the viewer and one that does
not, and of edges of only one triangle. Sharp edges are added, so that a box looks like one. A
sphere's outline is an exact ellipse. Pure; knows nothing of visibility and colours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import polyline
from app.outside.screen import OutsideScreen
from renderer.camera import Camera
from renderer.scene.model import Mesh, Scene, Sphere

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

MOST_TRIANGLES = 200_000  # of all meshes together; what comes after has no outline
MOST_SHARP = 20_000  # edges of a mesh; one with more is rough all over
SHARP_DEG = 35.0  # between the planes of two triangles
LARGEST_PX = 1e5  # an ellipse that is larger is drawn as many short lines
CORNERS = 256  # of a sphere's outline that is no ellipse
NO_DEPTH = np.zeros(3)


@dataclass(frozen=True, eq=False)
class Edges:
    """The edges of an object: points (n, 2, 2), depth (n, 2) as in projected.Strokes. sharp (n,):
    True for those inside the outline.
    """

    points: Floats
    depth: Floats
    sharp: Bools


class Ellipse(NamedTuple):
    """An ellipse: center and radii in pixels, tilt of the first radius in radians, y down.

    depth (3,): s of a point is its product with (x, y, 1).
    """

    center: tuple[float, float]
    radii: tuple[float, float]
    tilt: float = 0.0
    depth: Floats = NO_DEPTH

    def at(self, angles: Floats) -> Floats:
        """Return points (n, 2) at angles of the ellipse, in radians."""
        cosine, sine = math.cos(self.tilt), math.sin(self.tilt)
        x, y = self.radii[0] * np.cos(angles), self.radii[1] * np.sin(angles)
        across = self.center[0] + cosine * x - sine * y
        return np.stack([across, self.center[1] + sine * x + cosine * y], axis=-1)

    def depth_at(self, points: Floats) -> Floats:
        depth: Floats = points @ self.depth[:2] + self.depth[2]
        return depth


class Outline(NamedTuple):
    """The outline of an object, and its name."""

    name: str
    form: Edges | Ellipse


def outlines(scene: Scene, screen: OutsideScreen) -> tuple[list[Outline], list[str]]:
    """Return the outlines of all objects, and the names of those with too many triangles."""
    found: list[Outline] = []
    left_out: list[str] = []
    triangles = 0
    for number, entry in scene.visible:
        name, shape = entry.name or f"object {number}", entry.shape
        if isinstance(shape, Sphere):
            form: Edges | Ellipse | None = sphere_outline(shape, screen)
        elif triangles + len(shape.faces) > MOST_TRIANGLES:
            left_out.append(name)
            continue
        else:
            triangles += len(shape.faces)
            form = mesh_outline(shape, screen)
        if form is not None:
            found.append(Outline(name, form))
    return found, left_out


def mesh_outline(mesh: Mesh, screen: OutsideScreen) -> Edges | None:
    """Return the outline of a mesh, or None if nothing of it is visible."""
    with np.errstate(over="ignore", invalid="ignore"):
        linear, shift = mesh.transform[:3, :3], mesh.transform[:3, 3]
        world = mesh.vertices.astype(float) @ linear.T + shift
    # Vertices at one place are one: meshes have several where their normals differ.
    places, same = np.unique(world, axis=0, return_inverse=True)
    faces = same.reshape(-1)[mesh.faces]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    if not len(faces) or not np.isfinite(places).all():
        return None
    ends, chosen, sharp = _edges(places, faces, screen)
    points, depth, numbers = screen.segments(places[ends[chosen]])
    if not len(points):
        return None
    return Edges(points, depth, sharp[chosen][numbers])


def _edges(
    places: Floats, faces: NDArray[np.int64], screen: OutsideScreen
) -> tuple[NDArray[np.int64], Bools, Bools]:
    """Return all edges (n, 2); which are in the outline or sharp; which are only sharp."""
    corners = np.concatenate([faces[:, [0, 1, 2]], faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]])
    pairs = np.sort(corners[:, :2], axis=1)
    ends, edge, count = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    edge = edge.reshape(-1)
    first, second, apex = places[pairs[:, 0]], places[pairs[:, 1]], places[corners[:, 2]]
    camera = screen.camera
    eye = np.asarray(camera.eye, float)
    to_viewer = np.asarray(camera.w, float) if camera.is_parallel else eye - first
    along, inward = second - first, apex - first
    # The side of the edge on which the triangle is seen: a volume's sign.
    volume = np.einsum("ij,ij->i", np.cross(along, inward), np.broadcast_to(to_viewer, along.shape))
    size = np.linalg.norm(along, axis=1) * np.linalg.norm(inward, axis=1)
    distance = np.linalg.norm(to_viewer, axis=-1)
    side = np.sign(np.where(np.abs(volume) > 1e-9 * size * distance, volume, 0.0))
    lowest, highest = np.full(len(ends), 1.0), np.full(len(ends), -1.0)
    np.minimum.at(lowest, edge, side)
    np.maximum.at(highest, edge, side)
    outline = (lowest * highest >= 0) | (count == 1)
    sharp = ~outline & (count == 2) & _bent(along, inward, edge, len(ends))
    if sharp.sum() > MOST_SHARP:
        sharp[:] = False
    return ends, outline | sharp, sharp


def _bent(along: Floats, inward: Floats, edge: NDArray[np.int64], count: int) -> Bools:
    """Return whether the planes of each edge's two triangles form an angle."""
    lengths = np.einsum("ij,ij->i", along, along)
    with np.errstate(all="ignore"):
        across = inward - along * (np.einsum("ij,ij->i", inward, along) / lengths)[:, None]
        across = np.nan_to_num(across / np.linalg.norm(across, axis=1, keepdims=True))
    # Two unit vectors u, v at an edge: |u + v|^2 = 2 + 2 u v, 0 where they go on straight.
    total = np.zeros((count, 3))
    np.add.at(total, edge, across)
    limit = 2 - 2 * math.cos(math.radians(SHARP_DEG))
    bent: Bools = np.einsum("ij,ij->i", total, total) > limit
    return bent


def sphere_outline(sphere: Sphere, screen: OutsideScreen) -> Ellipse | Edges | None:
    """Return the outline of a sphere, or None from inside it or if nothing is visible.

    Where the plane through the eye cuts the sphere, its outline is no ellipse but a hyperbola, made
    of short lines.

    Source: Hartley and Zisserman, Multiple View Geometry, 8.3: C* = P Q* P^T, Q* the sphere's dual
    quadric; here about its own centre, diag(r^2, r^2, r^2, -1).
    """
    center, radius = np.array([sphere.center], float), np.array([sphere.radius])
    ring = contours(center, radius, screen.camera).reshape(-1, 3)
    points, depth, numbers = screen.segments(polyline(ring, closed=True))
    if not len(points):
        return None
    short = Edges(points, depth, np.zeros(len(points), bool))
    camera = screen.camera
    # pixels, multiplied by t in perspective, and t
    unit = screen.homogeneous(np.vstack([np.zeros(3), np.eye(3)]))
    axes = (unit[1:] - unit[0])[:, :3].T
    spot = screen.homogeneous(center[0])[:3]
    if camera.is_parallel:
        axes[2], spot[2] = 0.0, 1.0
    with np.errstate(all="ignore"):
        conic = sphere.radius**2 * axes @ axes.T - np.outer(spot, spot)
        conic = conic / -conic[2, 2] if conic[2, 2] < 0 and spot[2] > 0 else np.full((3, 3), np.nan)
    if len(numbers) < len(ring) or not np.isfinite(conic).all():
        return short
    middle = -conic[:2, 2]
    squares, ways = np.linalg.eigh(np.outer(middle, middle) + conic[:2, :2])
    if not 0 < squares[0] <= squares[1] < LARGEST_PX**2:
        return short
    # s is affine on the screen for points of a plane, and the outline is in one.
    rows = np.column_stack([points[:, 0], np.ones(len(points))])
    plane = np.asarray(np.linalg.lstsq(rows, depth[:, 0], rcond=None)[0], np.float64)
    x, y = (middle + np.asarray(screen.size) / 2).tolist()
    tilt = math.atan2(ways[1, 1], ways[0, 1])
    return Ellipse((x, y), (math.sqrt(squares[1]), math.sqrt(squares[0])), tilt, plane)


def contours(centers: Floats, radii: Floats, camera: Camera, corners: int = CORNERS) -> Floats:
    """Return the circles on spheres where they are seen edge on, (m, corners, 3), without spheres
    that the eye is inside of.

    centers: (n, 3). radii: (n,).
    """
    if camera.is_parallel:
        way = np.broadcast_to(np.asarray(camera.w, float), centers.shape)
        way, back = way / np.linalg.norm(camera.w), np.zeros(len(radii))
    else:
        way = np.asarray(camera.eye, float) - centers
        distance = np.linalg.norm(way, axis=1)
        outside = distance > radii * (1 + 1e-9)
        centers, radii, way, distance = (part[outside] for part in (centers, radii, way, distance))
        way, back = way / distance[:, None], radii * (radii / distance)
        radii = radii * np.sqrt(1 - (radii / distance) ** 2)
    helper = np.eye(3)[np.abs(way).argmin(axis=1)]
    first = np.cross(way, helper)
    first = first / np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(way, first)
    angles = np.arange(corners) * (2 * math.pi / corners)
    ring = np.cos(angles)[:, None] * first[:, None] + np.sin(angles)[:, None] * second[:, None]
    found: Floats = (centers + back[:, None] * way)[:, None] + radii[:, None, None] * ring
    return found
