"""The camera: maps from pixels to rays, and a rasterizer's matrices for the same rays.

Pixels are (i, j) = (row, column), 0-based, row 0 at the top. Sizes are (width, height).
Matrices are float64 (4, 4) for column vectors, named destination_from_source.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from importlib import import_module

import numpy as np
from numpy.typing import ArrayLike
from pyrr import matrix44

from lucida.renderer.images.frame import DISPLAY, check_size
from lucida.renderer.system.errors import LucidaError, not_together

from . import image_plane
from .basis import inverse, looking_at, orthonormal
from .checks import (
    Floats,
    Vector,
    check_basis,
    check_clip,
    check_projection,
    check_viewport,
    checked_aspect,
    cross,
    dot,
    number,
    numbers,
    positive,
    volume,
)
from .image_plane import WHOLE, Part, Projected, Ray, Size
from .intrinsics import Intrinsics, as_camera_from_world, camera_fields, check_for_lens, decomposed
from .lenses import Lens, check_lens

# The near clip of an object that extends behind the eye, relative to its farthest t. GL clips in
# float32, so the rest of a long triangle might be behind the eye with a nearer plane.
NEAREST = 1e-6


@dataclass(frozen=True, slots=True)
class Camera:
    """An eye, a basis, a viewport and a projection (the contract: README, "The camera").

    eye: position, world units. u, v, w: right, up and back; any three independent vectors.
    distance: from the eye to the viewport along -w, in units of w. viewport: (left, right,
    bottom, top) in units of u and v. near, far: clip planes along -w in units of w, or None.
    lens: None for a pinhole; a perspective camera may have one (renderer/camera/lenses.py). Raises
    LucidaError naming the field, its value and the remedy.
    """

    eye: Vector = (0.0, 0.0, 0.0)
    u: Vector = (1.0, 0.0, 0.0)
    v: Vector = (0.0, 1.0, 0.0)
    w: Vector = (0.0, 0.0, 1.0)
    distance: float = 1.0
    viewport: tuple[float, float, float, float] = (-0.5, 0.5, -0.5, 0.5)
    projection: str = "perspective"
    near: float | None = None
    far: float | None = None
    lens: Lens | None = None

    def __post_init__(self) -> None:
        for name, count in (("eye", 3), ("u", 3), ("v", 3), ("w", 3), ("viewport", 4)):
            given = getattr(self, name)
            if (checked := numbers(name, given, count)) is not given:
                object.__setattr__(self, name, checked)
        for name in ("distance", "near", "far"):
            if name == "distance" or getattr(self, name) is not None:
                object.__setattr__(self, name, number(name, getattr(self, name)))
        check_projection(self.projection)
        check_basis(self.u, self.v, self.w)
        positive("distance", self.distance, "1.0")
        check_viewport(self.viewport)
        check_clip(self.near, self.far)
        if self.lens is not None:
            check_lens(self.lens, self.projection)

    @classmethod
    def canonical(cls) -> Camera:
        """Return the lecture's camera: at the origin, looking down -z, a viewport of 1 x 1, d 1."""
        return cls()

    @classmethod
    def look_at(
        cls,
        eye: Iterable[float],
        target: Iterable[float],
        up: Iterable[float] = (0.0, 1.0, 0.0),
        fov_y_deg: float | None = None,
        distance: float | None = None,
        aspect: float = 1.0,
        projection: str = "perspective",
    ) -> Camera:
        """Return an orthonormal camera at `eye`, looking at `target`, with `up` upwards in the
        image.

        Give the vertical field of view, or the distance of a viewport 1 high (default: 1). aspect:
        the viewport's width over its height.
        """
        position, basis = looking_at(eye, target, up)
        if fov_y_deg is not None:
            if distance is not None:
                raise not_together("fov_y_deg", "distance")
            fov = number("fov_y_deg", fov_y_deg)
            if not 0 < fov < 180:
                raise LucidaError("fov_y_deg", f"{fov:g} is not between 0 and 180", "give e.g. 40")
            distance = 0.5 / math.tan(math.radians(fov) / 2)
        aspect = positive("aspect", aspect, "width / height")
        return cls(
            position,
            *basis,
            1.0 if distance is None else distance,
            (-aspect / 2, aspect / 2, -0.5, 0.5),
            projection,
        )

    @classmethod
    def from_intrinsics(
        cls,
        K: ArrayLike,
        *,
        size: Size,
        world_from_camera: ArrayLike | None = None,
        camera_from_world: ArrayLike | None = None,
        axes: str = "opencv",
        pixel_origin: str = "center",
        lens: Lens | None = None,
    ) -> Camera:
        """Return the camera of computer vision: K (3, 3) in pixels and a pose (3, 4) or (4, 4).

        Give one of the two poses; with neither, the camera is at the origin. size: (width, height)
        of the image that K is for. axes: the pose's, "opencv" (y down, z forward) or "opengl" (y
        up, z back); K's are always the image's. pixel_origin: integers are at the pixels' "center"
        (OpenCV) or "corner" (COLMAP). lens: K then has no skew and no mirror. Raises LucidaError.
        Source: renderer/camera/intrinsics.py.
        """
        if world_from_camera is not None:
            if camera_from_world is not None:
                raise not_together("world_from_camera", "camera_from_world")
            camera_from_world = as_camera_from_world(world_from_camera)
        pose = np.eye(4) if camera_from_world is None else camera_from_world
        fields = camera_fields(K, pose, check_size(size), axes, pixel_origin)
        if lens is not None:
            check_for_lens(np.asarray(K, float))
        return cls(**fields, lens=lens)

    def _repr_html_(self) -> str:
        html: str = import_module(DISPLAY).camera_html(self)
        return html

    @property
    def is_parallel(self) -> bool:
        return self.projection == "parallel"

    @property
    def basis(self) -> Floats:
        """The matrix with columns u, v, w; (3, 3)."""
        return np.column_stack([self.u, self.v, self.w])

    @property
    def determinant(self) -> float:
        """The signed volume of the basis: negative for a left-handed one."""
        return volume(self.u, self.v, self.w)

    @property
    def fov_x_deg(self) -> float:
        """Horizontal field of view in degrees, between the viewport's left and right edges."""
        return self._angle_deg(0)

    @property
    def fov_y_deg(self) -> float:
        """Vertical field of view in degrees, between the viewport's bottom and top edges."""
        return self._angle_deg(1)

    def _angle_deg(self, axis: int) -> float:
        """Return the angle between two edges of the viewport, on its line x = 0 or y = 0.

        With a lens, it is summed up along the part of the line within the lens.
        """
        low, high = self.viewport[2 * axis : 2 * axis + 2]
        if self.lens is None:  # plain Python, because the window needs it in each frame
            along = tuple(zip((self.u, self.v)[axis], self.w, strict=True))
            a, b = ([x * e - self.distance * back for e, back in along] for x in (low, high))
            return math.degrees(math.atan2(math.hypot(*cross(a, b)), dot(a, b)))
        points = image_plane.points_across(self.lens, axis, low, high, self.distance)
        return image_plane.summed_angle_deg(self.direction(*points))

    @property
    def t_range(self) -> tuple[float, float]:
        """(t_min, t_max): near and far as ray parameters; (0, inf) if they are not set."""
        unit = 1.0 if self.is_parallel else self.distance
        near = 0.0 if self.near is None else self.near / unit
        return near, math.inf if self.far is None else self.far / unit

    @property
    def pinhole(self) -> Camera:
        """This camera without its lens."""
        return self if self.lens is None else replace(self, lens=None)

    # Pixels to rays.

    def image_point(self, i: ArrayLike, j: ArrayLike, size: Size) -> tuple[Floats, Floats]:
        """Return (x, y) on the image plane, in units of u and v, of the centre of pixel (i, j).

        i, j: row and column, any shape, may be fractional. size: (width, height).
        """
        return image_plane.image_point(i, j, self.viewport, size)

    def ray(self, i: ArrayLike, j: ArrayLike, size: Size) -> Ray:
        """Return the viewing ray of pixel (i, j); for arrays of pixels, arrays (..., 3).

        Outside the lens, the direction is NaN.
        """
        x, y = np.broadcast_arrays(*self.image_point(i, j, size))
        if self.is_parallel:
            origin = np.asarray(self.eye) + self._across(x, y)
            return Ray(origin, np.broadcast_to(-np.asarray(self.w), origin.shape))
        direction = self.direction(x, y)
        return Ray(np.broadcast_to(np.asarray(self.eye), direction.shape), direction)

    def rays(self, size: Size) -> Ray:
        """Return the rays of all pixels: origin and direction float64 (height, width, 3)."""
        if self.lens is None:
            return self.ray(np.arange(size[1])[:, None], np.arange(size[0]), size)
        direction = self.lens_directions(size) @ self.basis.T
        return Ray(np.broadcast_to(np.asarray(self.eye), direction.shape), direction)

    def z_from_t(self, t: ArrayLike, size: Size, part: Part = WHOLE) -> Floats:
        """Return the distances z along -w, in units of w, for the ray parameters t of a part of the
        pixels, both (rows, columns). Infinite t have infinite z.
        """
        ahead = self.distance if self.lens is None else -self.lens_directions(size)[*part, 2]
        with np.errstate(invalid="ignore"):  # outside the lens
            z = np.asarray(t, float) * (1.0 if self.is_parallel else ahead)
        return np.where(np.isfinite(t), z, t)

    def lens_directions(self, size: Size) -> Floats:
        """Return the directions of all pixels' rays in units of u, v and w: read-only float64
        (height, width, 3), NaN outside the lens. They do not depend on eye and basis, and are
        computed once, up to LARGEST_KEPT pixels. The camera must have a lens.
        """
        assert self.lens is not None
        return image_plane.all_seen_through(self.lens, self.viewport, self.distance, size)

    def direction(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the directions (..., 3) of perspective rays through points of the image plane.

        x, y: in units of u and v, any shape. Outside the lens, the directions are NaN.
        """
        x, y = np.asarray(x, float), np.asarray(y, float)
        if self.lens is None:
            return self._across(x, y) - self.distance * np.asarray(self.w)
        return image_plane.seen_through(self.lens, x, y, self.distance) @ self.basis.T

    def _across(self, x: Floats, y: Floats) -> Floats:
        across: Floats = x[..., None] * np.asarray(self.u) + y[..., None] * np.asarray(self.v)
        return across

    # Points to pixels.

    def intrinsics(self, size: Size, pixel_origin: str = "center") -> Intrinsics:
        """Return K, R and t for an image of this size.

        A world point p is at the pixel (x, y) given by K (R p + t), divided by its third component.
        K has a skew if u and v are not at right angles, and K[0, 0] < 0 if the basis is
        left-handed. A lens is disregarded. pixel_origin: as in from_intrinsics(). Raises
        LucidaError for a parallel camera.
        """
        if self.is_parallel:
            problem = "'parallel' has no focal length"
            raise LucidaError("projection", problem, "give a perspective camera")
        width, height = check_size(size)
        left, right, bottom, top = self.viewport
        image = np.array(
            [
                [(right - left) / width, 0, left],
                [0, (bottom - top) / height, top],
                [0, 0, -self.distance],
            ]
        )
        return decomposed(self.basis @ image, self.eye, pixel_origin)

    def project(self, points: ArrayLike, size: Size) -> Projected:
        """Return the pixels and ray parameters of world points (..., 3): the inverse of ray().

        row and column are 0-based, with the pixels' centres at integers. In perspective, they are
        NaN for points outside the lens, or not in front of the eye (parameter <= 0).
        """
        matrix = self.camera_from_world
        x, y, z = np.moveaxis(np.asarray(points, float) @ matrix[:3, :3].T + matrix[:3, 3], -1, 0)
        if self.is_parallel:
            parameter = -z
        elif self.lens is not None:
            parameter = self.lens.length(x, -y, -z) / self.distance
            a, b = self.lens.image_point(x, -y, -z)
            x, y = a * self.distance, -b * self.distance
        else:
            parameter = -z / self.distance
            ahead = np.where(parameter > 0, parameter, np.nan)
            x, y = x / ahead, y / ahead
        left, right, bottom, top = self.viewport
        column = (x - left) / (right - left) * size[0] - 0.5
        row = (top - y) / (top - bottom) * size[1] - 0.5
        return Projected(row, column, parameter)

    # Matrices for the rasterizer.

    @property
    def camera_from_world(self) -> Floats:
        """The inverse of world_from_camera, read-only; no transpose, since the basis may be
        skewed.
        """
        return inverse(self.eye, self.u, self.v, self.w)

    def image_from_world(self, size: Size) -> Floats:
        """Return the matrix (3, 4) from a world point (x, y, z, 1) to its place in the image, and
        its ray parameter t. A lens is disregarded.

        The place is in pixels from the image's centre, x right, y down. In perspective, it is
        multiplied by t, and therefore affine in the point.
        """
        left, right, bottom, top = self.viewport
        x, y, z, one = self.camera_from_world
        t = -z if self.is_parallel else -z / self.distance
        unit = one if self.is_parallel else t
        across = (x - (left + right) / 2 * unit) * (size[0] / (right - left))
        up = (y - (bottom + top) / 2 * unit) * (size[1] / (top - bottom))
        return np.stack([across, -up, t])

    def clip_from_camera(self, near: float, far: float) -> Floats:
        """Return the projection matrix of the viewport's frustum (perspective) or box (parallel).

        It maps near to -1 and far to +1. near, far: distances along -w in units of w; 0 < near <
        far in perspective.
        """
        # pyrr uses row vectors, so transpose.
        if self.is_parallel:
            return matrix44.create_orthogonal_projection(*self.viewport, near, far).T
        edges = (edge * near / self.distance for edge in self.viewport)
        return matrix44.create_perspective_projection_from_bounds(*edges, near, far).T

    # Cameras derived from this one.

    def orthonormalized(self) -> Camera:
        """Return the camera with an orthonormal basis (Gram-Schmidt); w keeps its direction."""
        u, v, w = orthonormal(self.u, self.v, self.w)
        return replace(self, u=u, v=v, w=w)

    def fitted(self, size: tuple[float, float]) -> Camera:
        """Return this camera with its viewport enlarged about its centre, in one direction, to the
        image's aspect ratio. Nothing inside the old viewport is lost.

        size: (width, height). Raises LucidaError for an invalid one.
        """
        left, right, bottom, top = self.viewport
        half_width, half_height = (right - left) / 2, (top - bottom) / 2
        aspect = checked_aspect(size)
        x, y = (left + right) / 2, (bottom + top) / 2
        dx, dy = max(half_width, half_height * aspect), max(half_height, half_width / aspect)
        viewport = (x - dx, x + dx, y - dy, y + dy)
        return replace(self, viewport=viewport)

    def cropped(self, rows: tuple[int, int], size: Size) -> Camera:
        """Return the camera of some rows of an image: from rows[0] up to, not including, rows[1].

        Their pixels' rays are the same, to the rounding of the viewport's edges.
        """
        left, right, bottom, top = self.viewport
        first, end = (top - row / size[1] * (top - bottom) for row in rows)
        return replace(self, viewport=(left, right, end, first))

    def shifted(self, rows: float, columns: float, size: Size) -> Camera:
        """Return this camera shifted for supersampling: its ray of pixel (i, j) is the old one of
        (i + rows, j + columns).
        """
        left, right, bottom, top = self.viewport
        dx, dy = columns / size[0] * (right - left), -rows / size[1] * (top - bottom)
        return replace(self, viewport=(left + dx, right + dx, bottom + dy, top + dy))


def check_camera(camera: object) -> Camera:
    """Return the camera. Raises LucidaError for anything else, such as a View, which needs an image
    size to become a camera.
    """
    if isinstance(camera, Camera):
        return camera
    kind = type(camera).__name__
    remedy = "give .for_size(size) of it" if hasattr(camera, "for_size") else "give a Camera"
    raise LucidaError("camera", f"is of type {kind}, not a Camera", remedy)
