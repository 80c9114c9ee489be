"""The camera for packets: image points in pixels, and rows for each instance.

The numbers are derived in float64.

Image points are (x, y) in pixels from the image's centre, y downwards: the pixel of row i and
column j has its centre at (j + 1/2 - width / 2, i + 1/2 - height / 2), exact in float32. A point p
has the camera coordinates (X, Y, Z), affine in p, such that

    Z is the ray parameter t, over `scale`;
    perspective: p is seen at (X / Z, Y / Z);   parallel: p is seen at (X, Y).

With H = Z in perspective and H = 1 in parallel projection, (X, Y, H) are homogeneous coordinates of
the image point in both projections. The key K, 1 / Z in perspective and -Z in parallel projection,
is largest at the nearest hit, and on a plane it is an affine function of (x, y).

An instance only needs other rows: camera_from_object = camera_from_world world_from_object.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.trace.arguments.image import Rows
from lucida.renderer.trace.arguments.view import KernelView
from lucida.renderer.trace.bvh.instances import IS_SINGLE_SIDED, Instances

from .cells import Cells, are_blurred
from .lens_table import LensTable

# A space's numbers: an origin o near the eye; a row (a, b, c, d) of the affine map
# a (p - o)_x + b (p - o)_y + c (p - o)_z + d for each of X, Y and Z; the largest coordinate of p -
# o.
ORIGIN, ROW_X, ROW_Y, ROW_Z, EXTENT, ROWS = 0, 3, 7, 11, 15, 16

# The rays: direction (perspective) or origin (parallel) at the image's centre, and its steps per
# pixel to the right and down; then the other one, which all pixels share.
VARYING, ACROSS, DOWN, SHARED = np.array([0, 3, 6, 9])

# float32 has digits for this many pixels, which limits three roundings to 1/300 of a pixel. The
# corners of a space whose image would be larger are transformed in float64.
_FLOAT32_PX = 16384.0
_SLACK_PX = 1e-2  # around the outlines of spheres
# The relative error of a packet's t, a few units in float32's last place. It may move a hit along
# its ray by at most this many pixels, or this part of the scene's size.
_T_ROUNDING = 2.0**-22
_HIT_PX, _HIT_OF_SCENE = 1 / 512, 2.0**-17


class PacketView(NamedTuple):
    """The camera's numbers; see the module. Spaces are the instances', then the world's.

    left, above: float64, the image point of the first pixel's corner. width, height: of the traced
        pixels, which may be some rows of the image.
    slack_px: margin of tiles, against rounding, in tests that only reject.
    key_near, key_far: bounds of hits' K; z_near, z_far: the same bounds as Z. scale: t / Z.
    coarse: True if float32 is too coarse for hits (refine.py).
    rows: float32, ROWS a space; rows_exact: the same in float64. exact: uint8, 1 to use the latter.
    ray: float64, 12 numbers in world space (VARYING ...).
    near_point: float64, 3: the world's point that float32 points are relative to (near_point()).
    back: float32, for each space the sign of the volumes of invisible backs (triangle.py), or 0.
    sphere_box: float32, 4 a sphere: left, top, right, bottom of its image, or a superset.
    lens, pinhole_rows: None without a lens. With one, all numbers are those of the camera without
    it,
        and pinhole_rows is rows_exact; kernels compute each tile's numbers from these
        (lens_frame.py).
    """

    parallel: bool
    left: np.float64
    above: np.float64
    width: int
    height: int
    slack_px: np.float32
    key_far: np.float32
    key_near: np.float32
    z_far: np.float32
    z_near: np.float32
    scale: np.float64
    coarse: bool
    rows: NDArray[np.float32]
    rows_exact: NDArray[np.float64]
    exact: NDArray[np.uint8]
    ray: NDArray[np.float64]
    near_point: NDArray[np.float64]
    back: NDArray[np.float32]
    sphere_box: NDArray[np.float32]
    lens: LensTable | None
    pinhole_rows: NDArray[np.float64] | None


def packet_view(
    view: KernelView,
    rows_seen: Rows,
    instances: Instances,
    near_point: NDArray[np.float64],
    cells: Cells,
    lens: LensTable | None = None,
) -> PacketView:
    """Return the numbers for some rows of an image of a scene with these cells.

    near_point, lens: see PacketView.
    """
    width, height = rows_seen.size
    eye, u, v, back = (np.array(vector) for vector in (view.eye, view.u, view.v, view.back))
    # The steps on the image plane to the next pixel to the right, and down.
    per_px = (view.right - view.left) / width, (view.bottom - view.top) / height
    middle = (view.left + view.right) / 2, (view.bottom + view.top) / 2

    # Rows of (x, y, t) for points relative to the eye, in units of u and v.
    to_x, to_y, to_t = np.linalg.inv(np.array([u, v, -back]).T)
    linear = np.array([to_x / per_px[0], to_y / per_px[1], to_t])
    shift = np.array([-middle[0] / per_px[0], -middle[1] / per_px[1], 0.0])
    if not view.parallel:
        linear[:2] += shift[:2, None] * to_t
        shift[:] = 0.0

    # The unit of Z: the farthest corner of the scene.
    low, high = instances.bounds[-1] + (instances.world_from_space[-1, :3, 3] - eye)
    if lens is None:
        farthest = float((abs(to_t @ (low + high)) + abs(to_t) @ (high - low)) / 2)
    else:
        farthest = float(np.linalg.norm(np.maximum(abs(low), abs(high))) / np.linalg.norm(back))
    scale = 2.0 ** math.ceil(math.log2(farthest)) if 0 < farthest < math.inf else 1.0
    linear[2] /= scale
    if not view.parallel:
        linear[:2] /= scale

    rows, is_exact = _rows(linear, shift, eye, view.parallel, instances)
    across, down = per_px[0] * u, per_px[1] * v
    center = middle[0] * u + middle[1] * v
    if view.parallel:
        ray = np.concatenate([eye + center, across, down, -back])
        keys = -view.t_max / scale, -view.t_min / scale
    else:
        ray = np.concatenate([center - back, across, down, eye])
        keys = scale / view.t_max, scale / view.t_min if view.t_min > 0 else math.inf
    with np.errstate(over="ignore"):
        return PacketView(
            parallel=view.parallel,
            left=np.float64(-0.5 * width),
            above=np.float64(rows_seen.first - 0.5 * height),
            width=width,
            height=rows_seen.end - rows_seen.first,
            slack_px=np.float32(2e-6 * max(width, height)),
            key_far=np.float32(keys[0]),
            key_near=np.float32(keys[1]),
            z_far=np.float32(view.t_max / scale),
            z_near=np.float32(view.t_min / scale),
            scale=np.float64(scale),
            coarse=_is_coarse(farthest, ray, view.parallel, instances)
            or are_blurred(cells, eye, to_t, back if view.parallel else None, _T_ROUNDING),
            rows=rows.astype(np.float32).reshape(-1),
            rows_exact=rows.reshape(-1),
            exact=is_exact,
            ray=ray,
            near_point=near_point,
            back=_backs(rows, instances),
            sphere_box=_sphere_boxes(linear, shift, eye, view.parallel, instances, lens),
            lens=lens,
            pinhole_rows=None if lens is None else rows.reshape(-1),
        )


def _rows(
    linear: NDArray[np.float64],
    shift: NDArray[np.float64],
    eye: NDArray[np.float64],
    parallel: bool,
    instances: Instances,
) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """Return ROWS numbers for each space, (n, ROWS), and a mask of spaces that need float64."""
    matrix, bounds = instances.world_from_space, instances.bounds
    to_eye = eye - matrix[:, :3, 3]
    eye_in_space = np.linalg.solve(matrix[:, :3, :3], to_eye[..., None])[..., 0]
    # Differences from a point near the eye keep the digits that matter most.
    nearest = np.minimum(np.maximum(eye_in_space, bounds[:, 0]), bounds[:, 1])
    origin = nearest.astype(np.float32).astype(float)
    rows = np.empty((len(matrix), ROWS))
    rows[:, ORIGIN:ROW_X] = origin
    part = rows[:, ROW_X:EXTENT].reshape(-1, 3, 4)
    part[..., :3] = linear @ matrix[:, :3, :3]
    from_eye = (matrix[:, :3, :3] @ origin[..., None])[..., 0] - to_eye
    part[..., 3] = from_eye @ linear.T + shift
    reach = np.maximum(bounds[:, 1] - origin, origin - bounds[:, 0])
    rows[:, EXTENT] = reach.max(1)
    # The size of the space's extent in pixels, at its nearest.
    lengths = np.linalg.norm(part[..., :3], axis=-1)
    pixels = lengths[:, :2].max(1)
    extent = np.linalg.norm(reach, axis=-1)
    if parallel:
        pixels = pixels * extent
    else:
        far = np.linalg.norm(origin - eye_in_space, axis=-1)
        pixels = (
            pixels
            / lengths[:, 2]
            * np.divide(extent, far, out=np.ones_like(far), where=far > extent)
        )
    return rows, (pixels > _FLOAT32_PX).astype(np.uint8)


def _backs(rows: NDArray[np.float64], instances: Instances) -> NDArray[np.float32]:
    """Return PacketView.back.

    The instance's own space decides the front, even if it is mirrored.
    """
    is_single = np.append(instances.world.attributes & IS_SINGLE_SIDED > 0, False)
    linear = rows[:, ROW_X:EXTENT].reshape(-1, 3, 4)[..., :3]
    return (is_single * np.sign(np.linalg.det(linear))).astype(np.float32)


def _is_coarse(
    farthest: float, ray: NDArray[np.float64], parallel: bool, instances: Instances
) -> bool:
    """Return True if float32 is too coarse for t. farthest: the largest t. ray: PacketView's."""
    numbers = ray.tolist()
    across, down, direction = (
        math.hypot(*numbers[at : at + 3]) for at in (ACROSS, DOWN, SHARED if parallel else VARYING)
    )
    away = _T_ROUNDING * farthest * direction
    pixel = min(across, down) * (1.0 if parallel else farthest)
    size = math.dist(*instances.bounds[-1].tolist())
    return away > min(_HIT_PX * pixel, _HIT_OF_SCENE * size)


def _sphere_boxes(
    linear: NDArray[np.float64],
    shift: NDArray[np.float64],
    eye: NDArray[np.float64],
    parallel: bool,
    instances: Instances,
    lens: LensTable | None,
) -> NDArray[np.float32]:
    """Return rectangles around the spheres' images; the whole plane for one behind the eye, or with
    a lens.

    A line of the image, a x + b = 0, is a plane through the eye. It touches the sphere if its
    distance from the centre is the radius, which is a quadratic equation for the line's place.
    Source: Mara and McGuire, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere",
    2013.
    """
    spheres = instances.world.spheres.reshape(-1, 4)
    boxes = np.empty((len(spheres), 4), np.float32)
    if not len(spheres) or lens is not None:
        boxes[:] = -np.inf, -np.inf, np.inf, np.inf
        return boxes.reshape(-1)
    center = (spheres[:, :3] - eye) @ linear.T + shift
    radius = spheres[:, 3]
    for axis in range(2):
        if parallel:
            middle, half = center[:, axis], radius * np.linalg.norm(linear[axis])
        else:
            # (X - x Z)^2 = r^2 |row_X - x row_Z|^2, in powers of x.
            a = center[:, 2] ** 2 - radius**2 * (linear[2] @ linear[2])
            b = center[:, axis] * center[:, 2] - radius**2 * (linear[axis] @ linear[2])
            c = center[:, axis] ** 2 - radius**2 * (linear[axis] @ linear[axis])
            ahead = (a > 0) & (center[:, 2] > 0)
            with np.errstate(divide="ignore", invalid="ignore"):
                middle = np.where(ahead, b / a, 0)
                half = np.where(ahead, np.sqrt(np.maximum(b * b - a * c, 0)) / a, np.inf)
        with np.errstate(over="ignore"):
            boxes[:, axis] = middle - half * (1 + 1e-6) - _SLACK_PX
            boxes[:, 2 + axis] = middle + half * (1 + 1e-6) + _SLACK_PX
    return boxes.reshape(-1)
