"""Why two images of one view differ at a pixel: which discontinuity of the exact image is near.

A rasterizer snaps vertices to 1/256 pixel. A pixel whose centre is within TOLERANCE_PX of a line
where the exact image jumps may therefore see either side of it. Both renderers compute in float32:
the same holds within float32's error of such a line. Everywhere else the images must agree.

Only lines of the two primitives that the images show at the pixel count. All of this is float64,
and each line is the zero of a smooth function of the position in the image, so that its distance
in pixels is the function's value over its slope:

    edge     an edge of a triangle, the outline of a sphere; where the two surfaces meet; a surface
             so oblique or small that its depth, smooth normal or vertex colours differ as much
             within TOLERANCE_PX
    pattern  a border of a checker's cell or of a hole; a texture that varies as much
    clip     where near or far cuts, or what OpenGL clips right before the eye
    lookup   an edge, a clip line or a hole within half a texel, in the pinhole image in which a
             lens's pixel is looked up
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from renderer.camera import NEAREST, Camera, Floats
from renderer.frame import Frame
from renderer.lens_faces import Face, looked_up_faces
from renderer.scene.flat import SPECULAR_CHECKERED, FlatScene
from renderer.scene.positions import world_corners
from renderer.scene.sampling import between, gloss, on_spheres, on_triangles, opacity, sampled
from renderer.shared_numbers import CELL_NUDGE, CHECKERED

Ints = NDArray[np.integer]
Bools = NDArray[np.bool_]
Numbers = NDArray[np.integer] | NDArray[np.floating]
Function = Callable[[Numbers, Numbers], Floats]  # of rows and columns in the image

CAUSES = ("edge", "pattern", "clip", "lookup")
TOLERANCE_PX = 1 / 128
HALF_TEXEL_PX = 0.5**0.5 + TOLERANCE_PX  # from a texel's middle to its corner
STEP_PX = 1 / 256  # of central differences
ROUNDING_32 = 2.0**-21  # float32's error after a few roundings, relative
ROUNDING_64 = 1e-12  # float64's error at the eye, relative to the largest coordinate
DEPTH_RELATIVE = 1e-4
NORMAL = 1e-3  # per component
ROUNDED_LIGHT = 1e-4  # relative: float32's error in a colour
MARGIN = 1024  # pixels around the image that OpenGL clips to (raster/scene_data.py)
_CORNERS = np.array(list(np.ndindex(2, 2, 2)))  # of a box

# Degenerate primitives and misses: their NaN and infinities are replaced at the end.
_quiet = partial(np.errstate, divide="ignore", invalid="ignore", over="ignore")


@dataclass(frozen=True)
class Differing:
    """Pixels (i, j) at which the raster image and the ray image differ, with all channels."""

    raster: Frame
    ray: Frame
    i: NDArray[np.intp]
    j: NDArray[np.intp]

    def channel(self, name: str) -> NDArray:
        """Return both images' values, (2, n, ...)."""
        return np.stack([frame.channel(name)[self.i, self.j] for frame in (self.raster, self.ray)])

    def part(self, numbers: NDArray[np.intp]) -> Differing:
        return Differing(self.raster, self.ray, self.i[numbers], self.j[numbers])


def explained(
    flat: FlatScene,
    camera: Camera,
    size: tuple[int, int],
    pixels: Differing,
    enlargement: int | None,
) -> NDArray[np.uint8]:
    """Return for each of n pixels 1 + the index in CAUSES of what explains it; 0 for nothing.

    enlargement: of the faces in which the raster image of a lens was looked up; None if both images
    were made from the pixels' rays.
    """
    if camera.lens is None:
        return View(flat, camera, size).causes(pixels, pixels.i, pixels.j)
    faces = looked_up_faces(camera, size, enlargement or 1)
    labels = np.zeros(len(pixels.i), np.uint8)
    for number, face in enumerate(faces.faces):
        (mine,) = np.nonzero(faces.positions[pixels.i, pixels.j, 2] == number)
        if not len(mine):
            continue
        view, part = View(flat, face.camera, face.size, face), pixels.part(mine)
        labels[mine] = view.causes(part, *faces.place(number, part.i, part.j))
        if enlargement is None:
            continue
        for places in (faces.place(number, part.i, part.j), faces.texel(number, part.i, part.j)):
            near = view.parting(part, *places, HALF_TEXEL_PX).any(axis=0)
            labels[mine[near & (labels[mine] == 0)]] = 1 + CAUSES.index("lookup")
    return labels


@dataclass(frozen=True)
class View:
    """One scene as seen by a pinhole camera in an image of (width, height).

    face: of a lens's image, whose camera and size these are: ray parameters are then those of the
    lens's rays.
    """

    flat: FlatScene
    camera: Camera
    size: tuple[int, int]
    face: Face | None = None

    def causes(self, pixels: Differing, i: Numbers, j: Numbers) -> NDArray[np.uint8]:
        """Return labels (n,) as explained() does, without lookups. i, j: where the pixels' rays are
        in this image.
        """
        edge, hole, clip = self.parting(pixels, i, j, TOLERANCE_PX)
        first, second = pixels.channel("primitive")
        t = pixels.channel("depth").astype(float)
        same = (first == second) & (first >= 0)
        seen = Surfaces(self, second, t[1])
        jumps, is_shade = _jumps(seen, pixels, i, j)
        edge |= same & jumps
        border = same & (seen.checker_px(i, j) <= TOLERANCE_PX)
        light = pixels.channel("color")
        with _quiet():
            part = np.abs(light[1] - light[0]) / light.max(axis=0)
        part[(light[0] == light[1]) | (part <= ROUNDED_LIGHT)] = 0
        varies = seen.texture_varies(i, j)
        border |= same & is_shade & (part <= varies).all(axis=1) & varies.any(axis=1)
        return np.select([clip, edge, border | hole], [3, 1, 2], 0).astype(np.uint8)

    def parting(self, pixels: Differing, i: Numbers, j: Numbers, px: float) -> Bools:
        """Return which pixels are within `px` of a line that parts two primitives: an edge, a hole,
        a clip line, (3, n).
        """
        primitives, depths = pixels.channel("primitive"), pixels.channel("depth").astype(float)
        first, second = (Surfaces(self, *one) for one in zip(primitives, depths, strict=True))
        edge = first.at_outline(i, j, px) | second.at_outline(i, j, px)
        edge |= _meet(first, second, i, j, px)
        clip = first.at_clip(i, j, px, drawn=True) | second.at_clip(i, j, px)
        differ = primitives[0] != primitives[1]
        hole = differ & (first.at_hole(i, j, px) | second.at_hole(i, j, px))
        return np.array([edge, hole, clip])

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
        """Return world points in the image (..., 3): pixels from its centre, right and down,
        multiplied by t in perspective; and t. Points behind the eye also have a position.
        """
        camera, (width, height) = self.camera, self.size
        left, right, bottom, top = camera.viewport
        from_eye = world - np.asarray(camera.eye)
        x, y, z = np.moveaxis(from_eye @ camera.camera_from_world[:3, :3].T, -1, 0)
        t = -z if camera.is_parallel else -z / camera.distance
        weight = 1.0 if camera.is_parallel else t
        column = (x - (left + right) / 2 * weight) * (width / (right - left))
        row = ((top + bottom) / 2 * weight - y) * (height / (top - bottom))
        return np.stack([column, row, t], axis=-1)


class Surfaces:
    """A primitive for each of n pixels (-1: none), extended beyond its outline.

    t: (n,), the ray parameters of the hits: of a sphere's two hits, the one nearer to it counts.
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
        # Any object's if nothing is hit.
        self._owner = owners[primitive] if len(owners) else np.zeros(len(primitive), int)
        seen = self._points = view.image_points(self._corners)
        if view.camera.is_parallel:
            seen = np.concatenate([seen[..., :2], np.ones_like(seen[..., :1])], axis=2)
        # Edge k is opposite to corner k: the line x . edge = 0 of the pixels x = (x, y, 1).
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
        with _quiet():
            weights: Floats = values / values.sum(axis=1, keepdims=True)
        return weights

    def parameter(self, i: Numbers, j: Numbers) -> Floats:
        """Return the ray parameters (n,) of the hits with the extended surfaces; NaN: no hit."""
        result = np.full(len(self.t), np.nan)
        with _quiet():
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
        return _length(to_center - middle[:, None] * direction), middle, square

    def point(self, i: Numbers, j: Numbers) -> tuple[Floats, Floats]:
        """Return the points of the extended surfaces, and the rays' directions, (n, 3)."""
        origin, direction = self._view.ray(i, j)
        with _quiet():
            return origin + self.parameter(i, j)[:, None] * direction, direction

    def at_outline(self, i: Numbers, j: Numbers, px: float) -> Bools:
        """Return which pixels are within px of their primitive's outline, or of an edge to its
        error in float32.
        """
        found = np.zeros(len(self.t), bool)
        with _quiet():
            inside = self._side * self._edge_values(i, j) / _norm(self._edges[..., :2], 2)
            near = np.fmax(px, self._unknown_px(i, j))
        # Near an edge, and not beyond another one.
        found[self._triangle] = (np.abs(inside) <= near).any(axis=1) & (inside >= -near).all(axis=1)
        found[self._sphere] = _within(
            lambda i, j: self._from_center(i, j)[0] - self._spheres[:, 3], i, j, px
        )
        return found

    def _unknown_px(self, i: Numbers, j: Numbers) -> Floats:
        """Return float32's error in the positions of edges, in pixels, (m, 3).

        It is ROUNDING_32 of the object's size, or of the triangle's distance if that is less.
        """
        view, camera, owner = self._view, self._view.camera, self._owner[self._triangle]
        linear = view.flat.world_from_object[owner, :3, :3]
        size = _length(np.ptp(view.flat.object_bounds[owner], axis=1) * _norm(linear, 1))
        far = _norm(self._corners - np.asarray(camera.eye), 2).max(axis=1, initial=0)
        left, right, bottom, top = camera.viewport
        pixels = np.divide(view.size, (right - left, top - bottom))  # per unit, at t = 1
        pixels *= _norm(camera.camera_from_world[:2, :3], 1)
        across = self._edges[..., :2] / _norm(self._edges[..., :2], 2)[..., None]
        t = 1.0 if camera.is_parallel else np.abs(self._depth(i, j))
        return _norm(across * pixels, 2) * (ROUNDING_32 * np.minimum(size, far) / t)[:, None]

    def at_clip(self, i: Numbers, j: Numbers, px: float, drawn: bool = False) -> Bools:
        """Return which pixels are within px of where near, far or the eye's plane cuts, or see a
        part of a triangle that is too near to the eye for OpenGL. drawn: not if it was drawn.
        """
        camera, here = self._view.camera, self.parameter(i, j)
        found = np.zeros(len(self.t), bool)
        unknown = np.full(len(self.t), ROUNDING_64 * self._view.largest_parameter)
        if camera.is_parallel:
            depths = np.abs(self._points[..., 2]).max(axis=1, initial=0)
            unknown[self._triangle] += ROUNDING_32 * depths
        for limit in camera.t_range:
            if np.isfinite(limit):
                with _quiet():
                    found |= np.abs(here - limit) <= np.maximum(1e-6 * limit, unknown)
                found |= _within(lambda i, j: self.parameter(i, j) - limit, i, j, px)  # noqa: B023
        if not camera.is_parallel:
            # OpenGL clips at NEAREST of the object's farthest depth. That displaces the rest of a
            # triangle by ROUNDING_32 of its size: if it is more than MARGIN, it may vanish.
            flat, owner = self._view.flat, self._owner[self._triangle]
            corners = flat.object_bounds[owner][:, _CORNERS, np.arange(3)]
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
        """Return the distance from the nearest border of a checker's cell; inf without a checker;
        0 if it is less than float32's error.
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
            with _quiet():
                inward = np.einsum("nrk,nk->nr", rows[:, :, :3], self._facing(point, direction))
                inward *= CELL_NUDGE / np.linalg.norm(inward, axis=1, keepdims=True)
            place: Floats = np.einsum("nrk,nk->nr", rows[:, :, :3], point) + rows[:, :, 3] - inward
            return place

        here = cell(i, j)
        with _quiet():
            away = _length(self.point(i, j)[0] - np.asarray(view.camera.eye))
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
        """Return by what part, 0 to 1, each colour of a texture's and a metal's light varies within
        TOLERANCE_PX: (n, 3).
        """
        varies = np.zeros((len(self.t), 3))
        textured, places = self._places_around(i, j, TOLERANCE_PX)
        for sample in (sampled, gloss) if textured.any() else ():
            low, high = between(sample, self._view.flat, self._owner[textured], places)
            varies[textured] = np.maximum(varies[textured], 1 - low / np.where(high > 0, high, 1))
        return varies

    def at_hole(self, i: Numbers, j: Numbers, px: float) -> Bools:
        """Return which pixels have both a hole and no hole within px."""
        found = np.zeros(len(self.t), bool)
        textured, places = self._places_around(i, j, px)
        if textured.any():
            low, high = between(opacity, self._view.flat, self._owner[textured], places)
            found[textured] = ((low <= 0) & (high >= 0))[:, 0]
        return found

    def _places_around(self, i: Numbers, j: Numbers, px: float) -> tuple[Bools, Floats]:
        """Return which pixels see something textured, and texel coordinates (k, n, 2) around them:
        within px, and float32's error.
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
        with _quiet():
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        result[self._triangle] = np.concatenate([normal, tint], axis=1)
        return np.nan_to_num(result)


def _meet(first: Surfaces, second: Surfaces, i: Numbers, j: Numbers, px: float) -> Bools:
    """Return which pixels are within px of where the surfaces of two primitives meet."""

    def gap(i: Numbers, j: Numbers) -> Floats:
        return first.parameter(i, j) - second.parameter(i, j)

    pair = (first.primitive >= 0) & (second.primitive >= 0)
    pair &= first.primitive != second.primitive
    with _quiet():  # the depth buffer's last place
        same = np.abs(gap(i, j)) <= 4e-6 * np.abs(second.t)
    return pair & (same | _within(gap, i, j, px))


def _jumps(seen: Surfaces, pixels: Differing, i: Numbers, j: Numbers) -> tuple[Bools, Bools]:
    """Return for pixels that show one primitive: does its depth, smooth normal or vertices' colour
    change as much as it differs within TOLERANCE_PX; do depth and normal not differ.
    """
    t, colors = pixels.channel("depth").astype(float), pixels.channel("color")
    turned = np.abs(np.subtract(*pixels.channel("normal"))).max(axis=1)
    with _quiet():
        slopes = slope_of(seen.interpolated, i, j)
        moved = np.abs(t[0] - t[1])
        moved[moved <= DEPTH_RELATIVE * t[1]] = 0
        is_moved = ~(moved <= TOLERANCE_PX * slope_of(seen.parameter, i, j))
        turned[turned <= NORMAL] = 0
        bend = TOLERANCE_PX * _length(slopes[:, :3])
        tint = slopes[:, 3:] / seen.interpolated(i, j)[:, 3:]
        faded = np.abs(colors[1] - colors[0]) / colors.max(axis=0)
        faded[colors[0] == colors[1]] = 0
        fades = (faded <= TOLERANCE_PX * np.nan_to_num(tint)).all(axis=1) & faded.any(axis=1)
    differs = ~((moved == 0) & (turned == 0))
    is_near = ~(is_moved & (moved != 0)) & (turned <= bend)
    return np.where(differs, is_near, fades), ~differs


def _within(function: Function, i: Numbers, j: Numbers, px: float) -> Bools:
    """Return where the function's zero is within px, to first order."""
    with _quiet():
        near: Bools = np.abs(function(i, j)) <= px * slope_of(function, i, j)
    return near


def slope_of(function: Function, i: Numbers, j: Numbers) -> Floats:
    """Return a function's change per pixel, in the direction of its largest change."""
    with _quiet():
        across = function(i, j + STEP_PX) - function(i, j - STEP_PX)
        down = function(i + STEP_PX, j) - function(i - STEP_PX, j)
        return np.hypot(across, down) / (2 * STEP_PX)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("nk,nk->n", a, b)


def _length(a: Floats) -> Floats:
    return np.linalg.norm(a, axis=1)


def _norm(a: Floats, axis: int) -> Floats:
    length: Floats = np.linalg.norm(a, axis=axis)
    return length
