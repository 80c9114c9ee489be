"""OpenGL's cameras: a view and a projection matrix, for column vectors, row-major or column-major.

The range of depths is OpenGL's, -1 to 1, if the projection can have it.
Source: Khronos, "OpenGL 3.3 core", Coordinate transformations.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, Vector, listed
from lucida.renderer.files.reading import check_bytes
from lucida.renderer.system.errors import LucidaError

from .entries import flat, notes_on
from .given import Given, Options
from .notations import assigned, value_of
from .posed import CameraSet, PosedCamera, in_image, one_of

Order = Literal["column by column", "row by row"]

MOST_BYTES = 1 << 20

AROUND = (0.1, 100.0)  # near and far for a camera without them, if there is no scene
FITTED, CHOSEN = "fitted to the scene", "chosen freely"  # near and far of another origin

_OURS = ("camera_from_world", "clip_from_camera")
_VIEW = ("camera_from_world", "view_matrix", "viewMatrix", "modelview", "modelViewMatrix", "view")
_CLIP = ("clip_from_camera", "projection_matrix", "projectionMatrix", "projection")
# Depths of the near and the far plane: OpenGL's and other programs', each also reversed.
_RANGES = ((-1, 1), (1, -1), (1, 0), (0, 1))
_ENDLESS = 1e-7  # relative to near: float32's rounding of an infinite far
_ORDERS: tuple[Order, Order] = ("column by column", "row by row")
_EXACT = 1e-6  # relative to a matrix's largest number; smaller numbers count as 0


def recognises(given: Given) -> bool:
    return len(given.data) <= MOST_BYTES and given.is_text and has_matrices(given.text)


def has_matrices(text: str) -> bool:
    """Return True if a text assigns both matrices, or one by Lucida's name."""
    found = _assigned(text)
    if not found.keys().isdisjoint(_OURS):
        return True
    try:
        return all(_matrix(found, names)[1].size for names in (_VIEW, _CLIP))
    except LucidaError:
        return False


def read(given: Given, options: Options) -> CameraSet:
    check_bytes(len(given.data), MOST_BYTES, given.name)
    found = _assigned(given.text)
    (view_name, view), (clip_name, clip) = (_matrix(found, known) for known in (_VIEW, _CLIP))
    names = (view_name, clip_name)
    camera, taken = _camera(names, view, clip, FITTED in given.text or CHOSEN in given.text)
    notes = notes_on(name for name in found if name not in names)
    return CameraSet("opengl", (PosedCamera(camera, options.size),), (*taken, *notes), notes=notes)


def write(cameras: Sequence[PosedCamera], options: Options) -> bytes:
    posed = one_of(cameras)
    camera = in_image(posed, options, "OpenGL")[0] if posed.fit else posed.camera
    return matrices(camera, AROUND, CHOSEN).encode()


def matrices(camera: Camera, around: tuple[float, float], told: str) -> str:
    """Return camera_from_world (OpenGL's view matrix) and clip_from_camera (its projection), for
    column vectors, column-major.

    around: near and far for a camera that has none. told: their origin in words, FITTED or CHOSEN.
    """
    near, far = around
    note = f": {told}" if camera.near is None and camera.far is None else ""
    if camera.far is not None:
        near, far = camera.near or min(near, camera.far / 1000), camera.far
    elif camera.near is not None:
        near, far = camera.near, max(far, 1000 * camera.near)
    tables = {
        "camera_from_world": camera.camera_from_world,
        "clip_from_camera": camera.clip_from_camera(near, far),
    }
    lines = [
        "# OpenGL matrices for column vectors, column-major: each line is a column",
        f"# near = {near!r}, far = {far!r}{note}",
    ]
    for name, table in tables.items():
        # Adding 0.0 avoids negative zeros.
        columns = (", ".join(map(repr, column)) for column in (table.T + 0.0).tolist())
        lines += [f"{name} = [", *(f"    {column}," for column in columns), "]"]
    return "\n".join(lines) + "\n"


def _assigned(text: str) -> dict[str, str]:
    """Return the text after each name, without the type before it in C."""
    return {name.rpartition(" ")[2]: value for name, value in assigned(text).items()}


def _matrix(found: dict[str, str], names: tuple[str, ...]) -> tuple[str, Floats]:
    """Return the name that is present, and its numbers, four per row in the order of the text.

    A transposition in the text is ignored, since _orders() determines the order.
    """
    name = next((name for name in names if name in found), None)
    if name is None:
        raise LucidaError(names[0], "is missing", "copy both matrices")
    return name, flat(name, value_of(name, found[name].replace(".T", "")), 16).reshape(4, 4)


@np.errstate(all="ignore")  # Camera's own checks reject overflows
def _camera(
    names: tuple[str, str], view: Floats, clip: Floats, fitted: bool
) -> tuple[Camera, tuple[str, ...]]:
    """Return the camera, and a description of how the matrices were read.

    fitted: near and far are not the camera's own.
    """
    view_order, clip_order = _orders(names, view, clip)
    taken = [f"{names[0]} {view_order}", f"{names[1]} {clip_order}"]
    view = view.T if view_order == "column by column" else view
    clip = clip.T if clip_order == "column by column" else clip
    parallel = bool(np.allclose(clip[3], (0, 0, 0, 1)))
    a, b = clip[0, 0], clip[1, 1]
    if not (a and b):
        problem = f"its first two rows are {listed(clip[0])} and {listed(clip[1])}"
        raise LucidaError(names[1], problem, "give a projection without a rotation")
    # Off-diagonal entries skew the basis; a negative scale mirrors it.
    skew = np.eye(3)
    skew[0], skew[1] = clip[0, :3] / abs(a), clip[1, :3] / abs(b)
    if not parallel:
        skew[:2, 2] = 0.0
    to_camera = np.eye(4)
    to_camera[:3, :3] = skew
    try:
        world_from_camera = np.linalg.inv(to_camera @ view)
    except np.linalg.LinAlgError:
        raise LucidaError(names[0], "has no inverse", "give another") from None
    middle = clip[:2, 3 if parallel else 2] * (1 if parallel else -1) / np.abs((a, b))
    half = 1 / np.abs((a, b))
    low, high = -half - middle, half - middle
    near = far = None
    if not clip[2, :2].any() and not fitted:  # leave out an oblique near plane
        near, far, told = _clip_planes(names[1], clip, parallel)
        taken += told
    u, v, w, eye = (_vector(column) for column in world_from_camera.T[:, :3])
    viewport = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
    kind = "parallel" if parallel else "perspective"
    return Camera(eye, u, v, w, 1.0, viewport, kind, near, far), tuple(taken)


def _orders(names: tuple[str, str], view: Floats, clip: Floats) -> tuple[Order, Order]:
    """Return the order of both matrices, determined by the form of their last rows.

    If either order fits one matrix, the other matrix decides. Raises LucidaError.
    """
    off = _EXACT * max(1.0, float(np.abs(view).max()))
    views = [o for o in _ORDERS if np.abs(_last(view, o) - (0, 0, 0, 1)).max() <= off]
    clips = [
        order
        for order in _ORDERS
        if any(np.allclose(_last(clip, order), last) for last in ((0, 0, 0, 1), (0, 0, -1, 0)))
    ]
    if not views:
        problem = "is not affine: neither its last row nor its last column is 0, 0, 0, 1"
        raise LucidaError(names[0], problem, "give a rigid or affine matrix")
    if not clips:
        problem = "is not a projection: its last row is neither 0, 0, -1, 0 nor 0, 0, 0, 1"
        raise LucidaError(names[1], problem, "give OpenGL's, which looks along -z")
    return (views if len(views) == 1 else clips)[0], (clips if len(clips) == 1 else views)[0]


def _last(table: Floats, order: Order) -> Floats:
    """Return the last row of a matrix listed in this order."""
    return table[:, 3] if order == "column by column" else table[3]


def _clip_planes(
    name: str, clip: Floats, parallel: bool
) -> tuple[float | None, float | None, list[str]]:
    """Return near and far, None for one that does not clip, and a description of the depth range.

    The range is the first in _RANGES with near before far. Raises LucidaError if there is none.
    """
    scale, shift = clip[2, 2:]
    planes = []
    for depths in _RANGES:
        if parallel:
            near, far = ((shift - depth) / scale for depth in depths)
        else:  # inverses, since far may be infinite
            nearest, farthest = ((depth + scale) / shift for depth in depths)
            is_endless = abs(farthest) < _ENDLESS * nearest
            near, far = 1 / nearest, np.inf if is_endless else 1 / farthest
        if near < far and (parallel or near > 0):
            planes.append((depths, float(near), float(far)))
    if not planes:
        problem = f"its third row {listed(clip[2])} has no near before far"
        raise LucidaError(name, problem, "give depths from -1 to 1, or from 0 to 1")
    depths, near, far = planes[0]
    others = "".join(
        f"; if to {other[0]} and {other[1]}, they are {n:g} and {f:g}" for other, n, f in planes[1:]
    )
    sides = f"near = {near:g} and far = {far:g}"
    told = [f"{name} takes {sides} to depths {depths[0]} and {depths[1]}{others}"]
    return near if near > 0 else None, far if 0 < far < np.inf else None, told


def _vector(values: Floats) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
