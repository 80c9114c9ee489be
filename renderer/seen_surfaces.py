"""The surfaces of a scene as the rays of an image see them, in float64.

Each primitive's surface is extended beyond its outline, so that what is seen of it at a pixel can
be differentiated: its ray parameter, normal and colour. renderer/edges.py finds lines in these.

All functions take arrays of pixels: i, j (n,) rows and columns, primitive (n,) numbers of the flat
scene (-1: none).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from renderer.camera import NEAREST, Camera, Floats
from renderer.lens_faces import Face
from renderer.scene.flat import FlatScene
from renderer.scene.positions import world_corners
from renderer.slivers import seen_corners

Ints = NDArray[np.integer]
Bools = NDArray[np.bool_]
Numbers = NDArray[np.integer] | NDArray[np.floating]
Function = Callable[[Numbers, Numbers], Floats]  # of a position (rows, columns) in the image

STEP_PX = 1 / 256  # of the central differences: well inside the tolerance, far above rounding
# A position's error in float32 after a few roundings, relative to its distance.
ROUNDING_32 = 2.0**-21
# The least margin in pixels around the image that GL clips to (as in raster/scene_data.py).
MARGIN = 1024
# Includes the error of GL's clipping where it cuts a triangle at NEAREST of its farthest corner.
CLIPPED_FROM = NEAREST + ROUNDING_32


# Degenerate primitives and misses: their NaN and infinities are replaced at the end.
quiet = partial(np.errstate, divide="ignore", invalid="ignore", over="ignore")


def dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("nk,nk->n", a, b)


def length(a: Floats) -> Floats:
    return np.linalg.norm(a, axis=1)


def slope_of(function: Function, i: Numbers, j: Numbers) -> Floats:
    """Return the change per pixel of a function of the position, in the direction of its largest
    change.

    The function returns numbers (n,) or (n, 3).
    """
    with quiet():
        across = function(i, j + STEP_PX) - function(i, j - STEP_PX)
        down = function(i + STEP_PX, j) - function(i - STEP_PX, j)
        return np.hypot(across, down) / (2 * STEP_PX)


@dataclass(frozen=True)
class SeenSurfaces:
    """The surfaces of one scene as seen by one camera in an image of (width, height).

    face: the face of a lens's image that this is, with its camera and size: ray parameters are then
    those of the lens's rays. camera: has no lens.
    """

    flat: FlatScene
    camera: Camera
    size: tuple[int, int]
    face: Face | None = None

    def ray(self, i: Numbers, j: Numbers) -> tuple[Floats, Floats]:
        """Return origins and directions of the rays of (i, j)."""
        origin, direction = self.camera.ray(i, j, self.size)
        if self.face is None:
            return origin, direction
        return origin, direction / self.face.stretch(i, j)[..., None]

    def stretch(self, i: Numbers, j: Numbers) -> Floats | float:
        """Return the ray parameter where this face's own parameter is 1."""
        return 1.0 if self.face is None else self.face.stretch(i, j)

    def sees(self, primitive: Ints, i: Numbers, j: Numbers, t: Floats) -> Bools:
        """Return for each (i, j) if its ray hits the primitive, within near and far, regardless of
        what is in front of it.

        t: where it is hit nearby, see parameter().
        """
        at = self.parameter(primitive, i, j, t)
        near, far = self.camera.t_range
        with quiet():
            found = (at > near) & (at < far)
        triangle, _ = self.kinds(primitive)
        inside = self.weights(primitive[triangle], i[triangle], j[triangle]).min(axis=1)
        found[triangle] &= inside >= 0
        return found

    def parameter(self, primitive: Ints, i: Numbers, j: Numbers, t: Floats) -> Floats:
        """Return the ray parameter where the ray of (i, j) hits the primitive's extended surface.

        A triangle's surface is its plane; of a sphere's two hits, the one nearer to t counts. NaN:
        no hit.
        """
        result = np.full(len(primitive), np.nan)
        triangle, sphere = self.kinds(primitive)
        origin, direction = self.ray(i, j)
        a, b, c = self.corners(primitive[triangle])
        normal = np.cross(b - a, c - a)
        with quiet():
            ahead = dot(normal, direction[triangle])
            result[triangle] = dot(normal, a - origin[triangle]) / ahead
            discriminant, middle, square = self.sphere_terms(
                primitive[sphere], origin[sphere], direction[sphere]
            )
            half = np.sqrt(discriminant) / square
        near, far = middle - half, middle + half
        with quiet():
            is_near = np.abs(near - t[sphere]) <= np.abs(far - t[sphere])
        result[sphere] = np.where(is_near, near, far)
        return result

    def drawn_from(self, primitive: Ints, drawn: bool = False) -> Floats:
        """Return the ray parameter from which a primitive is rasterized, (n,).

        It is 0 for a sphere, which is drawn as the far sides of a box. Clipping displaces the rest
        of a triangle by ROUNDING_32 of its size. That is more pixels the nearer it is to the eye:
        if it is more than MARGIN, the triangle may vanish.
        """
        limit = np.zeros(len(primitive))
        triangle, _ = self.kinds(primitive)
        if self.camera.is_parallel:
            return limit
        corners = self.object_boxes(primitive[triangle])
        farthest = self.camera.project(corners, self.size).parameter.max(axis=1)
        seen = seen_corners(self.camera, self.size, np.stack(self.corners(primitive[triangle]), 1))
        vast = ROUNDING_32 / MARGIN * np.abs(seen[..., :2]).max(axis=(1, 2))
        limit[triangle] = CLIPPED_FROM * np.maximum(farthest, 0.0)
        if not drawn:  # a drawn primitive was not lost by clipping
            limit[triangle] = np.maximum(limit[triangle], vast)
        return limit

    def slope(self, primitive: Ints, i: Numbers, j: Numbers, t: Floats) -> Floats:
        """Return the change of the ray parameter per pixel, on the primitive's surface."""
        return slope_of(lambda i, j: self.parameter(primitive, i, j, t), i, j)

    def normal_slope(self, primitive: Ints, i: Numbers, j: Numbers) -> tuple[Floats, Floats]:
        """Return the change of a triangle's smooth normal per pixel, 0 without one; and its
        uncertainty in float32.

        A sliver's normal and barycentrics are small differences of about thirty roundings in total.
        """
        slope, unknown = np.zeros(len(primitive)), np.zeros(len(primitive))
        triangle, _ = self.kinds(primitive)
        a, b, c = self.corners(primitive[triangle])
        normals = self.flat.normals[self.flat.faces[primitive[triangle]]].astype(float)

        def normal(i: Numbers, j: Numbers) -> Floats:
            mean = np.einsum("nk,nkx->nx", self.weights(primitive[triangle], i, j), normals)
            with quiet():
                return mean / np.linalg.norm(mean, axis=1, keepdims=True)

        slope[triangle] = length(slope_of(normal, i[triangle], j[triangle]))
        longest = np.max([((q - p) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
        with quiet():
            sliver = longest / length(np.cross(b - a, c - a))
        varies = np.where(normals.any(axis=(1, 2)), np.ptp(normals, axis=1).max(axis=1), 1.0)
        unknown[triangle] = 4 * ROUNDING_32 * sliver * varies
        return np.nan_to_num(slope), np.nan_to_num(unknown)

    def tint_slope(self, primitive: Ints, i: Numbers, j: Numbers) -> Floats:
        """Return the relative change per pixel of a triangle's interpolated vertex colour:
        (n, 3).
        """
        slope = np.zeros((len(primitive), 3))
        triangle, _ = self.kinds(primitive)
        colors = self.flat.colors[self.flat.faces[primitive[triangle]]].astype(float)

        def tint(i: Numbers, j: Numbers) -> Floats:
            return np.einsum("nk,nkx->nx", self.weights(primitive[triangle], i, j), colors)

        at = i[triangle], j[triangle]
        with quiet():
            slope[triangle] = slope_of(tint, *at) / tint(*at)
        return np.nan_to_num(slope)

    def weights(self, triangle: Ints, i: Numbers, j: Numbers) -> Floats:
        """Return the barycentrics (n, 3) of the points where rays hit the planes of triangles."""
        origin, direction = self.ray(i, j)
        from_eye = np.stack(self.corners(triangle), axis=1) - origin[:, None]
        # The volumes spanned by the ray and the edges.
        edges = np.cross(np.roll(from_eye, -1, axis=1), np.roll(from_eye, -2, axis=1))
        volumes = np.einsum("nkx,nx->nk", edges, direction)
        with quiet():
            weights: Floats = volumes / volumes.sum(axis=1, keepdims=True)
        return weights

    def object_boxes(self, triangle: Ints) -> Floats:
        """Return the corners (n, 8, 3) of the boxes around the triangles' objects."""
        owner = self.flat.face_object[triangle]
        bounds, matrix = self.flat.object_bounds[owner], self.flat.world_from_object[owner]
        which = np.array(list(np.ndindex(2, 2, 2)))
        corners = bounds[:, which, np.arange(3)] @ np.swapaxes(matrix[:, :3, :3], 1, 2)
        return corners + matrix[:, None, :3, 3]

    def largest_parameter(self) -> float:
        """Return the ray parameter of the scene's and the eye's largest coordinate."""
        unit = 1.0 if self.camera.is_parallel else self.camera.distance
        largest = max(np.abs(self.flat.bounds).max(), *np.abs(self.camera.eye))
        return float(np.linalg.norm(self.camera.camera_from_world[2, :3]) * largest / unit)

    def facing(self, primitive: Ints, point: Floats, direction: Floats) -> Floats:
        """Return the geometric normal on the viewer's side, not normalised: (n, 3)."""
        normal = np.zeros_like(point)
        triangle, sphere = self.kinds(primitive)
        a, b, c = self.corners(primitive[triangle])
        normal[triangle] = np.cross(b - a, c - a)
        center = self.flat.spheres[primitive[sphere] - len(self.flat.faces), :3]
        normal[sphere] = point[sphere] - center
        away = dot(normal, direction) > 0
        return np.where(away[:, None], -normal, normal)

    def kinds(self, primitive: Ints) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        triangles = len(self.flat.faces)
        return (primitive >= 0) & (primitive < triangles), primitive >= triangles

    def corners(self, triangle: Ints) -> tuple[Floats, Floats, Floats]:
        a, b, c = np.moveaxis(world_corners(self.flat, triangle), 1, 0)
        return a, b, c

    def sphere_terms(
        self, primitive: Ints, origin: Floats, direction: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Return the discriminant (negative: missed), the parameter nearest to the centre, and
        |direction|^2.
        """
        sphere = self.flat.spheres[primitive - len(self.flat.faces)]
        to_center = sphere[:, :3] - origin
        square = dot(direction, direction)
        middle = dot(to_center, direction) / square
        off = to_center - middle[:, None] * direction
        return square * (sphere[:, 3] ** 2 - dot(off, off)), middle, square
