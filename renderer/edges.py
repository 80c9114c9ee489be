"""Distances in pixels from pixels' centres to the lines where the image may be discontinuous.

This is the exact (float64) geometry behind `lucida compare`: outlines of primitives, lines where
two surfaces meet, clip lines, borders of checker cells and of holes.

A rasterizer snaps vertices to a fraction of a pixel, so that a centre on such a line, or closer to
it than the snapping, may be on either side. Both renderers compute in float32: the same holds for
points nearer to such a line than ROUNDING_32 of the numbers that it is computed from, which is far
less than a pixel except in very narrow views and close to the eye. Everywhere else both renderers
must agree.

All functions take arrays of pixels: i, j (n,) rows and columns, primitive (n,) numbers of the flat
scene (-1: none, which is infinitely far from everything).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from renderer.camera import NEAREST, Camera, Floats
from renderer.scene.flat import SPECULAR_CHECKERED, FlatScene
from renderer.scene.positions import world_corners
from renderer.scene.sampling import between, gloss, on_spheres, on_triangles, opacity, sampled
from renderer.shared_numbers import CELL_NUDGE, CHECKERED
from renderer.slivers import seen_corners, unknown_edge_px

Ints = NDArray[np.integer]
Bools = NDArray[np.bool_]
Numbers = NDArray[np.integer] | NDArray[np.floating]
Function = Callable[[Numbers, Numbers], Floats]  # of a position (rows, columns) in the image

STEP_PX = 1 / 256  # of the central differences: well inside the tolerance, far above rounding
BEHIND = 1e-9  # outlines are clipped below this fraction of the largest ray parameter
ROUNDING = 1e-12  # relative to the largest coordinate: float64's error at the eye
# A position's error in float32 after a few roundings, relative to its distance.
ROUNDING_32 = 2.0**-21
# The least margin in pixels around the image that GL clips to (as in raster/scene_data.py).
MARGIN = 1024
# Includes the error of GL's clipping where it cuts a triangle at NEAREST of its farthest corner.
CLIPPED_FROM = NEAREST + ROUNDING_32


# Degenerate primitives and misses: their NaN and infinities are replaced at the end.
_quiet = partial(np.errstate, divide="ignore", invalid="ignore", over="ignore")


def _dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("nk,nk->n", a, b)


def _length(a: Floats) -> Floats:
    return np.linalg.norm(a, axis=1)


@dataclass(frozen=True)
class Discontinuities:
    """The lines of one scene as seen by one camera in an image of (width, height)."""

    flat: FlatScene
    camera: Camera
    size: tuple[int, int]

    def outline_px(self, primitive: Ints, i: Ints, j: Ints) -> Floats:
        """Return the distance of each pixel's centre from the outline of its primitive, in pixels.

        It is 0 for a ray that passes an edge more closely than the edge's position is known in
        float32.
        """
        distance = np.full(len(primitive), np.inf)
        triangle, sphere = self._kinds(primitive)
        distance[triangle] = self._triangle_px(primitive[triangle], i[triangle], j[triangle])
        distance[sphere] = self._sphere_px(primitive[sphere], i[sphere], j[sphere])
        return distance

    def meeting_px(self, first: Ints, second: Ints, i: Ints, j: Ints, t: Floats) -> Floats:
        """Return the distance from the line where the surfaces of two primitives meet; t: the hits'
        depth.

        The surfaces are extended beyond their outlines. Coincident surfaces meet everywhere.
        """
        pair = (first >= 0) & (second >= 0) & (first != second)

        def gap(i: Numbers, j: Numbers) -> Floats:
            return self.parameter(first, i, j, t) - self.parameter(second, i, j, t)

        distance = _zero_px(gap, i, j)
        distance[np.abs(gap(i, j)) <= 4e-6 * np.abs(t)] = 0  # the depth buffer's last place
        return np.where(pair, distance, np.inf)

    def clip_px(self, primitive: Ints, i: Ints, j: Ints, t: Floats, drawn: bool = False) -> Floats:
        """Return the distance from the lines where near and far (or the eye's plane) cut the
        primitive.

        It is 0 for a surface that contains the eye, since rounding decides where it begins; and for
        a part of a triangle that is too near to the eye to be rasterized.
        """
        distance = np.full(len(primitive), np.inf)
        at_eye = np.full(len(primitive), ROUNDING * self._largest_parameter())
        if self.camera.is_parallel:  # its depths are known to the rounding of a triangle's extent
            triangle, _ = self._kinds(primitive)
            corners = np.stack(self._corners(primitive[triangle]), 1)
            depths = np.abs(self.camera.project(corners, self.size).parameter)
            at_eye[triangle] += ROUNDING_32 * depths.max(axis=1, initial=0)
        here = self.parameter(primitive, i, j, t)
        for limit in self.camera.t_range:
            if np.isfinite(limit):
                cut = _zero_px(lambda i, j: self.parameter(primitive, i, j, t) - limit, i, j)  # noqa: B023
                cut[np.abs(here - limit) <= np.maximum(1e-6 * limit, at_eye)] = 0
                distance = np.fmin(distance, cut)
        distance[t <= self.drawn_from(primitive, drawn)] = 0
        return np.where(primitive >= 0, distance, np.inf)

    def checker_px(self, primitive: Ints, i: Ints, j: Ints, t: Floats) -> Floats:
        """Return the distance from the nearest border of a checker cell; inf if there is no
        checker.

        It is 0 if the hit is nearer to a border than its position is known in float32. That is less
        than a hundredth of a pixel, except in very narrow views.
        """
        distance = np.full(len(primitive), np.inf)
        hit = primitive >= 0
        if not hit.any():
            return distance
        owners = np.concatenate([self.flat.face_object, self.flat.sphere_object])
        owner = owners[primitive]  # any object's if nothing is hit
        checkered = hit & (self.flat.materials[owner, SPECULAR_CHECKERED, 3] == CHECKERED)
        rows = self.flat.cells[owner]

        def cell(axis: int, i: Numbers, j: Numbers) -> Floats:
            at = self.parameter(primitive, i, j, t)
            origin, direction = self.camera.ray(i, j, self.size)
            with _quiet():  # misses
                point = origin + at[:, None] * direction
                facing = self._facing(primitive, point, direction)
                inward = np.einsum("nrk,nk->nr", rows[:, :, :3], facing)
                inward *= CELL_NUDGE / np.linalg.norm(inward, axis=1, keepdims=True)
            here = _dot(rows[:, axis, :3], point) + rows[:, axis, 3]
            return here - inward[:, axis]

        origin, direction = self.camera.ray(i, j, self.size)
        with _quiet():  # misses
            away = _length(origin + t[:, None] * direction - self.camera.eye)
        for axis in range(3):
            here = cell(axis, i, j)
            border = np.round(here)
            to_border = _zero_px(lambda i, j: cell(axis, i, j) - border, i, j)  # noqa: B023
            unknown = ROUNDING_32 * away * _length(rows[:, axis, :3])
            to_border[np.abs(here - border) <= unknown] = 0
            distance = np.fmin(distance, to_border)
        return np.where(checkered, distance, np.inf)

    def texture_varies(self, primitive: Ints, i: Ints, j: Ints, t: Floats, px: float) -> Floats:
        """Return the relative variation, 0 to 1, of each colour of a texture's light around the
        pixel: (n, 3).

        It covers `px` around the pixel, or the uncertainty in float32 of the hit's position on the
        image. 0 without a texture. The light of a metal also counts.
        """
        varies = np.zeros((len(primitive), 3))
        textured, owner, places = self._places_around(primitive, i, j, t, px)
        for sample in (sampled, gloss) if textured.any() else ():
            low, high = between(sample, self.flat, owner, places)
            varies[textured] = np.maximum(varies[textured], 1 - low / np.where(high > 0, high, 1))
        return varies

    def is_at_hole(self, primitive: Ints, i: Ints, j: Ints, t: Floats, px: float) -> Bools:
        """Return for each pixel if both a hole and no hole are near it: (n,).

        Near is within `px`, or within the uncertainty in float32 of the hit's position on the
        image.
        """
        found = np.zeros(len(primitive), bool)
        textured, owner, places = self._places_around(primitive, i, j, t, px)
        if textured.any():
            low, high = between(opacity, self.flat, owner, places)
            found[textured] = ((low <= 0) & (high >= 0))[:, 0]
        return found

    def _places_around(
        self, primitive: Ints, i: Ints, j: Ints, t: Floats, px: float
    ) -> tuple[Bools, Ints, Floats]:
        """Return which pixels see something textured, its objects, and texel coordinates (k, n, 2)
        around the pixels.
        """
        owners = np.concatenate([self.flat.face_object, self.flat.sphere_object])
        textured = primitive >= 0
        if not len(self.flat.texels) or not textured.any():
            return np.zeros(len(primitive), bool), owners[:0], np.zeros((0, 0, 2))
        owner = owners[primitive]  # any object's if nothing is hit
        textured = textured & (self.flat.textures[owner, 0, 1] > 0)
        primitive, owner = primitive[textured], owner[textured]
        i, j, t = i[textured], j[textured], t[textured]
        here, unknown = self._texture_place(primitive, owner, i, j, t)
        around = [
            self._texture_place(primitive, owner, i + px * down, j + px * right, t)[0]
            for down in (-1, 0, 1)
            for right in (-1, 0, 1)
        ]
        around += [here + unknown * side for side in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        return textured, owner, np.where(np.isfinite(around), around, 0.0)

    def _texture_place(
        self, primitive: Ints, owner: Ints, i: Numbers, j: Numbers, t: Floats
    ) -> tuple[Floats, Floats]:
        """Return texel coordinates (n, 2), and their uncertainty in float32 (n, 1)."""
        triangle, sphere = self._kinds(primitive)
        places, reach = np.zeros((len(primitive), 2)), np.zeros(len(primitive))
        places[triangle] = on_triangles(
            self.flat,
            primitive[triangle],
            self._weights(primitive[triangle], i[triangle], j[triangle]),
        )
        corners = self.flat.uv[self.flat.faces[primitive[triangle]]]
        reach[triangle] = np.abs(corners).max(axis=(1, 2), initial=0)
        origin, direction = self.camera.ray(i, j, self.size)
        at = self.parameter(primitive, i, j, t)
        with _quiet():
            point = (origin + at[:, None] * direction)[sphere]
        outward = point - self.flat.spheres[primitive[sphere] - len(self.flat.faces), :3]
        places[sphere] = on_spheres(self.flat, owner[sphere], outward)
        reach[sphere] = np.abs(places[sphere]).max(axis=1, initial=0)
        return places, 2 * ROUNDING_32 * reach[:, None]

    def slope(self, primitive: Ints, i: Ints, j: Ints, t: Floats) -> Floats:
        """Return the change of the ray parameter per pixel, on the primitive's surface."""
        return _slope(lambda i, j: self.parameter(primitive, i, j, t), i, j)

    def normal_slope(self, primitive: Ints, i: Ints, j: Ints) -> tuple[Floats, Floats]:
        """Return the change of a triangle's smooth normal per pixel, 0 without one; and its
        uncertainty in float32.

        A sliver's normal and barycentrics are small differences of about thirty roundings in total.
        """
        slope, unknown = np.zeros(len(primitive)), np.zeros(len(primitive))
        triangle, _ = self._kinds(primitive)
        a, b, c = self._corners(primitive[triangle])
        normals = self.flat.normals[self.flat.faces[primitive[triangle]]].astype(float)

        def normal(i: Numbers, j: Numbers) -> Floats:
            mean = np.einsum("nk,nkx->nx", self._weights(primitive[triangle], i, j), normals)
            with _quiet():
                return mean / np.linalg.norm(mean, axis=1, keepdims=True)

        slope[triangle] = _length(_slope(normal, i[triangle], j[triangle]))
        longest = np.max([((q - p) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
        with _quiet():
            sliver = longest / _length(np.cross(b - a, c - a))
        varies = np.where(normals.any(axis=(1, 2)), np.ptp(normals, axis=1).max(axis=1), 1.0)
        unknown[triangle] = 4 * ROUNDING_32 * sliver * varies
        return np.nan_to_num(slope), np.nan_to_num(unknown)

    def tint_slope(self, primitive: Ints, i: Ints, j: Ints) -> Floats:
        """Return the relative change per pixel of a triangle's interpolated vertex colour:
        (n, 3).
        """
        slope = np.zeros((len(primitive), 3))
        triangle, _ = self._kinds(primitive)
        colors = self.flat.colors[self.flat.faces[primitive[triangle]]].astype(float)

        def tint(i: Numbers, j: Numbers) -> Floats:
            return np.einsum("nk,nkx->nx", self._weights(primitive[triangle], i, j), colors)

        at = i[triangle], j[triangle]
        with _quiet():
            slope[triangle] = _slope(tint, *at) / tint(*at)
        return np.nan_to_num(slope)

    def _weights(self, triangle: Ints, i: Numbers, j: Numbers) -> Floats:
        """Return the barycentrics (n, 3) of the points where rays hit the planes of triangles."""
        origin, direction = self.camera.ray(i, j, self.size)
        from_eye = np.stack(self._corners(triangle), axis=1) - origin[:, None]
        # The volumes spanned by the ray and the edges.
        edges = np.cross(np.roll(from_eye, -1, axis=1), np.roll(from_eye, -2, axis=1))
        volumes = np.einsum("nkx,nx->nk", edges, direction)
        with _quiet():
            weights: Floats = volumes / volumes.sum(axis=1, keepdims=True)
        return weights

    def parameter(self, primitive: Ints, i: Numbers, j: Numbers, t: Floats) -> Floats:
        """Return the ray parameter where the ray of (i, j) hits the primitive's extended surface.

        A triangle's surface is its plane; of a sphere's two hits, the one nearer to t counts. NaN:
        no hit.
        """
        result = np.full(len(primitive), np.nan)
        triangle, sphere = self._kinds(primitive)
        origin, direction = self.camera.ray(i, j, self.size)
        a, b, c = self._corners(primitive[triangle])
        normal = np.cross(b - a, c - a)
        with _quiet():
            ahead = _dot(normal, direction[triangle])
            result[triangle] = _dot(normal, a - origin[triangle]) / ahead
            discriminant, middle, square = self._sphere_terms(
                primitive[sphere], origin[sphere], direction[sphere]
            )
            half = np.sqrt(discriminant) / square
        near, far = middle - half, middle + half
        with _quiet():
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
        triangle, _ = self._kinds(primitive)
        if self.camera.is_parallel:
            return limit
        corners = self._object_boxes(primitive[triangle])
        farthest = self.camera.project(corners, self.size).parameter.max(axis=1)
        seen = seen_corners(self.camera, self.size, np.stack(self._corners(primitive[triangle]), 1))
        vast = ROUNDING_32 / MARGIN * np.abs(seen[..., :2]).max(axis=(1, 2))
        limit[triangle] = CLIPPED_FROM * np.maximum(farthest, 0.0)
        if not drawn:  # a drawn primitive was not lost by clipping
            limit[triangle] = np.maximum(limit[triangle], vast)
        return limit

    def _object_boxes(self, triangle: Ints) -> Floats:
        """Return the corners (n, 8, 3) of the boxes around the triangles' objects."""
        owner = self.flat.face_object[triangle]
        bounds, matrix = self.flat.object_bounds[owner], self.flat.world_from_object[owner]
        which = np.array(list(np.ndindex(2, 2, 2)))
        corners = bounds[:, which, np.arange(3)] @ np.swapaxes(matrix[:, :3, :3], 1, 2)
        return corners + matrix[:, None, :3, 3]

    def _largest_parameter(self) -> float:
        """Return the ray parameter of the scene's and the eye's largest coordinate."""
        unit = 1.0 if self.camera.is_parallel else self.camera.distance
        largest = max(np.abs(self.flat.bounds).max(), *np.abs(self.camera.eye))
        return float(np.linalg.norm(self.camera.camera_from_world[2, :3]) * largest / unit)

    def _facing(self, primitive: Ints, point: Floats, direction: Floats) -> Floats:
        """Return the geometric normal on the viewer's side, not normalised: (n, 3)."""
        normal = np.zeros_like(point)
        triangle, sphere = self._kinds(primitive)
        a, b, c = self._corners(primitive[triangle])
        normal[triangle] = np.cross(b - a, c - a)
        center = self.flat.spheres[primitive[sphere] - len(self.flat.faces), :3]
        normal[sphere] = point[sphere] - center
        away = _dot(normal, direction) > 0
        return np.where(away[:, None], -normal, normal)

    def _kinds(self, primitive: Ints) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        triangles = len(self.flat.faces)
        return (primitive >= 0) & (primitive < triangles), primitive >= triangles

    def _corners(self, triangle: Ints) -> tuple[Floats, Floats, Floats]:
        a, b, c = np.moveaxis(world_corners(self.flat, triangle), 1, 0)
        return a, b, c

    def _sphere_terms(
        self, primitive: Ints, origin: Floats, direction: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Return the discriminant (negative: missed), the parameter nearest to the centre, and
        |direction|^2.
        """
        sphere = self.flat.spheres[primitive - len(self.flat.faces)]
        to_center = sphere[:, :3] - origin
        square = _dot(direction, direction)
        middle = _dot(to_center, direction) / square
        off = to_center - middle[:, None] * direction
        return square * (sphere[:, 3] ** 2 - _dot(off, off)), middle, square

    def _sphere_px(self, primitive: Ints, i: Ints, j: Ints) -> Floats:
        """Return the distance from the curve where the discriminant is 0."""

        def discriminant(i: Numbers, j: Numbers) -> Floats:
            origin, direction = self.camera.ray(i, j, self.size)
            return self._sphere_terms(primitive, origin, direction)[0]

        return _zero_px(discriminant, i, j)

    def _triangle_px(self, triangle: Ints, i: Ints, j: Ints) -> Floats:
        """Return the distance from the nearest of the three projected edges, clipped in front of
        the eye.
        """
        matrix = self.camera.camera_from_world
        corners = []
        for corner in self._corners(triangle):
            x, y, z = (corner @ matrix[:3, :3].T + matrix[:3, 3]).T
            # Homogeneous image point (x, y, h): in perspective h is the ray parameter.
            h = np.ones_like(z) if self.camera.is_parallel else -z / self.camera.distance
            corners.append(np.stack([x, y, h], axis=1))
        pixel = np.stack([np.asarray(j, float), np.asarray(i, float)], axis=1)
        distance = np.full(len(triangle), np.inf)
        seen = seen_corners(self.camera, self.size, np.stack(self._corners(triangle), axis=1))
        for first, second in ((0, 1), (1, 2), (2, 0)):
            p, q = self._clipped(corners[first], corners[second])
            away = _segment_px(pixel, self._pixel(p), self._pixel(q))
            ends = seen[:, first], seen[:, second]
            away[away <= unknown_edge_px(self.size, *ends, self.camera.is_parallel, i, j)] = 0
            distance = np.fmin(distance, away)
        distance[self._touches(triangle, i, j)] = 0
        return distance

    def _touches(self, triangle: Ints, i: Ints, j: Ints) -> NDArray[np.bool_]:
        """Return True if a ray passes an edge so closely that float32 cannot distinguish the sides.

        An edge is known to ROUNDING_32 of the larger of two lengths: its farther end's distance
        from the eye, and the object's size. That is visible if the eye is very near the edge of
        something large, or the view is very narrow.
        """
        origin, direction = self.camera.ray(i, j, self.size)
        along = direction / np.linalg.norm(direction, axis=1, keepdims=True)
        size = np.linalg.norm(np.ptp(self._object_boxes(triangle), axis=1), axis=1)
        corners = self._corners(triangle)
        far = [_length(corner - self.camera.eye) for corner in corners]
        touches = np.zeros(len(triangle), bool)
        for first, second in ((0, 1), (1, 2), (2, 0)):
            # Perpendicular to the ray, the edge is a segment in a plane: find its nearest point.
            p, q = corners[first] - origin, corners[second] - origin
            start, end = (v - _dot(v, along)[:, None] * along for v in (p, q))
            edge = end - start
            with _quiet():
                part = -_dot(start, edge) / _dot(edge, edge)
            part = np.clip(np.nan_to_num(part), 0, 1)
            away = _length(start + part[:, None] * edge)
            ahead = _dot(p + part[:, None] * (q - p), along)
            unknown = ROUNDING_32 * np.minimum(np.maximum(far[first], far[second]), size)
            touches |= (away <= unknown) & (ahead >= -unknown)
        return touches

    def _clipped(self, p: Floats, q: Floats) -> tuple[Floats, Floats]:
        """Return the part of the edge in front of the eye; NaN if there is none."""
        least = BEHIND * np.maximum(np.abs(p[:, 2]), np.abs(q[:, 2]))
        with _quiet():
            part = ((least - p[:, 2]) / (q[:, 2] - p[:, 2]))[:, None]
            crossing = p + part * (q - p)
        behind_p, behind_q = (p[:, 2] < least)[:, None], (q[:, 2] < least)[:, None]
        gone = behind_p & behind_q
        start, end = np.where(behind_p, crossing, p), np.where(behind_q, crossing, q)
        return np.where(gone, np.nan, start), np.where(gone, np.nan, end)

    def _pixel(self, homogeneous: Floats) -> Floats:
        """Return (column, row), with centres at integers."""
        left, right, bottom, top = self.camera.viewport
        with _quiet():
            x, y = (homogeneous[:, :2] / homogeneous[:, 2:]).T
        column = (x - left) / (right - left) * self.size[0] - 0.5
        row = (top - y) / (top - bottom) * self.size[1] - 0.5
        return np.stack([column, row], axis=1)


def _segment_px(point: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distance of points from segments in the plane; inf if a segment is NaN."""
    with _quiet():  # an edge through the eye's plane
        along = end - start
        part = _dot(point - start, along) / _dot(along, along)
        part = np.clip(np.nan_to_num(part), 0, 1)[:, None]
        distance = _length(point - (start + part * along))
    return np.where(np.isnan(distance), np.inf, distance)


def _slope(function: Function, i: Ints, j: Ints) -> Floats:
    """Return the change per pixel of a function of the position, in the direction of its largest
    change.

    The function returns numbers (n,) or (n, 3).
    """
    with _quiet():
        across = function(i, j + STEP_PX) - function(i, j - STEP_PX)
        down = function(i + STEP_PX, j) - function(i - STEP_PX, j)
        return np.hypot(across, down) / (2 * STEP_PX)


def _zero_px(function: Function, i: Ints, j: Ints) -> Floats:
    """Return the distance to the function's zero, to first order, in pixels; inf if it is
    undefined.
    """
    with _quiet():
        distance = np.abs(function(i, j)) / _slope(function, i, j)
    return np.where(np.isnan(distance), np.inf, distance)
