"""The parts of a model file, repaired into valid meshes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.camera.checks import LARGEST
from lucida.renderer.images.display import from_srgb
from lucida.renderer.scene.boxes import extent
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import BRIGHTEST, Mesh
from lucida.renderer.scene.normals import merge_positions, smooth_normals
from lucida.renderer.system.errors import LucidaError

from .polygons import check_corners

NEEDLE = 1e-9  # height over longest side below which a triangle has no visible area
SMALLEST_AREA = 1e-18  # its square must not vanish in the renderers' float32
LARGEST_UV = 1e6  # times an image; float32 cannot resolve it beyond that
FAR = 16.0  # times its own size; a mesh farther from the file's origin gets its own
SPREAD = (5, 50, 95)  # percentiles of a mesh's vertices, so that a few stray ones do not count


@dataclass(frozen=True, eq=False)
class Part:
    """One geometry of a model file, as read.

    vertices (n, 3). faces (m, 3). normals (n, 3) or None. colors (n, 3), linear, or None. material:
    None if the file has none. uv (n, 2), v up, or None; only if a texture needs them. has_backs:
    keep a face that repeats another one with opposite winding, because each is visible from its
    side if the material is single-sided.
    """

    name: str
    vertices: Any
    faces: Any
    normals: Any = None
    colors: Any = None
    material: Material | None = None
    uv: Any = None
    has_backs: bool = False


def build_mesh(part: Part) -> Mesh | None:
    """Return the part as a mesh; None if no triangle with an area is left.

    Faces without area are dropped, and so are faces that repeat
    another's three positions (both would be hit at the same distance), and vertices that no face
    uses. Without usable normals in the file, they are computed, smooth up to CREASE_DEG. A mesh
    that is small compared with its coordinates (a map's, a plant's) gets its own origin, from which
    they are float32, and a transform to its place. Raises LucidaError if a face uses a vertex that
    does not exist, or one that is NaN or infinite.
    """
    faces, count = np.asarray(part.faces, np.int64), len(part.vertices)
    vertices = _rows(part.vertices, count, 3)
    if not len(faces) or vertices is None or not count:
        return None
    check_corners(faces.reshape(-1), count)
    given = (part.normals, 3), (part.colors, 3), (part.uv, 2)
    normals, colors, uv = (_rows(rows, count, width) for rows, width in given)
    if count > 3 * len(faces):  # parts may share a list of vertices
        source, faces = used_vertices(faces)
        vertices, normals, colors, uv = _taken(source, vertices, normals, colors, uv)
    if uv is not None:
        uv = np.where(np.abs(uv) <= LARGEST_UV, uv, 0.0).astype(np.float32)  # 0 for NaN, too
    _check_used(vertices, faces)
    origin = _own_origin(vertices, faces)
    with np.errstate(over="ignore", invalid="ignore"):  # for vertices that no face uses
        positions = (vertices - origin).astype(np.float32)
    merged = merge_positions(positions)
    keep = _visible(positions, faces, merged, part.has_backs)
    faces = faces[keep]
    if not len(faces):
        return None
    unit = _unit(normals)
    if unit is None:
        apart = colors is not None or uv is not None
        source, faces, unit = smooth_normals(positions, faces, merged, keep_apart=apart)
    else:
        source, faces = used_vertices(faces)
        unit = unit[source]
    positions, colors, uv = _taken(source, positions, colors, uv)
    transform = np.eye(4)
    transform[:3, 3] = origin
    return Mesh(positions, faces.astype(np.int32), unit, colors, transform, uv)


def _taken(which: NDArray[np.int64], *arrays: NDArray[Any] | None) -> list[Any]:
    """Return these rows of each array."""
    return [None if rows is None else rows[which] for rows in arrays]


def linear_colors(colors: ArrayLike | None, linear: bool = False) -> NDArray[np.float32] | None:
    """Return colours of a file, (n, 3) or (n, 4) of any type, as linear light (n, 3).

    Whole numbers count up to their type's largest value, other numbers to 1. linear: the file's
    colours are linear; otherwise they are sRGB.
    """
    if colors is None:
        return None
    colors = np.asarray(colors)
    with np.errstate(all="ignore"):  # numbers beyond float32
        rgb = colors[:, :3].astype(np.float32)
    if colors.dtype.kind in "ui":
        rgb /= np.float32(255 if colors.dtype.itemsize > 2 else np.iinfo(colors.dtype).max)
    elif not linear and (rgb > 1.5).any():  # written as 0 to 255 nevertheless
        rgb /= np.float32(255)
    rgb = np.nan_to_num(rgb, nan=0.0, posinf=BRIGHTEST, neginf=0.0)
    return np.clip(rgb, 0, BRIGHTEST) if linear else from_srgb(rgb)


def _rows(value: Any, count: int, width: int) -> NDArray[Any] | None:
    """Return numbers (count, width), or None if the file's have another shape, or are missing."""
    if value is None or np.shape(value) != (count, width):
        return None
    with np.errstate(invalid="ignore"):  # a signalling NaN
        return np.asarray(value, np.float64)


def _check_used(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
    """Raise LucidaError if a face uses a vertex that is not a usable point."""
    wrong = np.logical_not((np.abs(vertices) <= LARGEST).all(axis=1))  # true for NaN, too
    if not wrong.any():
        return
    wrong_used = np.unique(faces[wrong[faces]])
    if len(wrong_used):
        point = ", ".join(f"{x:g}" for x in vertices[wrong_used[0]])
        raise LucidaError(
            "vertices",
            f"{len(wrong_used)} of {len(vertices)} are NaN or too large, the first ({point})",
            f"repair the model; stay within {LARGEST:g}",
        )


def _own_origin(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the origin of the mesh's own space: the file's origin, or a point near a far mesh.

    That point is a multiple of a power of two of about the mesh's size. It is therefore exact, and
    a pattern of cells whose side is a smaller power of two does not shift. Stray vertices, such as
    a marker at the origin of a map, change neither the size nor the point.
    """
    used = np.zeros(len(vertices), bool)
    used[faces] = True
    points = vertices[used]
    low, high = extent(points)
    if not np.abs(low + high).max() / 2 > (high - low).max() / 4:
        return np.zeros(3)  # about the file's origin
    low, middle, high = np.percentile(points, SPREAD, axis=0)
    size = float((high - low).max())
    if not np.abs(middle).max() > FAR * size > 0:
        return np.zeros(3)
    step = 2.0 ** math.ceil(math.log2(size))
    origin: NDArray[np.float64] = np.round(middle / step) * step
    return origin


def _visible(
    positions: NDArray[np.float32],
    faces: NDArray[np.int64],
    merged: NDArray[np.int64],
    has_backs: bool,
) -> NDArray[np.bool_]:
    """Return a mask (m,) of faces with an area that do not repeat an earlier face's positions.

    merged: the result of merge_positions(). has_backs: see Part.
    """
    joined = merged[faces]
    a, b, c = (positions[faces[:, corner]].astype(np.float64) for corner in range(3))
    sides = b - a, c - b, a - c
    longest = np.max([np.einsum("ij,ij->i", side, side) for side in sides], axis=0)
    area = np.linalg.norm(np.cross(sides[0], sides[2]), axis=1)
    sound = (area > NEEDLE * longest) & (area > SMALLEST_AREA)
    if has_backs:  # begin with the least corner, keeping the winding
        turn = (joined.argmin(axis=1)[:, None] + np.arange(3)) % 3
        ordered = np.take_along_axis(joined, turn, axis=1)
    else:
        ordered = np.sort(joined, axis=1)
    i, j, k = ordered.T.astype(np.uint64)
    mixed = i * np.uint64(0x9E3779B97F4A7C15) ^ j * np.uint64(0xC2B2AE3D27D4EB4F) ^ k
    mixed ^= k * np.uint64(0x165667B19E3779F9) >> np.uint64(7)
    order = np.argsort(mixed, kind="stable")
    here, before = order[1:], order[:-1]
    again = (i[here] == i[before]) & (j[here] == j[before]) & (k[here] == k[before])
    sound[here[again]] = False
    return sound


def _unit(normals: NDArray[np.float64] | None) -> NDArray[np.float32] | None:
    """Return normals at unit length; 0 for rows without a direction; None if all rows are such."""
    if normals is None:
        return None
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    sound = np.isfinite(lengths) & (lengths > 1e-12)
    if not sound.any():
        return None
    unit = np.divide(normals, lengths, out=np.zeros_like(normals), where=sound)
    return unit.astype(np.float32)


def used_vertices(faces: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return (source, faces): the vertices that faces use, in their order, and the faces
    renumbered.
    """
    if not faces.size:
        return np.zeros(0, np.int64), faces
    low = int(faces.min())
    used = np.zeros(int(faces.max()) + 1 - low, bool)
    used[faces - low] = True
    number = np.cumsum(used) - 1
    return np.flatnonzero(used) + low, number[faces - low]
