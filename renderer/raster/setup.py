"""Triangle setup: the shaders' input for one camera, computed in float64.

These are the tables that change with the camera: the camera block, and a row for each triangle,
sphere and object, as NumPy arrays in the layout of shaders/chunks. GL is not needed.

Image coordinates are a point's (x, y) in pixels from the image's centre (x right, y up), and t, the
parameter of the ray through it. In perspective, x and y are multiplied by t, so that they are
affine in the point. Pixel centres are exact in float32 in these coordinates.

float32 has 7 digits, so nothing large may cancel on the GPU. Each object therefore has an anchor,
the point of its bounding box nearest to the eye. Vertices are in their object's space, and only
their difference from the anchor is used. Lights, which belong to no object, are relative to the
scene's point nearest to the eye (near_point). A triangle's plane intersects a ray at t (parallel)
or 1/t (perspective) that is affine in x and y. The three coefficients are computed here, where
N.(a - eye) may cancel without harm.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import NEAREST, Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.lens_faces import Face
from lucida.renderer.images.shared_numbers import (
    ROW_ANCHOR,
    ROW_CELLS,
    ROW_FROM_NEAR,
    ROW_IMAGE,
    ROW_INSIDE,
    SPHERE_TEXELS,
)
from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.scene.positions import lights_from, near_point

from .prepared import SceneSetup

FLOAT32_MAX = float(np.finfo(np.float32).max)
TINY = 1e-30
# Rows at a time. Small products stay on one thread of NumPy's BLAS, whose threads wait for one
# another, which takes tens of milliseconds while the tracer uses all cores.
BLOCK = 8192
# Up to this many objects in a block are multiplied one by one; otherwise, rows are.
FEW_OBJECTS = 100

# std140: a vec3 takes four floats, whose last one is free for a scalar.
CAMERA_BLOCK = np.dtype(
    [
        ("image_from_world", np.float32, (3, 4)),  # a mat3: three columns, padded
        ("step_x", np.float32, 3),
        ("perspective", np.float32),
        ("step_y", np.float32, 3),
        ("depth_scale", np.float32),
        ("direction", np.float32, 3),
        ("depth_low", np.int32),
        ("background", np.float32, 3),
        ("light_count", np.int32),
        ("ambient", np.float32, 3),
        ("padding", np.float32),
        ("half_size", np.float32, 2),
        ("t_range", np.float32, 2),
        ("clip_half", np.float32, 2),
        ("clip_z", np.float32, 2),
        ("plane", np.float32, 4),
        ("unit", np.float32, 3),
        ("more_padding", np.float32),
    ]
)


class RasterView(NamedTuple):
    """A camera without a lens, and the image's (width, height).

    face: this camera's face in the image of a camera with a lens.
    """

    camera: Camera
    size: tuple[int, int]
    face: Face | None = None


class ImageSpace(NamedTuple):
    """Image coordinates of one camera and size.

    image_from_world: (3, 4), for points relative to the eye: rows x, y (times t in perspective), t.
    step_x, step_y: (3,), world vectors of one pixel to the right and up, on the plane t = 1 in
    perspective. eye, across, direction: (3,); the ray through the image's centre starts at eye +
    across. near_point: (3,), see near_point(). clip_z: z in clip space is clip_z[0] * t +
    clip_z[1], in perspective minus twice the object's near. near: (objects,), 0 in parallel
    projection. t_low, t_high: bounds of all t > 0 in the scene that are drawn.
    """

    image_from_world: Floats
    step_x: Floats
    step_y: Floats
    eye: Floats
    across: Floats
    direction: Floats
    near_point: Floats
    clip_z: tuple[float, float]
    near: Floats
    t_low: float
    t_high: float

    def at(self, from_eye: Floats) -> Floats:
        """Return the image coordinates (n, 3) of points (n, 3) relative to the eye."""
        image: Floats = from_eye @ self.image_from_world[:, :3].T + self.image_from_world[:, 3]
        return image


def image_space(
    camera: Camera, size: tuple[int, int], flat: FlatScene, setup: SceneSetup
) -> ImageSpace:
    """Return the image coordinates of `camera` for an image of (width, height)."""
    width, height = size
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    u, v, w, eye = np.array((camera.u, camera.v, camera.w, camera.eye))
    across = x * u + y * v
    unit = 1.0 if camera.is_parallel else camera.distance
    from_eye = replace(camera, eye=(0.0, 0.0, 0.0)).image_from_world(size)
    t_row = from_eye[2]
    # The boxes of objects are in their own spaces.
    matrix, bounds = flat.world_from_object, flat.object_bounds
    middle = (setup.turned_middles + (matrix[:, :3, 3] - eye)) @ t_row[:3]
    half = np.einsum("ni,ni->n", np.abs(t_row[:3] @ matrix[:, :3, :3]), bounds[:, 1] - bounds[:, 0])
    half /= 2
    fitted = _fitted(middle - half, middle + half, setup.is_seen)
    clip_near, clip_far = (1.0, 2.0) if not camera.is_parallel else fitted.box
    clip_from_camera = camera.clip_from_camera(clip_near * unit, clip_far * unit)
    clip_z = (-clip_from_camera[2, 2], clip_from_camera[2, 3] / unit)
    return ImageSpace(
        image_from_world=from_eye * np.array([[1.0], [-1.0], [1.0]]),
        step_x=(right - left) / width * u,
        step_y=(top - bottom) / height * v,
        eye=eye,
        across=across if camera.is_parallel else np.zeros(3),
        direction=-w if camera.is_parallel else across - camera.distance * w,
        near_point=near_point(flat, eye),
        clip_z=clip_z if camera.is_parallel else (1.0, 0.0),
        near=np.zeros(len(bounds)) if camera.is_parallel else fitted.near,
        t_low=fitted.t_low,
        t_high=fitted.t_high,
    )


def camera_block(
    view: RasterView,
    margin: tuple[int, int],
    space: ImageSpace,
    flat: FlatScene,
) -> NDArray:
    """Return the uniform block of shaders/chunks/camera.glsl, one element of CAMERA_BLOCK.

    margin: the viewport's extension beyond the image on each side, (horizontal, vertical) pixels.
    """
    camera, size = view.camera, view.size
    block = np.zeros((), CAMERA_BLOCK)
    block["image_from_world"][:, :3] = space.image_from_world[:, :3].T
    block["step_x"], block["step_y"] = space.step_x, space.step_y
    block["direction"] = space.direction
    block["perspective"] = not camera.is_parallel
    block["half_size"] = size[0] / 2, size[1] / 2
    block["t_range"] = [min(t, FLOAT32_MAX) for t in camera.t_range]
    block["clip_half"] = size[0] / 2 + margin[0], size[1] / 2 + margin[1]
    block["clip_z"] = space.clip_z
    # Depth is a number's index among the floats between t_low and t_high, a piecewise linear
    # logarithm, so that 24 bits resolve t to a part in a million everywhere.
    t_min, t_max = camera.t_range
    t_low, t_high = max(space.t_low, 0.99 * t_min), min(space.t_high, 1.01 * t_max)
    if view.face is not None:  # the lens's range is along other rays
        t_low, t_high = space.t_low, space.t_high
        block["plane"], block["unit"] = view.face.plane, view.face.unit
    low, high = (int(np.float32(t).view(np.int32)) for t in (t_low, max(t_high, 2 * t_low)))
    block["depth_low"], block["depth_scale"] = low, 1 / (high - low)
    block["background"], block["ambient"] = flat.background, flat.ambient
    block["light_count"] = len(flat.lights)
    return block


def plane_bases(flat: FlatScene, setup: SceneSetup, space: ImageSpace) -> Floats:
    """Return matrices (objects, 4, 4) whose columns multiply an object's planes.

    The products are those with step_x, step_y, direction, and the point where the ray through the
    image's centre starts.
    """
    bases = np.zeros((len(flat.materials), 4, 4))
    directions = np.array((space.step_x, space.step_y, space.direction)).T
    bases[:, :3, :3] = setup.object_from_world @ directions
    from_place = space.eye + space.across - flat.world_from_object[:, :3, 3]
    start = np.einsum("nij,nj->ni", setup.object_from_world, from_place)
    bases[:, :3, 3] = start - setup.middles
    bases[:, 3, 3] = 1.0
    return bases


def triangle_rows(
    flat: FlatScene,
    setup: SceneSetup,
    bases: Floats,
    is_parallel: bool,
    out: NDArray,
    first: int = 0,
) -> None:
    """Store the coefficients (c0, c1, c2) of triangles in out, float32 (m, 3).

    They start at triangle `first`, and fill all of out. bases: from plane_bases().

    t (parallel) or 1/t (perspective) of the ray of pixel (x, y) is c0 * x + c1 * y + c2. A triangle
    that is edge-on, degenerate, or shows an invisible back gets (0, 0, -1), which is behind the
    eye.
    """
    columns, divisor = ((0, 1, 3), 2) if is_parallel else ((0, 1, 2), 3)
    for start in range(0, len(out), BLOCK):
        rows = out[start : start + BLOCK]
        products = _products(flat, setup, bases, first + start, first + start + len(rows))
        with np.errstate(all="ignore"):
            scale = -products[:, divisor]
            for k, column in enumerate(columns):
                np.divide(products[:, column], scale, out=rows[:, k], casting="same_kind")
            size = np.abs(rows[:, 0]) + np.abs(rows[:, 1]) + np.abs(rows[:, 2])
        is_unseen = ~(size < 1e30)
        if flat.single_sided.any():
            # A back is hit if the ray goes along the normal, or the eye is behind the plane.
            is_back = scale < 0 if is_parallel else scale > 0
            owners = flat.face_object[first + start : first + start + len(rows)]
            is_unseen |= is_back & (flat.single_sided[owners] > 0)
        rows[is_unseen] = 0, 0, -1


def _products(flat: FlatScene, setup: SceneSetup, bases: Floats, first: int, last: int) -> Floats:
    """Return the planes of the triangles from first up to last, times their objects' bases."""
    planes, owners = setup.planes[first:last], flat.face_object[first:last]
    lowest, highest = owners[0], owners[-1]
    if highest - lowest >= FEW_OBJECTS:
        each: Floats = np.einsum("ni,nij->nj", planes, bases[owners])
        return each
    products = np.empty(planes.shape)
    starts = np.searchsorted(owners, np.arange(lowest, highest + 2))
    for number, (low, high) in enumerate(pairwise(starts), lowest):
        np.matmul(planes[low:high], bases[number], out=products[low:high])
    return products


def object_rows(flat: FlatScene, setup: SceneSetup, space: ImageSpace) -> NDArray[np.float32]:
    """Return rows (objects, OBJECT_TEXELS, 4): each object's transforms, and its material, with the
    checker's map relative to the anchor.
    """
    rows = setup.object_rows.copy()
    linear, place = flat.world_from_object[:, :3, :3], flat.world_from_object[:, :3, 3]
    from_eye = place - space.eye
    eye = np.einsum("nij,nj->ni", setup.object_from_world, -from_eye)
    # Round the anchor first, so that the difference from a vertex has no other rounding.
    low, high = flat.object_bounds[:, 0], flat.object_bounds[:, 1]
    rows[:, ROW_INSIDE, :3] = np.minimum(np.maximum(eye, low), high)
    rows[:, ROW_INSIDE, 3] = space.near
    turned = np.einsum("nij,nj->ni", linear, rows[:, ROW_INSIDE, :3].astype(np.float64))
    rows[:, ROW_ANCHOR, :3] = space.at(turned + from_eye)
    rows[:, ROW_FROM_NEAR, :3] = turned + (place - space.near_point)
    rows[:, ROW_IMAGE : ROW_IMAGE + 3, :3] = space.image_from_world[:, :3] @ linear
    cell = np.einsum("nij,nj->ni", flat.cells[:, :, :3], turned + place) + flat.cells[:, :, 3]
    # Cells repeat with period 2, so subtract even integers to keep the digits of the rest.
    rows[:, ROW_CELLS:, 3] = cell - 2 * np.floor(cell / 2)
    return rows


def light_rows(flat: FlatScene, space: ImageSpace) -> NDArray[np.float32]:
    """Return FlatScene.lights, (lights, 2, 4), with points relative to the scene's near point."""
    return lights_from(flat, space.near_point)


def sphere_rows(flat: FlatScene, space: ImageSpace, objects: NDArray) -> NDArray[np.float32]:
    """Return rows (spheres, SPHERE_TEXELS, 4).

    The texels are: centre in image coordinates, radius | c, from the centre to the origin of the
    ray through the image's centre, |c|^2 - radius^2 | from the object's anchor to the centre, the
    object's number. objects: from object_rows().
    """
    rows = np.zeros((len(flat.spheres), SPHERE_TEXELS, 4), np.float32)
    to_center, radius = flat.spheres[:, :3] - space.eye, flat.spheres[:, 3]
    rows[:, 0, :3] = space.at(to_center)
    rows[:, 0, 3] = radius
    from_center = space.across - to_center
    rows[:, 1, :3] = from_center
    distance = np.sqrt((from_center * from_center).sum(axis=1))
    rows[:, 1, 3] = (distance - radius) * (distance + radius)
    rows[:, 2, :3] = -objects[flat.sphere_object, ROW_INSIDE, :3]
    rows[:, 2, 3] = flat.sphere_object
    return rows


class _Fitted(NamedTuple):
    near: Floats
    t_low: float
    t_high: float
    box: tuple[float, float]


def _fitted(t_min: Floats, t_max: Floats, is_seen: NDArray[np.bool_]) -> _Fitted:
    """Return clip ranges as ray parameters, with a margin, so that clipping is never visible.

    near: near planes of objects (perspective). box: near and far of everything (parallel). t_low,
    t_high: as in ImageSpace. t_min, t_max: the objects' (objects,). is_seen: False for hidden
    objects.
    """
    ahead = (t_max > 0) & is_seen
    if not ahead.any():
        return _Fitted(np.ones(len(t_max)), TINY, 2 * TINY, (1.0, 2.0))
    least = np.where(ahead, np.maximum(NEAREST * t_max, TINY), 1.0)
    lowest, highest = float(t_min[is_seen].min()), float(t_max[is_seen].max())
    span = max(highest - lowest, 1e-3 * max(abs(lowest), abs(highest)), TINY)
    return _Fitted(
        near=np.maximum(t_min / 2, least),
        t_low=float(np.maximum(0.99 * t_min, least)[ahead].min()),
        t_high=max(1.01 * highest, TINY),
        box=(lowest - span, highest + span),
    )
