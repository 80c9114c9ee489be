"""Every way to read a matrix as a camera: its direction, its storage order, and the camera's axes.

This includes the camera of each reading, and why others are impossible. Pure. ranking.py rates the
readings, writing.py writes them down.

A pose is rigid: world_from_camera or camera_from_world, of a camera whose own axes differ from
program to program. Otherwise 12 numbers are P = K [R | t], and 16 are clip_from_world, the product
of a projection and a view. A reading whose picture would be mirrored is rejected: each program
shows the world as it is.

Sources: Hartley and Zisserman, Multiple View Geometry, "Camera models" (P, and its decomposition);
the OpenGL 3.3 core specification, "Coordinate transformations" (clip space).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Literal

import numpy as np

from app.detective.printed import Pasted, is_rotation
from renderer.camera import Camera, Floats, Size
from renderer.errors import LucidaError
from renderer.frame import check_size
from renderer.intrinsics import PixelOrigin, decomposed
from renderer.scene.model import View

Way = Literal["camera-to-world", "world-to-camera", "P = K [R | t]", "clip from world"]
Up = Literal["y", "z"]

# The camera's own axes: where its x, y, z point, as signs of right, up and back.
AXES: dict[str, tuple[int, int, int]] = {
    "OpenGL": (1, 1, 1),
    "OpenCV": (1, -1, -1),
    "PyTorch3D": (-1, 1, -1),
    "Direct3D": (1, 1, -1),
}
# From a world in which another axis is up to the scene's, which has y or z up.
TURNS: dict[Up, Floats] = {
    "y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "z": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
}
OTHER: dict[Up, Up] = {"y": "z", "z": "y"}
MIRRORED = "shows the scene mirrored"  # why a reading is left out
# From the pixel with integer coordinates 0 to the first pixel's corner.
OFFSET: dict[PixelOrigin, float] = {"center": 0.5, "corner": 0.0}
LAST_ROW = 1e-5  # error of 0 0 0 1, relative to the largest number
SKEW = 0.05  # of fx: the largest skew in a K that was computed
PARALLEL_ROWS = 1e-3  # sine of the angle between parallel rows
SAME = 1e-9  # of rays that differ by less, cameras are one


@dataclass(frozen=True)
class Convention:
    """A way to read a matrix.

    columns: it is in the text column by column, or is meant for row vectors.
    axes: of AXES, "" if the matrix has the image's own.
    turned: its world has the other axis up, not the scene's.
    flipped: the image's y points down (Vulkan).
    """

    way: Way
    columns: bool
    axes: str = ""
    turned: bool = False
    flipped: bool = False


@dataclass(frozen=True, eq=False)
class MatrixReading:
    """A reading of a matrix.

    view: the camera, and whether its viewport is fitted to the image.
    also: other conventions that make exactly the same camera.
    size: of the image whose pixels K counts, or None.
    """

    convention: Convention
    view: View
    also: tuple[Convention, ...] = ()
    size: Size | None = None


@dataclass(frozen=True, eq=False)
class Readings:
    """The readings of a matrix. left_out: the impossible ones, with the reason, a line each."""

    found: tuple[MatrixReading, ...]
    left_out: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class ReadAs:
    """The input of readings besides the matrix.

    now: the current view, for what the matrix leaves open.
    up: of the scene.
    images: the size of the window's images.
    """

    now: View
    up: Up = "y"
    pixel_origin: PixelOrigin = "center"
    images: Size = (4, 3)


@dataclass
class _Gathered:
    found: list[MatrixReading] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)


def up_of(view: View) -> Up:
    """Return the up axis of a scene, from its own camera: that axis points upwards in its picture,
    with a level horizon.
    """
    camera = view.camera
    u, v = np.asarray(camera.u), np.asarray(camera.v)
    u, v = u / np.linalg.norm(u), v / np.linalg.norm(v)
    level = [abs(float(u[axis])) < LAST_ROW for axis in (1, 2)]
    if level[0] != level[1]:
        return "y" if level[0] else "z"
    return "z" if v[2] > v[1] else "y"


def order_name(columns: bool) -> str:
    return "by columns" if columns else "by rows"


def readings(given: Pasted, around: ReadAs) -> Readings:
    """Return all readings of a matrix; those that make the same camera are merged. There may be
    none: left_out then has the reasons.
    """
    gathered = _Gathered()
    for columns in (False, True):
        if reason := _read(given, columns, around, gathered):
            gathered.left_out[order_name(columns)] = reason
    if any(reading.convention.axes for reading in gathered.found):  # a pose, not a product
        gathered.found = [one for one in gathered.found if one.convention.axes]
    return Readings(merged(gathered.found), tuple(gathered.left_out.items()))


def _read(given: Pasted, columns: bool, around: ReadAs, gathered: _Gathered) -> str:
    """Add the readings in one order. Return the reason if there are none."""
    matrix = as_rows(given, columns)
    affine, rest = matrix[:3], matrix[3:]
    reason, size, flipped = "", None, False
    way: Way = "clip from world"
    if len(rest) and np.abs(rest[0] - (0, 0, 0, 1)).max() > LAST_ROW * np.abs(matrix).max():
        reason = f"the last row is {_row(rest[0])}, not (0, 0, 0, 1)"
    elif is_rotation(affine[:, :3]):
        _add_poses(affine, given, columns, around, gathered)
        return ""
    try:
        if reason:
            camera, flipped = _from_product(matrix)
        elif len(rest) and _is_square(affine[:, :3]):
            camera, flipped = _from_parallel(matrix)
        else:
            way = "P = K [R | t]"
            camera, size = _from_p(affine, given.size, around)
    except (LucidaError, np.linalg.LinAlgError) as error:
        if isinstance(error, LucidaError) and not reason:
            reason = f"{error.field}: {error.problem}"
        return reason or "the 3 x 3 part is no rotation"
    for turned in (False, True):
        seen = _turned(camera, TURNS[around.up]) if turned else camera
        convention = Convention(way, columns, "", turned, flipped)
        gathered.found.append(MatrixReading(convention, View(seen, fit=True), size=size))
    return ""


def _turned(camera: Camera, turn: Floats) -> Camera:
    eye, u, v, w = ((turn @ part).tolist() for part in (camera.eye, camera.u, camera.v, camera.w))
    return replace(camera, eye=eye, u=u, v=v, w=w)


def as_rows(given: Pasted, columns: bool) -> Floats:
    """Return (3, 4) or (4, 4), for column vectors. With R and t, only R may be stored by
    columns.
    """
    numbers = given.numbers
    if given.t is not None:
        rotation = numbers.reshape(3, 3)
        return np.column_stack([rotation.T if columns else rotation, given.t])
    return numbers.reshape(4, -1).T if columns else numbers.reshape(-1, 4)


# Poses.


def _add_poses(
    affine: Floats, given: Pasted, columns: bool, around: ReadAs, gathered: _Gathered
) -> None:
    ways: tuple[Way, ...] = ("camera-to-world", "world-to-camera")
    for way, turned, axes in product(ways, (False, True), AXES):
        convention = Convention(way, columns, axes, turned)
        pose = world_from_camera(affine, convention, around.up)
        if np.linalg.det(pose[:, :3]) < 0:
            gathered.left_out[f"{way}, {order_name(columns)}, {axes} axes"] = MIRRORED
            continue
        view, size = _posed(pose, given, around)
        gathered.found.append(MatrixReading(convention, view, size=size))


def world_from_camera(affine: Floats, convention: Convention, up: Up) -> Floats:
    """Return the pose (3, 4) of the camera whose axes point right, up and back, from a rigid
    matrix.
    """
    pose = np.vstack([affine, (0, 0, 0, 1)])
    if convention.way == "world-to-camera":
        pose = np.linalg.inv(pose)
    pose = pose[:3] * (*AXES[convention.axes], 1)
    pose[:, :3] /= scale_of(pose)
    return TURNS[up] @ pose if convention.turned else pose


def scale_of(pose: Floats) -> float:
    """Return the length of its axes, which is no part of a camera; 1 if it differs only by
    rounding.
    """
    scale = float(abs(np.linalg.det(pose[:, :3]))) ** (1 / 3)
    return scale if abs(scale - 1) > LAST_ROW * 100 else 1.0


def _posed(pose: Floats, given: Pasted, around: ReadAs) -> tuple[View, Size | None]:
    if given.K is not None:
        size = size_for(given.K, given.size, around)
        camera = Camera.from_intrinsics(
            given.K,
            world_from_camera=pose,
            size=size,
            axes="opengl",
            pixel_origin=around.pixel_origin,
        )
        return View(camera, fit=True), size
    u, v, w, eye = pose.T.tolist()
    now = around.now
    return View(replace(now.camera, eye=eye, u=u, v=v, w=w), now.fit), None


def size_for(k: Floats, size: Size | None, around: ReadAs) -> Size:
    """Return the size of K's image: the given one, else the even one whose middle is nearest to K's
    principal point, else that of the window's images.
    """
    if size is not None:
        return size
    offset = OFFSET[around.pixel_origin]
    width, height = (2 * round((2 * float(middle) + offset) / 2) for middle in k[:2, 2])
    try:
        return check_size((width, height))
    except LucidaError:
        return around.images


# Projections with a pose in them.


def _from_p(affine: Floats, size: Size | None, around: ReadAs) -> tuple[Camera, Size]:
    """Read P = K [R | t], which is known up to a factor. Raises LucidaError, LinAlgError."""
    eye = -np.linalg.solve(affine[:, :3], affine[:, 3])
    sign = np.sign(np.linalg.det(affine[:, :3]))
    offset, origin = OFFSET[around.pixel_origin], around.pixel_origin
    shift = np.array([[1, 0, -offset], [0, 1, -offset], [0, 0, 1]])
    k, rotation, t = decomposed(np.linalg.inv(sign * affine[:, :3]) @ shift, eye, origin)
    if abs(k[0, 1]) > SKEW * abs(k[0, 0]):
        raise LucidaError("K", f"would have a skew of {k[0, 1]:.3g}, fx = {k[0, 0]:.3g}", "")
    if not 0.1 < k[0, 0] / k[1, 1] < 10:
        raise LucidaError("K", f"would have fx = {k[0, 0]:.3g}, fy = {k[1, 1]:.3g}", "")
    size, pose = size_for(k, size, around), np.column_stack([rotation, t])
    return Camera.from_intrinsics(k, camera_from_world=pose, size=size, pixel_origin=origin), size


def _from_product(matrix: Floats) -> tuple[Camera, bool]:
    """Read clip_from_world, in perspective. Return True if the image's y points down.

    Raises LucidaError, LinAlgError.
    """
    rows = matrix[[0, 1, 3], :3]
    depth = np.cross(matrix[2, :3], matrix[3, :3])
    lengths = np.linalg.norm(matrix[2, :3]) * np.linalg.norm(matrix[3, :3])
    if np.linalg.norm(depth) > PARALLEL_ROWS * max(float(lengths), LAST_ROW):
        raise LucidaError("", "is no projection", "")
    eye = -np.linalg.solve(rows, matrix[[0, 1, 3], 3])
    flipped = bool(np.linalg.det(rows) > 0)
    if flipped:
        rows = rows * [[1], [-1], [1]]
    # In an image of 2 x 2 pixels, clip space's -1 to 1 is 0 to 2.
    clip_from_corner = np.array([[1.0, 0, -1], [0, -1, 1], [0, 0, 1]])
    k, rotation, t = decomposed(np.linalg.inv(rows) @ clip_from_corner, eye, "corner")
    if abs(k[0, 1]) > SKEW * abs(k[0, 0]):
        raise LucidaError("", "is no projection: it is skewed", "")
    pose = np.column_stack([rotation, t])
    camera = Camera.from_intrinsics(k, camera_from_world=pose, size=(2, 2), pixel_origin="corner")
    return camera, flipped


def _is_square(linear: Floats) -> bool:
    """Return True if its rows are at right angles, of any lengths."""
    lengths = np.linalg.norm(linear, axis=1, keepdims=True)
    return bool(lengths.min() > 0) and is_rotation(linear / np.maximum(lengths, 1e-300))


def _from_parallel(matrix: Floats) -> tuple[Camera, bool]:
    """Read clip_from_world with parallel rays, which start where clip space does. Return True if
    the image's y points down.
    """
    across, up, along, middle = np.linalg.inv(matrix)[:3].T
    flipped = bool(np.linalg.det([across, up, -along]) < 0)
    half = float(np.linalg.norm(across)), float(np.linalg.norm(up))
    axes = across / half[0], (-up if flipped else up) / half[1], -along / np.linalg.norm(along)
    eye, u, v, w = (one.tolist() for one in (middle - along, *axes))
    viewport = (-half[0], half[0], -half[1], half[1])
    return Camera(eye, u, v, w, viewport=viewport, projection="parallel"), flipped


def merged(found: Sequence[MatrixReading]) -> tuple[MatrixReading, ...]:
    """Merge readings that make the same camera: keep the first, with the others' names."""
    kept: list[MatrixReading] = []
    for reading in found:
        for number, other in enumerate(kept):
            if is_same(reading.view.camera, other.view.camera):
                kept[number] = replace(other, also=(*other.also, reading.convention))
                break
        else:
            kept.append(reading)
    return tuple(kept)


def is_same(a: Camera, b: Camera) -> bool:
    """Return True if two cameras have the same rays, except for rounding."""
    one, other = (camera.ray([0, 0, 2], [0, 2, 0], (3, 3)) for camera in (a, b))
    size = 1.0 + float(np.abs(np.asarray(a.eye)).max())
    apart = np.abs(one.origin - other.origin).max() / size
    return bool(max(apart, np.abs(one.direction - other.direction).max()) < SAME)


def _row(row: Floats) -> str:
    return "(" + ", ".join(f"{number:.3g}" for number in row) + ")"
