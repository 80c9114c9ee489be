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

import numpy as np

from renderer.camera import Floats
from renderer.scene.flat import SPECULAR_CHECKERED
from renderer.scene.sampling import between, gloss, on_spheres, on_triangles, opacity, sampled
from renderer.seen_surfaces import (
    ROUNDING_32,
    Bools,
    Function,
    Ints,
    Numbers,
    SeenSurfaces,
    dot,
    length,
    quiet,
    slope_of,
)
from renderer.shared_numbers import CELL_NUDGE, CHECKERED
from renderer.slivers import seen_corners, unknown_edge_px

BEHIND = 1e-9  # outlines are clipped below this fraction of the largest ray parameter
ROUNDING = 1e-12  # relative to the largest coordinate: float64's error at the eye


class Discontinuities(SeenSurfaces):
    """The lines of one scene as seen by one camera in an image of (width, height)."""

    def outline_px(self, primitive: Ints, i: Numbers, j: Numbers) -> Floats:
        """Return the distance of each pixel's centre from the outline of its primitive, in pixels.

        It is 0 for a ray that passes an edge more closely than the edge's position is known in
        float32.
        """
        distance = np.full(len(primitive), np.inf)
        triangle, sphere = self.kinds(primitive)
        distance[triangle] = self._triangle_px(primitive[triangle], i[triangle], j[triangle])
        distance[sphere] = self._sphere_px(primitive[sphere], i[sphere], j[sphere])
        return distance

    def meeting_px(self, first: Ints, second: Ints, i: Numbers, j: Numbers, t: Floats) -> Floats:
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

    def clip_px(
        self, primitive: Ints, i: Numbers, j: Numbers, t: Floats, drawn: bool = False
    ) -> Floats:
        """Return the distance from the lines where near and far (or the eye's plane) cut the
        primitive.

        It is 0 for a surface that contains the eye, since rounding decides where it begins; and for
        a part of a triangle that is too near to the eye to be rasterized.
        """
        distance = np.full(len(primitive), np.inf)
        at_eye = np.full(len(primitive), ROUNDING * self.largest_parameter())
        if self.camera.is_parallel:  # its depths are known to the rounding of a triangle's extent
            triangle, _ = self.kinds(primitive)
            corners = np.stack(self.corners(primitive[triangle]), 1)
            depths = np.abs(self.camera.project(corners, self.size).parameter)
            at_eye[triangle] += ROUNDING_32 * depths.max(axis=1, initial=0)
        here = self.parameter(primitive, i, j, t)
        for limit in self.camera.t_range:
            if np.isfinite(limit):
                cut = _zero_px(lambda i, j: self.parameter(primitive, i, j, t) - limit, i, j)  # noqa: B023
                cut[np.abs(here - limit) <= np.maximum(1e-6 * limit, at_eye)] = 0
                distance = np.fmin(distance, cut)
        distance[t <= self.drawn_from(primitive, drawn) * self.stretch(i, j)] = 0
        return np.where(primitive >= 0, distance, np.inf)

    def checker_px(self, primitive: Ints, i: Numbers, j: Numbers, t: Floats) -> Floats:
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
            origin, direction = self.ray(i, j)
            with quiet():  # misses
                point = origin + at[:, None] * direction
                facing = self.facing(primitive, point, direction)
                inward = np.einsum("nrk,nk->nr", rows[:, :, :3], facing)
                inward *= CELL_NUDGE / np.linalg.norm(inward, axis=1, keepdims=True)
            here = dot(rows[:, axis, :3], point) + rows[:, axis, 3]
            return here - inward[:, axis]

        origin, direction = self.ray(i, j)
        with quiet():  # misses
            away = length(origin + t[:, None] * direction - self.camera.eye)
        for axis in range(3):
            here = cell(axis, i, j)
            border = np.round(here)
            to_border = _zero_px(lambda i, j: cell(axis, i, j) - border, i, j)  # noqa: B023
            unknown = ROUNDING_32 * away * length(rows[:, axis, :3])
            to_border[np.abs(here - border) <= unknown] = 0
            distance = np.fmin(distance, to_border)
        return np.where(checkered, distance, np.inf)

    def texture_varies(
        self, primitive: Ints, i: Numbers, j: Numbers, t: Floats, px: float
    ) -> Floats:
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

    def is_at_hole(self, primitive: Ints, i: Numbers, j: Numbers, t: Floats, px: float) -> Bools:
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
        self, primitive: Ints, i: Numbers, j: Numbers, t: Floats, px: float
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
        triangle, sphere = self.kinds(primitive)
        places, reach = np.zeros((len(primitive), 2)), np.zeros(len(primitive))
        places[triangle] = on_triangles(
            self.flat,
            primitive[triangle],
            self.weights(primitive[triangle], i[triangle], j[triangle]),
        )
        corners = self.flat.uv[self.flat.faces[primitive[triangle]]]
        reach[triangle] = np.abs(corners).max(axis=(1, 2), initial=0)
        origin, direction = self.ray(i, j)
        at = self.parameter(primitive, i, j, t)
        with quiet():
            point = (origin + at[:, None] * direction)[sphere]
        outward = point - self.flat.spheres[primitive[sphere] - len(self.flat.faces), :3]
        places[sphere] = on_spheres(self.flat, owner[sphere], outward)
        reach[sphere] = np.abs(places[sphere]).max(axis=1, initial=0)
        return places, 2 * ROUNDING_32 * reach[:, None]

    def _sphere_px(self, primitive: Ints, i: Numbers, j: Numbers) -> Floats:
        """Return the distance from the curve where the discriminant is 0."""

        def discriminant(i: Numbers, j: Numbers) -> Floats:
            origin, direction = self.ray(i, j)
            return self.sphere_terms(primitive, origin, direction)[0]

        return _zero_px(discriminant, i, j)

    def _triangle_px(self, triangle: Ints, i: Numbers, j: Numbers) -> Floats:
        """Return the distance from the nearest of the three projected edges, clipped in front of
        the eye.
        """
        matrix = self.camera.camera_from_world
        corners = []
        for corner in self.corners(triangle):
            x, y, z = (corner @ matrix[:3, :3].T + matrix[:3, 3]).T
            # Homogeneous image point (x, y, h): in perspective h is the ray parameter.
            h = np.ones_like(z) if self.camera.is_parallel else -z / self.camera.distance
            corners.append(np.stack([x, y, h], axis=1))
        pixel = np.stack([np.asarray(j, float), np.asarray(i, float)], axis=1)
        distance = np.full(len(triangle), np.inf)
        seen = seen_corners(self.camera, self.size, np.stack(self.corners(triangle), axis=1))
        for first, second in ((0, 1), (1, 2), (2, 0)):
            p, q = self._clipped(corners[first], corners[second])
            away = _segment_px(pixel, self._pixel(p), self._pixel(q))
            ends = seen[:, first], seen[:, second]
            away[away <= unknown_edge_px(self.size, *ends, self.camera.is_parallel, i, j)] = 0
            distance = np.fmin(distance, away)
        distance[self._touches(triangle, i, j)] = 0
        return distance

    def _touches(self, triangle: Ints, i: Numbers, j: Numbers) -> Bools:
        """Return True if a ray passes an edge so closely that float32 cannot distinguish the sides.

        An edge is known to ROUNDING_32 of the larger of two lengths: its farther end's distance
        from the eye, and the object's size. That is visible if the eye is very near the edge of
        something large, or the view is very narrow.
        """
        origin, direction = self.ray(i, j)
        along = direction / np.linalg.norm(direction, axis=1, keepdims=True)
        size = np.linalg.norm(np.ptp(self.object_boxes(triangle), axis=1), axis=1)
        corners = self.corners(triangle)
        far = [length(corner - self.camera.eye) for corner in corners]
        touches = np.zeros(len(triangle), bool)
        for first, second in ((0, 1), (1, 2), (2, 0)):
            # Perpendicular to the ray, the edge is a segment in a plane: find its nearest point.
            p, q = corners[first] - origin, corners[second] - origin
            start, end = (v - dot(v, along)[:, None] * along for v in (p, q))
            edge = end - start
            with quiet():
                part = -dot(start, edge) / dot(edge, edge)
            part = np.clip(np.nan_to_num(part), 0, 1)
            away = length(start + part[:, None] * edge)
            ahead = dot(p + part[:, None] * (q - p), along)
            unknown = ROUNDING_32 * np.minimum(np.maximum(far[first], far[second]), size)
            touches |= (away <= unknown) & (ahead >= -unknown)
        return touches

    def _clipped(self, p: Floats, q: Floats) -> tuple[Floats, Floats]:
        """Return the part of the edge in front of the eye; NaN if there is none."""
        least = BEHIND * np.maximum(np.abs(p[:, 2]), np.abs(q[:, 2]))
        with quiet():
            part = ((least - p[:, 2]) / (q[:, 2] - p[:, 2]))[:, None]
            crossing = p + part * (q - p)
        behind_p, behind_q = (p[:, 2] < least)[:, None], (q[:, 2] < least)[:, None]
        gone = behind_p & behind_q
        start, end = np.where(behind_p, crossing, p), np.where(behind_q, crossing, q)
        return np.where(gone, np.nan, start), np.where(gone, np.nan, end)

    def _pixel(self, homogeneous: Floats) -> Floats:
        """Return (column, row), with centres at integers."""
        left, right, bottom, top = self.camera.viewport
        with quiet():
            x, y = (homogeneous[:, :2] / homogeneous[:, 2:]).T
        column = (x - left) / (right - left) * self.size[0] - 0.5
        row = (top - y) / (top - bottom) * self.size[1] - 0.5
        return np.stack([column, row], axis=1)


def _segment_px(point: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distance of points from segments in the plane; inf if a segment is NaN."""
    with quiet():  # an edge through the eye's plane
        along = end - start
        part = dot(point - start, along) / dot(along, along)
        part = np.clip(np.nan_to_num(part), 0, 1)[:, None]
        distance = length(point - (start + part * along))
    return np.where(np.isnan(distance), np.inf, distance)


def _zero_px(function: Function, i: Numbers, j: Numbers) -> Floats:
    """Return the distance to the function's zero, to first order, in pixels; inf if it is
    undefined.
    """
    with quiet():
        distance = np.abs(function(i, j)) / slope_of(function, i, j)
    return np.where(np.isnan(distance), np.inf, distance)
