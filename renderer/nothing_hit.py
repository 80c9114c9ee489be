"""Explanations for an image that shows nothing: no objects, all behind the eye, all clipped, or
none in view.

Pure. Called only if nothing is hit, so it can afford to examine every triangle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Size
from renderer.frame import Frame
from renderer.scene.flat import FlatScene
from renderer.scene.positions import world_vertices


class Reason(NamedTuple):
    """The reason that nothing is visible. cause: a word for programs, which select a remedy by it.
    text: the same in a few words for people.
    """

    cause: str
    text: str


class _Extents(NamedTuple):
    """The extents of each object that is not hidden, (n,).

    near, far: the smallest and largest ray parameter, that is the depth along -w, in units of the
    distance (perspective) or of w (parallel). low, high: its bounds on the image plane, (n, 2);
    infinite if it extends from behind the eye to before it.
    """

    near: NDArray[np.float64]
    far: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]


def hits_nothing(*frames: Frame) -> bool:
    """Return True if no pixel of any of the frames, which must have the channel id, hits
    anything.
    """
    return all(not (frame.channel("id") >= 0).any() for frame in frames)


def why_nothing_is_hit(flat: FlatScene, camera: Camera, size: Size | None = None) -> Reason:
    """Return the reason that nothing is hit in an image of this camera.

    Causes: "empty"; "behind" the eye; clipped by near and far ("clip"); outside the picture
    ("beside"), perhaps because the viewport is off-centre ("viewport"); all smaller than a pixel of
    an image of this size ("small"); where the lens sees nothing ("lens"); otherwise "missed".
    """
    if camera.lens is not None and len(flat.materials):
        return _why_through_lens(flat, camera)
    objects = _extents(flat, camera)
    near, far = camera.t_range
    behind, count = int(np.count_nonzero(objects.far <= 0)), len(objects.far)
    if not count:
        hidden = len(flat.object_sphere) > 0
        return Reason("empty", "all objects are hidden" if hidden else "the scene has no objects")
    if behind == count:
        return Reason("behind", "everything is behind the eye")
    if not (objects.far > near).any():
        text = f"everything is behind the eye or nearer than near = {camera.near:g}"
        return Reason("clip", text)
    if not (objects.near < far).any():
        return Reason("clip", f"everything is farther than far = {camera.far:g}")
    some = f"; {behind} of {count} are behind the eye" if behind else ""
    ahead = objects.far > 0
    aside = _why_beside(camera, objects.low[ahead], objects.high[ahead])
    if aside is not None:
        return Reason(aside.cause, aside.text + some)
    left, right, bottom, top = camera.viewport
    seen = ahead & _meets((left, bottom), (right, top), objects.low, objects.high)
    cut = seen & ~((objects.far > near) & (objects.near < far))
    if (cut == seen).all():
        sides = []
        if (objects.far[cut] <= near).any():
            sides.append(f"nearer than near = {camera.near:g}")
        if (objects.near[cut] >= far).any():
            sides.append(f"farther than far = {camera.far:g}")
        return Reason("clip", f"all that is in view is {' or '.join(sides)}{some}")
    if size is not None and (small := _why_too_small(camera, size, objects, seen & ~cut)):
        return Reason("small", small)
    reaches_out = (objects.far > far) | ((objects.near < near) if near > 0 else False)
    if (seen & reaches_out).any():
        planes = [f"{n} = {d:g}" for n, d in (("near", camera.near), ("far", camera.far)) if d]
        where = f"between {planes[0]} and {planes[1]}" if planes[1:] else f"within {planes[0]}"
        return Reason("clip", f"no viewing ray meets an object {where}{some}")
    if flat.single_sided.any() or (flat.textures[:, 1, 1] >= 0).any():
        some += "; holes, and the backs of single-sided surfaces, are not seen"
    return Reason("missed", f"no viewing ray meets an object{some}")


def _why_through_lens(flat: FlatScene, camera: Camera) -> Reason:
    """Return the reason for a camera with a lens, by points of each object's box: its corners, its
    middle, and the point nearest to the eye.
    """
    shown = (flat.object_faces[:, 1] > 0) | (flat.object_sphere >= 0)
    if not shown.any():
        return Reason("empty", "all objects are hidden")
    bounds, matrix = flat.object_bounds[shown].astype(float), flat.world_from_object[shown]
    eye = np.linalg.inv(matrix) @ np.append(camera.eye, 1.0)
    nearest = np.clip(eye[:, :3], bounds[:, 0], bounds[:, 1])
    corners = bounds[:, np.array(list(np.ndindex(2, 2, 2))), np.arange(3)]
    points = np.concatenate([corners, bounds.mean(axis=1)[:, None], nearest[:, None]], axis=1)
    world = points @ np.swapaxes(matrix[:, :3, :3], 1, 2) + matrix[:, None, :3, 3]
    row, column, t = camera.project(world, (1, 1))
    near, far = camera.t_range
    if not (t > 0).any():
        return Reason("behind", "everything is behind the eye")
    if not (t > near).any():
        return Reason("clip", f"everything is nearer than near = {camera.near:g}")
    if not (t < far).any():
        return Reason("clip", f"everything is farther than far = {camera.far:g}")
    seen = np.isfinite(row)
    if not seen.any():
        return Reason("lens", "everything is outside of the lens")
    row, column = row[seen], column[seen]
    beyond = {
        "left": column < -0.5,
        "right": column > 0.5,
        "below": row > 0.5,
        "above": row < -0.5,
    }
    if where := " and ".join(side for side, is_there in beyond.items() if is_there.all()):
        return Reason("beside", f"everything is outside of the picture: {where}")
    return Reason("missed", "no viewing ray through the lens meets an object")


def middle_of(flat: FlatScene) -> tuple[float, float, float]:
    """Return the centre of the scene's bounds, as a point to look at."""
    x, y, z = flat.bounds.astype(float).mean(axis=0).tolist()
    return x, y, z


def _why_beside(
    camera: Camera, low: NDArray[np.float64], high: NDArray[np.float64]
) -> Reason | None:
    """Return the reason if no object extends into the viewport; None if one does.

    The reason is the viewport if objects would be visible with a centred one.
    """
    left, right, bottom, top = camera.viewport
    if _meets((left, bottom), (right, top), low, high).any():
        return None
    half = (right - left) / 2, (top - bottom) / 2
    x, y = (left + right) / 2, (bottom + top) / 2
    off_axis = abs(x) > half[0] or abs(y) > half[1]
    if off_axis and _meets((-half[0], -half[1]), half, low, high).any():
        return Reason("viewport", f"the viewport is off the view's axis, {_listed(camera)}")
    sides = {
        "left": (high[:, 0] < left).all(),
        "right": (low[:, 0] > right).all(),
        "below": (high[:, 1] < bottom).all(),
        "above": (low[:, 1] > top).all(),
    }
    where = " and ".join(side for side, is_there in sides.items() if is_there)
    return Reason("beside", f"everything is outside of the picture{where and f': {where}'}")


def _why_too_small(camera: Camera, size: Size, objects: _Extents, seen: NDArray[np.bool_]) -> str:
    """Return the size of the largest object in view, if it is less than a pixel; otherwise ""."""
    left, right, bottom, top = camera.viewport
    pixel = (right - left) / size[0], (top - bottom) / size[1]
    extent = (objects.high[seen] - objects.low[seen]) / pixel
    if not (extent < 1).all(axis=1).all():
        return ""
    width, height = extent[extent.max(axis=1).argmax()]
    return f"everything is smaller than a pixel: {width:.2g} x {height:.2g}"


def _meets(
    low: tuple[float, float],
    high: tuple[float, float],
    lows: NDArray[np.float64],
    highs: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Return which rectangles overlap the given one."""
    apart = np.any(lows > high, axis=1) | np.any(highs < low, axis=1)
    return np.asarray(~apart)


def _listed(camera: Camera) -> str:
    left, right, bottom, top = camera.viewport
    return f"x from {left:.4g} to {right:.4g}, y from {bottom:.4g} to {top:.4g}"


def _extents(flat: FlatScene, camera: Camera) -> _Extents:
    unit = 1.0 if camera.is_parallel else camera.distance
    matrix = camera.camera_from_world
    corners = (world_vertices(flat) @ matrix[:3, :3].T + matrix[:3, 3])[flat.faces]
    # The corners of a box around each sphere in camera space, where it may be an ellipsoid.
    center = flat.spheres[:, :3] @ matrix[:3, :3].T + matrix[:3, 3]
    reach = flat.spheres[:, 3:] * np.linalg.norm(matrix[:3, :3], axis=1)
    signs = np.stack(np.meshgrid((-1, 1), (-1, 1), (-1, 1)), -1).reshape(-1, 3)
    boxes = center[:, None] + signs * reach[:, None]
    least = np.full((len(flat.object_sphere), 6), np.inf)
    for owner, points in ((flat.face_object, corners), (flat.sphere_object, boxes)):
        np.minimum.at(least, owner, _least(points, camera))
    near, left, low, far, right, high = least[np.isfinite(least[:, 0])].T  # others are hidden
    sides = np.column_stack([left, low]), -np.column_stack([right, high])
    return _Extents(near / unit, -far / unit, *sides)


def _least(points: NDArray[np.float64], camera: Camera) -> NDArray[np.float64]:
    """Return depth, x and y on the image plane of groups of points, (n, k, 3) in camera space:
    the least of each, and the negated largest, (n, 6).
    """
    depth, plane = -points[..., 2], points[..., :2]
    near, far = depth.min(axis=1), depth.max(axis=1)
    if not camera.is_parallel:
        with np.errstate(divide="ignore", invalid="ignore"):
            plane = plane * (camera.distance / depth)[..., None]
    low, high = plane.min(axis=1), plane.max(axis=1)
    if not camera.is_parallel:
        behind, crossing = far <= 0, (near <= 0) & (far > 0)
        low[behind], high[behind] = np.inf, -np.inf
        low[crossing], high[crossing] = -np.inf, np.inf
    return np.column_stack([near, low, -far, -high])
