"""The surfaces at the pixels of an image, in float64, and the pixels near lines of the image.

Each primitive's surface is extended beyond its outline, so that its values at a pixel can be
differentiated. why_different.py selects the lines that explain a difference.

All functions take arrays of pixels: i, j (n,) rows and columns, which may be fractional.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import NEAREST, Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.lens_faces import Face
from lucida.renderer.images.shared_numbers import CELL_NUDGE, CHECKERED
from lucida.renderer.scene.boxes import corners_of
from lucida.renderer.scene.flat import SPECULAR_CHECKERED, FlatScene
from lucida.renderer.scene.positions import world_corners
from lucida.renderer.scene.sampling import (
    between,
    gloss,
    on_spheres,
    on_triangles,
    opacity,
    sampled,
)

Ints = NDArray[np.integer]
Bools = NDArray[np.bool_]
Numbers = NDArray[np.integer] | NDArray[np.floating]
Function = Callable[[Numbers, Numbers], Floats]  # of rows and columns in the image

TOLERANCE_PX = 1 / 128
STEP_PX = 1 / 256  # of central differences
ROUNDING_32 = 2.0**-21  # float32's error after a few roundings, relative
ROUNDING_64 = 1e-12  # float64's error at the eye, relative to the largest coordinate
MARGIN = 1024  # pixels around the image that OpenGL clips to (raster/scene_data.py)

# NaN and infinities of degenerate primitives and misses are replaced at the end.
quiet = partial(np.errstate, divide="ignore", invalid="ignore", over="ignore")


@dataclass(frozen=True)
class View:
    """One scene as seen by a pinhole camera in an image of (width, height).

    face: a face of a lens's image, with this camera and size; ray parameters are then those of the
    lens's rays.
    """

    flat: FlatScene
    camera: Camera
    size: tuple[int, int]
    face: Face | None = None

    def ray(self, i: Numbers, j: Numbers) -> tuple[Floats, Floats]:
        """Return origins and directions of the rays of (i, j)."""
        origin, direction = self.camera.ray(i, j, self.size)
        return origin, direction / np.asarray(self.stretch(i, j))[..., None]

    def stretch(self, i: Numbers, j: Numbers) -> Floats | float:
        """Return the ray parameter where this face's own parameter is 1."""
        return 1.0 if self.face is None else self.face.stretch(i, j)

    @property
    def largest_parameter(self) -> float:
        """The ray parameter of the scene's and the eye's largest coordinate."""
        unit = 1.0 if self.camera.is_parallel else self.camera.distance
        largest = max(np.abs(self.flat.bounds).max(), *np.abs(self.camera.eye))
        return float(np.linalg.norm(self.camera.camera_from_world[2, :3]) * largest / unit)

    def image_points(self, world: Floats) -> Floats:
        """Return the image points (..., 3) of world points, see Camera.image_from_world(). Points
        behind the eye also have a position.
        """
        eye = np.asarray(self.camera.eye)
        matrix = replace(self.camera, eye=(0.0, 0.0, 0.0)).image_from_world(self.size)
        points: Floats = (world - eye) @ matrix[:, :3].T + matrix[:, 3]
        return points


class Surfaces:
    """A primitive for each of n pixels (-1: none), extended beyond its outline.

    t: (n,), the ray parameters of the hits; they select one of a sphere's two hits.
    """

    def __init__(self, view: View, primitive: Ints, t: Floats) -> None:
        flat, triangles = view.flat, len(view.flat.faces)
        self._view, self.primitive, self.t = view, primitive, t
        self._triangle = (primitive >= 0) & (primitive < triangles)
        self._sphere = primitive >= triangles
        self._faces = primitive[self._triangle]
        self._corners = world_corners(flat, self._faces).astype(float)
        self._spheres = flat.spheres[primitive[self._sphere] - triangles]
        owners = np.concatenate([flat.face_object, flat.sphere_object])
        # Pixels without a hit get any object.
        self._owner = owners[primitive] if len(owners) else np.zeros(len(primitive), int)
        seen = self._points = view.image_points(self._corners)
        if view.camera.is_parallel:
            seen = np.concatenate([seen[..., :2], np.ones_like(seen[..., :1])], axis=2)
        # Edge k, opposite to corner k, is the line x . edge = 0 of the pixels x = (x, y, 1).
        p, q = np.roll(seen, -1, axis=1), np.roll(seen, -2, axis=1)
        self._edges = np.cross(p + q, q - p)
        volume = np.einsum("nx,nx->n", np.cross(seen[:, 0], seen[:, 1]), seen[:, 2])
        self._side = np.where(volume < 0, -1.0, 1.0)[:, None]

    def _edge_values(self, i: Numbers, j: Numbers) -> Floats:
        """Return the three edge functions at pixels of the triangles, (m, 3)."""
        (width, height), i, j = self._view.size, i[self._triangle], j[self._triangle]
        pixel = np.stack([j - (width - 1) / 2, i - (height - 1) / 2, np.ones(len(i))], axis=1)
        return np.einsum("nkx,nx->nk", self._edges, pixel)

    def weights(self, i: Numbers, j: Numbers) -> Floats:
        """Return the barycentrics (m, 3) where rays hit the planes of the triangles."""
        values = self._edge_values(i, j)
        with quiet():
            weights: Floats = values / values.sum(axis=1, keepdims=True)
        return weights

    def parameter(self, i: Numbers, j: Numbers) -> Floats:
        """Return the ray parameters (n,) of the hits with the extended surfaces; NaN: no hit."""
        result = np.full(len(self.t), np.nan)
        with quiet():
            result[self._triangle] = self._depth(i, j)
            result *= self._view.stretch(i, j)
            off, middle, square = self._from_center(i, j)
            half = np.sqrt((self._spheres[:, 3] ** 2 - off**2) / square)
            near, far, t = middle - half, middle + half, self.t[self._sphere]
            result[self._sphere] = np.where(np.abs(near - t) <= np.abs(far - t), near, far)
        return result

    def _depth(self, i: Numbers, j: Numbers) -> Floats:
        """Return the parameters (m,) of the hits with triangles, without a lens's stretch."""
        depth: Floats = (self.weights(i, j) * self._points[..., 2]).sum(axis=1)
        return depth

    def _from_center(self, i: Numbers, j: Numbers) -> tuple[Floats, Floats, Floats]:
        """Return the distances of rays from the spheres' centres, the parameters there, and
        |direction|^2.
        """
        origin, direction = self._view.ray(i[self._sphere], j[self._sphere])
        to_center, square = self._spheres[:, :3] - origin, _dot(direction, direction)
        middle = _dot(to_center, direction) / square
        return norm(to_center - middle[:, None] * direction), middle, square

    def point(self, i: Numbers, j: Numbers) -> tuple[Floats, Floats]:
        """Return the points of the extended surfaces, and the rays' directions, (n, 3)."""
        origin, direction = self._view.ray(i, j)
        with quiet():
            return origin + self.parameter(i, j)[:, None] * direction, direction

    def at_outline(self, i: Numbers, j: Numbers, px: float) -> Bools:
        """Return a mask of pixels within px, or float32's error, of their primitive's outline."""
        found = np.zeros(len(self.t), bool)
        with quiet():
            inside = self._side * self._edge_values(i, j) / norm(self._edges[..., :2], 2)
            near = np.fmax(px, self._unknown_px(i, j))
        # Near an edge, and not beyond another one.
        found[self._triangle] = (np.abs(inside) <= near).any(axis=1) & (inside >= -near).all(axis=1)
        found[self._sphere] = is_within(
            lambda i, j: self._from_center(i, j)[0] - self._spheres[:, 3], i, j, px
        )
        return found

    def _unknown_px(self, i: Numbers, j: Numbers) -> Floats:
        """Return float32's error in the positions of edges, in pixels, (m, 3).

        It is ROUNDING_32 of the object's size, or of the triangle's distance if that is less.
        """
        view, camera, owner = self._view, self._view.camera, self._owner[self._triangle]
        linear = view.flat.world_from_object[owner, :3, :3]
        size = norm(np.ptp(view.flat.object_bounds[owner], axis=1) * norm(linear, 1))
        far = norm(self._corners - np.asarray(camera.eye), 2).max(axis=1, initial=0)
        left, right, bottom, top = camera.viewport
        pixels = np.divide(view.size, (right - left, top - bottom))  # per unit, at t = 1
        pixels *= norm(camera.camera_from_world[:2, :3], 1)
        across = self._edges[..., :2] / norm(self._edges[..., :2], 2)[..., None]
        t = 1.0 if camera.is_parallel else np.abs(self._depth(i, j))
        return norm(across * pixels, 2) * (ROUNDING_32 * np.minimum(size, far) / t)[:, None]

    def at_clip(self, i: Numbers, j: Numbers, px: float, drawn: bool = False) -> Bools:
        """Return a mask of pixels within px of a cut by near, far or the eye's plane, or on a part
        of a triangle too near to the eye for OpenGL. drawn: without parts that were drawn.
        """
        camera, here = self._view.camera, self.parameter(i, j)
        found = np.zeros(len(self.t), bool)
        unknown = np.full(len(self.t), ROUNDING_64 * self._view.largest_parameter)
        if camera.is_parallel:
            depths = np.abs(self._points[..., 2]).max(axis=1, initial=0)
            unknown[self._triangle] += ROUNDING_32 * depths
        for limit in camera.t_range:
            if np.isfinite(limit):
                with quiet():
                    found |= np.abs(here - limit) <= np.maximum(1e-6 * limit, unknown)
                found |= is_within(lambda i, j: self.parameter(i, j) - limit, i, j, px)  # noqa: B023
        if not camera.is_parallel:
            # OpenGL clips at NEAREST of the object's farthest depth. That displaces the rest of a
            # triangle by ROUNDING_32 of its size; it may vanish if that is more than MARGIN.
            flat, owner = self._view.flat, self._owner[self._triangle]
            corners = corners_of(flat.object_bounds[owner])
            matrix = flat.world_from_object[owner]
            world = corners @ np.swapaxes(matrix[:, :3, :3], 1, 2) + matrix[:, None, :3, 3]
            farthest = self._view.image_points(world)[..., 2].max(axis=1)
            vast = np.abs(self._points[..., :2]).max(axis=(1, 2)) / MARGIN * (not drawn)
            nearest = np.zeros(len(self.t))
            nearest[self._triangle] = np.maximum(
                (NEAREST + ROUNDING_32) * farthest, ROUNDING_32 * vast
            )
            found |= self.t <= nearest * self._view.stretch(i, j)
        return found & (self.primitive >= 0)

    def checker_px(self, i: Numbers, j: Numbers) -> Floats:
        """Return the distance from the nearest border of a checker's cell. It is inf without a
        checker, and 0 below float32's error.
        """
        flat, view = self._view.flat, self._view
        distance = np.full(len(self.t), np.inf)
        checkered = self.primitive >= 0
        if len(flat.materials):
            checkered &= flat.materials[self._owner, SPECULAR_CHECKERED, 3] == CHECKERED
        if not checkered.any():
            return distance
        rows = flat.cells[self._owner]

        def cell(i: Numbers, j: Numbers) -> Floats:
            point, direction = self.point(i, j)
            with quiet():
                inward = np.einsum("nrk,nk->nr", rows[:, :, :3], self._facing(point, direction))
                inward *= CELL_NUDGE / np.linalg.norm(inward, axis=1, keepdims=True)
            place: Floats = np.einsum("nrk,nk->nr", rows[:, :, :3], point) + rows[:, :, 3] - inward
            return place

        here = cell(i, j)
        with quiet():
            away = norm(self.point(i, j)[0] - np.asarray(view.camera.eye))
            off = np.abs(here - np.round(here))
            unknown = ROUNDING_32 * away[:, None] * np.linalg.norm(rows[:, :, :3], axis=2)
            px = np.where(off <= unknown, 0.0, off / slope_of(cell, i, j))
        return np.where(checkered, np.fmin.reduce(px, axis=1), np.inf)

    def _facing(self, point: Floats, direction: Floats) -> Floats:
        """Return the geometric normals on the viewer's side, not normalised: (n, 3)."""
        normal = np.zeros_like(point)
        a, b, c = np.moveaxis(self._corners, 1, 0)
        normal[self._triangle] = np.cross(b - a, c - a)
        normal[self._sphere] = point[self._sphere] - self._spheres[:, :3]
        return np.where((_dot(normal, direction) > 0)[:, None], -normal, normal)

    def texture_varies(self, i: Numbers, j: Numbers) -> Floats:
        """Return the relative variation (n, 3), 0 to 1, of a texture's and a metal's light within
        TOLERANCE_PX.
        """
        varies = np.zeros((len(self.t), 3))
        textured, places = self._places_around(i, j, TOLERANCE_PX)
        for sample in (sampled, gloss) if textured.any() else ():
            low, high = between(sample, self._view.flat, self._owner[textured], places)
            varies[textured] = np.maximum(varies[textured], 1 - low / np.where(high > 0, high, 1))
        return varies

    def at_hole(self, i: Numbers, j: Numbers, px: float) -> Bools:
        """Return a mask of pixels with both a hole and no hole within px."""
        found = np.zeros(len(self.t), bool)
        textured, places = self._places_around(i, j, px)
        if textured.any():
            low, high = between(opacity, self._view.flat, self._owner[textured], places)
            found[textured] = ((low <= 0) & (high >= 0))[:, 0]
        return found

    def _places_around(self, i: Numbers, j: Numbers, px: float) -> tuple[Bools, Floats]:
        """Return a mask of textured pixels, and texel coordinates (k, n, 2) around them, within px
        and float32's error.
        """
        flat = self._view.flat
        textured = self.primitive >= 0
        if not len(flat.texels) or not textured.any():
            return np.zeros(len(self.t), bool), np.zeros((0, 0, 2))
        textured = textured & (flat.textures[self._owner, 0, 1] > 0)
        around = [
            self._texture_place(i + px * down, j + px * right)[textured]
            for down in (-1, 0, 1)
            for right in (-1, 0, 1)
        ]
        here, reach = around[4], np.abs(around[4]).max(axis=1)
        is_triangle = textured[self._triangle]
        corners = flat.uv[flat.faces[self._faces[is_triangle]]]
        reach[self._triangle[textured]] = np.abs(corners).max(axis=(1, 2), initial=0)
        unknown = 2 * ROUNDING_32 * reach[:, None]
        around += [here + unknown * side for side in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        return textured, np.where(np.isfinite(around), around, 0.0)

    def _texture_place(self, i: Numbers, j: Numbers) -> Floats:
        """Return texel coordinates (n, 2)."""
        places, flat = np.zeros((len(self.t), 2)), self._view.flat
        places[self._triangle] = on_triangles(flat, self._faces, self.weights(i, j))
        outward = self.point(i, j)[0][self._sphere] - self._spheres[:, :3]
        places[self._sphere] = on_spheres(flat, self._owner[self._sphere], outward)
        return places

    def interpolated(self, i: Numbers, j: Numbers) -> Floats:
        """Return the smooth normals and the vertices' colours, (n, 6); 0 for spheres."""
        flat, result = self._view.flat, np.zeros((len(self.t), 6))
        vertices, weights = flat.faces[self._faces], self.weights(i, j)
        normal, tint = (
            np.einsum("nk,nkx->nx", weights, of[vertices].astype(float))
            for of in (flat.normals, flat.colors)
        )
        with quiet():
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        result[self._triangle] = np.concatenate([normal, tint], axis=1)
        return np.nan_to_num(result)


def is_within(function: Function, i: Numbers, j: Numbers, px: float) -> Bools:
    """Return a mask of pixels within px of the function's zero, to first order."""
    with quiet():
        near: Bools = np.abs(function(i, j)) <= px * slope_of(function, i, j)
    return near


def slope_of(function: Function, i: Numbers, j: Numbers) -> Floats:
    """Return a function's change per pixel, in the direction of its largest change."""
    with quiet():
        across = function(i, j + STEP_PX) - function(i, j - STEP_PX)
        down = function(i + STEP_PX, j) - function(i - STEP_PX, j)
        return np.hypot(across, down) / (2 * STEP_PX)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("nk,nk->n", a, b)


def norm(a: Floats, axis: int = 1) -> Floats:
    """Return the lengths of vectors along an axis."""
    lengths: Floats = np.linalg.norm(a, axis=axis)
    return lengths
