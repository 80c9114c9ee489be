"""Triangle setup: what the shaders need to know about one camera, computed in float64.

Owns the tables that change with the camera: the camera block, and a row for each triangle, sphere
and object. Knows nothing of GL: it gives NumPy arrays, laid out as shaders/chunks reads them.

Image coordinates: a point's (x, y) in pixels from the image's centre (x right, y up), and t, the
parameter of the ray that goes through it. Perspective keeps x and y multiplied by t, so that they
are affine in the point. Pixel centres are exact in float32 in these coordinates.

float32 keeps 7 digits, so nothing large may cancel on the GPU. Each object is therefore seen from
an anchor of its own: the point of its bounding box that is nearest to the eye. A triangle's plane
meets a ray at t (parallel) or 1/t (perspective) that is affine in x and y: the three coefficients
are composed here, where N.(a - eye) may cancel without harm.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import NEAREST, Camera, Floats
from renderer.scene.flat import CELL_X, FlatScene, extent

# Anchor in image coordinates, near | anchor in the world | six rows of the material
OBJECT_TEXELS = 8
SPHERE_TEXELS = 3

FLOAT32_MAX = float(np.finfo(np.float32).max)
TINY = 1e-30
# Rows at a time. Small products stay on one thread of NumPy's BLAS: its threads wait for one
# another, which takes tens of milliseconds while the tracer has all cores.
BLOCK = 8192

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
    ]
)


class SceneSetup(NamedTuple):
    """What a scene needs once, in float64. planes (m, 4): normal and -offset, so that N.p - offset
    is 0 on the triangle. object_bounds (objects, 2, 3). vertex_object (n,): int32."""

    planes: Floats
    object_bounds: Floats
    vertex_object: NDArray[np.int32]


class ImageSpace(NamedTuple):
    """Image coordinates of one camera and size.

    image_from_world (3, 4): rows x, y (times t in perspective), t. step_x, step_y (3,): world
    vectors of one pixel to the right and up, on the plane t = 1 in perspective. origin, direction
    (3,): the ray through the image's centre. clip_z: z in clip space is clip_z[0] * t + clip_z[1],
    in perspective less twice the object's near (objects,), which is 0 in parallel projection.
    t_low, t_high: around all t > 0 of the scene that are drawn.
    """

    image_from_world: Floats
    step_x: Floats
    step_y: Floats
    origin: Floats
    direction: Floats
    clip_z: tuple[float, float]
    near: Floats
    t_low: float
    t_high: float


def scene_setup(flat: FlatScene) -> SceneSetup:
    """Planes of triangles and bounds of objects."""
    corners = [flat.vertices[flat.faces[:, k]].astype(np.float64) for k in range(3)]
    planes = np.empty((len(flat.faces), 4))
    planes[:, :3] = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    planes[:, 3] = -np.einsum("ij,ij->i", planes[:, :3], corners[0])
    bounds = np.zeros((len(flat.materials), 2, 3))
    vertex_object = np.zeros(len(flat.vertices), np.int32)
    for number, (first, count) in enumerate(flat.object_faces):
        sphere = flat.object_sphere[number]
        if sphere >= 0:
            center, radius = flat.spheres[sphere, :3], flat.spheres[sphere, 3]
            bounds[number] = center - radius, center + radius
        elif count:
            # An object's vertices lie together (flat.py).
            faces = flat.faces[first : first + count]
            mine = slice(faces.min(), faces.max() + 1)
            vertex_object[mine] = number
            bounds[number] = extent(flat.vertices[mine])
    return SceneSetup(planes, bounds, vertex_object)


def image_space(camera: Camera, size: tuple[int, int], bounds: Floats) -> ImageSpace:
    """Image coordinates of `camera` for an image of (width, height). bounds: the objects'
    (SceneSetup)."""
    width, height = size
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    u, v, w = (np.asarray(vector) for vector in (camera.u, camera.v, camera.w))
    eye, across = np.asarray(camera.eye), x * u + y * v
    unit = 1.0 if camera.is_parallel else camera.distance
    camera_from_world = camera.camera_from_world
    t_row = -camera_from_world[2] / unit
    middle = bounds.mean(axis=1) @ t_row[:3] + t_row[3]
    half = (bounds[:, 1] - bounds[:, 0]) / 2 @ np.abs(t_row[:3])
    fitted = _fitted(middle - half, middle + half)
    clip_near, clip_far = (1.0, 2.0) if not camera.is_parallel else fitted.box
    clip_from_camera = camera.clip_from_camera(clip_near * unit, clip_far * unit)
    clip = clip_from_camera @ camera_from_world / unit
    clip_z = (-clip_from_camera[2, 2], clip_from_camera[2, 3] / unit)
    return ImageSpace(
        image_from_world=np.stack([clip[0] * width / 2, clip[1] * height / 2, t_row]),
        step_x=(right - left) / width * u,
        step_y=(top - bottom) / height * v,
        origin=eye + across if camera.is_parallel else eye,
        direction=-w if camera.is_parallel else across - camera.distance * w,
        clip_z=clip_z if camera.is_parallel else (1.0, 0.0),
        near=np.zeros(len(bounds)) if camera.is_parallel else fitted.near,
        t_low=fitted.t_low,
        t_high=fitted.t_high,
    )


def camera_block(
    camera: Camera,
    size: tuple[int, int],
    margin: tuple[int, int],
    space: ImageSpace,
    flat: FlatScene,
) -> NDArray:
    """The uniform block of shaders/chunks/camera.glsl, one element of CAMERA_BLOCK. margin: how far
    the viewport reaches beyond the image on each side, (horizontally, vertically) in pixels."""
    block = np.zeros((), CAMERA_BLOCK)
    block["image_from_world"] = _columns(space.image_from_world[:, :3])
    block["step_x"], block["step_y"] = space.step_x, space.step_y
    block["direction"] = space.direction
    block["perspective"] = not camera.is_parallel
    block["half_size"] = size[0] / 2, size[1] / 2
    block["t_range"] = np.minimum(camera.t_range, FLOAT32_MAX)
    block["clip_half"] = size[0] / 2 + margin[0], size[1] / 2 + margin[1]
    block["clip_z"] = space.clip_z
    # Depth is a number's place among the floats between t_low and t_high, a piecewise linear
    # logarithm: 24 bits then resolve t to a part in a million everywhere.
    t_min, t_max = camera.t_range
    t_low, t_high = max(space.t_low, 0.99 * t_min), min(space.t_high, 1.01 * t_max)
    low, high = (int(np.float32(t).view(np.int32)) for t in (t_low, max(t_high, 2 * t_low)))
    block["depth_low"], block["depth_scale"] = low, 1 / (high - low)
    block["background"], block["ambient"] = flat.background, flat.ambient
    block["light_count"] = len(flat.lights)
    return block


def triangle_rows(planes: Floats, space: ImageSpace, is_parallel: bool, out: NDArray) -> None:
    """Coefficients (c0, c1, c2) of each triangle, into out, float32 (m, 3).

    t (parallel) or 1/t (perspective) of the ray of pixel (x, y) is c0 * x + c1 * y + c2. A triangle
    that is seen edge on, or is none, gets (0, 0, -1): it lies behind the eye.
    """
    basis = np.zeros((4, 4))
    basis[:3, 0], basis[:3, 1], basis[:3, 2] = space.step_x, space.step_y, space.direction
    basis[:, 3] = *space.origin, 1.0
    columns, divisor = ((0, 1, 3), 2) if is_parallel else ((0, 1, 2), 3)
    for start in range(0, len(planes), BLOCK):
        products = planes[start : start + BLOCK] @ basis
        rows = out[start : start + BLOCK]
        with np.errstate(all="ignore"):
            scale = -products[:, divisor]
            for k, column in enumerate(columns):
                np.divide(products[:, column], scale, out=rows[:, k], casting="same_kind")
            size = np.abs(rows[:, 0]) + np.abs(rows[:, 1]) + np.abs(rows[:, 2])
        rows[~(size < 1e30)] = 0, 0, -1


def object_rows(
    flat: FlatScene, setup: SceneSetup, camera: Camera, space: ImageSpace
) -> NDArray[np.float32]:
    """(objects, OBJECT_TEXELS, 4): each object's anchor, and its material with the checker's map
    taken relative to the anchor."""
    rows = np.zeros((len(flat.materials), OBJECT_TEXELS, 4), np.float32)
    low, high = setup.object_bounds[:, 0], setup.object_bounds[:, 1]
    anchor = np.clip(np.asarray(camera.eye), low, high).astype(np.float32)
    world = anchor.astype(np.float64)
    rows[:, 0, :3] = world @ space.image_from_world[:, :3].T + space.image_from_world[:, 3]
    rows[:, 0, 3] = space.near
    rows[:, 1, :3] = anchor
    rows[:, 2:] = flat.materials
    cells = flat.materials[:, CELL_X:].astype(np.float64)
    moved = np.einsum("nij,nj->ni", cells[:, :, :3], world) + cells[:, :, 3]
    # Cells repeat by twos: what is whole and even may go, so that the rest keeps its digits.
    rows[:, 2 + CELL_X :, 3] = moved - 2 * np.floor(moved / 2)
    return rows


def sphere_rows(flat: FlatScene, space: ImageSpace, objects: NDArray) -> NDArray[np.float32]:
    """(spheres, SPHERE_TEXELS, 4): centre in image coordinates, radius | from the centre to the
    origin of the ray through the image's centre, |that|^2 - radius^2 | from the object's anchor to
    the centre, the object's number. objects: from object_rows()."""
    rows = np.zeros((len(flat.spheres), SPHERE_TEXELS, 4), np.float32)
    center, radius = flat.spheres[:, :3].astype(np.float64), flat.spheres[:, 3].astype(np.float64)
    rows[:, 0, :3] = center @ space.image_from_world[:, :3].T + space.image_from_world[:, 3]
    rows[:, 0, 3] = radius
    from_center = space.origin - center
    rows[:, 1, :3] = from_center
    distance = np.linalg.norm(from_center, axis=1)
    rows[:, 1, 3] = (distance - radius) * (distance + radius)
    rows[:, 2, :3] = center - objects[flat.sphere_object, 1, :3]
    rows[:, 2, 3] = flat.sphere_object
    return rows


class _Fitted(NamedTuple):
    near: Floats
    t_low: float
    t_high: float
    box: tuple[float, float]


def _fitted(t_min: Floats, t_max: Floats) -> _Fitted:
    """As ray parameters: near planes of objects (perspective), near and far of all (parallel),
    t_low and t_high; generously around what is to be seen, so that clipping by them never shows.

    t_min, t_max: the objects' (objects,).
    """
    ahead = t_max > 0
    if not ahead.any():
        return _Fitted(np.ones(len(t_max)), TINY, 2 * TINY, (1.0, 2.0))
    least = np.where(ahead, np.maximum(NEAREST * t_max, TINY), 1.0)
    lowest, highest = float(t_min.min()), float(t_max.max())
    span = max(highest - lowest, 1e-3 * max(abs(lowest), abs(highest)), TINY)
    return _Fitted(
        near=np.maximum(t_min / 2, least),
        t_low=float(np.maximum(0.99 * t_min, least)[ahead].min()),
        t_high=max(1.01 * highest, TINY),
        box=(lowest - span, highest + span),
    )


def _columns(matrix: Floats) -> NDArray[np.float32]:
    """A 3 x 3 matrix as std140 wants it: column by column, each padded to four floats."""
    padded = np.zeros((3, 4), np.float32)
    padded[:, :3] = matrix.T
    return padded
