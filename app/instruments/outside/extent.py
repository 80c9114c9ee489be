"""The extent of a scene, and the outside camera that sees it and the other camera. Pure."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import LARGEST, Floats, three
from lucida.renderer.system.errors import LucidaError

from .frustum import plane_corners

FOV_Y_DEG = 50.0
LARGE_REACH = 30.0  # in a picture of such a scene, an arrow of length 1 is short
MARGIN = 1.12  # a side of the picture, relative to its content: space for letters
# The direction of the default viewpoint from a camera: to the right, above, behind.
FROM_RIGHT, FROM_ABOVE, FROM_BEHIND = 0.75, 0.5, 1.25


def arrow_length(reach: float) -> float:
    """Return the length of a unit vector's arrow: 1, or a power of ten in a scene that is much
    smaller or larger.

    reach: the scene's reach; see Focus.
    """
    is_usual = 1 <= reach <= LARGE_REACH or reach <= 0
    return 1.0 if is_usual else 10.0 ** math.floor(math.log10(reach))


def around(points: Floats, arrow: float, *cameras: Camera) -> Floats:
    """Return the points (n, 3) together with points around cameras: eyes, image planes, bases with
    letters.

    arrow: from arrow_length().
    """
    parts = [points]
    for camera in cameras:
        eye = np.asarray(camera.eye)
        tips = [eye + 1.2 * arrow * np.asarray(vector) for vector in (camera.u, camera.v, camera.w)]
        parts.append(np.array([eye, *tips, *plane_corners(camera)]))
    everything = np.concatenate(parts)
    return everything[np.isfinite(everything).all(axis=1)]


def end_parameter(camera: Camera, points: Floats) -> float:
    """Return the ray parameter at which the scene ends for a camera. If nothing is in front of the
    camera, return one somewhat beyond its image plane.
    """
    least = 1.0 / float(np.linalg.norm(camera.w)) if camera.is_parallel else 1.6
    if not len(points):
        return 2 * least
    matrix = camera.camera_from_world
    if camera.lens is not None:
        x, y, z = matrix[:3, :3] @ points.T + matrix[:3, 3:]
        return float(max(1.04 * camera.lens.length(x, -y, -z).max() / camera.distance, least))
    t = -(points @ matrix[2, :3] + matrix[2, 3]) / (1.0 if camera.is_parallel else camera.distance)
    return float(max(1.04 * t.max(), least))


def outside_camera(points: Floats, home: Camera, aspect: float) -> Camera:
    """Return a camera that sees all points as large as possible, from the right, from behind
    and from above the camera `home`, fitted to width / height = aspect.

    points: (n, 3); those that are not finite are ignored.
    """
    points = points[np.isfinite(points).all(axis=1) & (np.abs(points).max(axis=1) < LARGEST / 1e3)]
    if not len(points):
        points = np.zeros((1, 3))
    return framed(points, looked_from(np.array([0.0, 1.0, 0.0]), np.asarray(home.w)), aspect)


def looked_from(up: Floats, back: Floats) -> Floats:
    """Return the unit vector towards an eye that looks from the right of a camera, from behind it
    and from above. up: a unit vector. back: the camera's backward direction.
    """
    level = back - (back @ up) * up
    if np.linalg.norm(level) < 0.05 * np.linalg.norm(back):
        level = np.eye(3)[int(np.argmin(np.abs(up)))]
        level = level - (level @ up) * up
    level = level / np.linalg.norm(level)
    way = FROM_RIGHT * np.cross(up, level) + FROM_ABOVE * up + FROM_BEHIND * level
    return way / np.linalg.norm(way)


def framed(
    points: Floats,
    toward: Floats,
    aspect: float,
    up: Iterable[float] = (0.0, 1.0, 0.0),
) -> Camera:
    """Return the camera that sees all points as large as possible, apart from a margin.

    Each plane of a view pyramid bounds the eye linearly, so the nearest eye that satisfies all
    four is exact. points: (n, 3), at least one. toward: the unit vector from them to the eye.
    """
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    upward = np.asarray(tuple(up), float)
    if np.linalg.norm(np.cross(upward, toward)) < 1e-3:
        upward = np.array([0.0, 0.0, -1.0])
    camera = Camera.look_at(center + toward, center, upward, fov_y_deg=FOV_Y_DEG, aspect=aspect)
    x, y, z = ((points - center) @ np.asarray(axis) for axis in (camera.u, camera.v, camera.w))
    # Keep a distance at which rounding does not show.
    least = max(1e-6 * float(np.abs(center).max()), 1e-9)
    radius = max(float(np.linalg.norm(points - center, axis=1).max()), least)
    tangent_y = math.tan(math.radians(FOV_Y_DEG) / 2)
    tangents = tangent_y * aspect / MARGIN, tangent_y / MARGIN
    offsets, depths = [], [1.02 * float(z.max()) + 0.05 * radius]
    for across, tangent in ((x, tangents[0]), (y, tangents[1])):
        high, low = float((across + tangent * z).max()), float((across - tangent * z).min())
        depths.append((high - low) / (2 * tangent))
        offsets.append((high + low) / 2)
    depth = max(depths)
    right, top, back = (np.asarray(axis) for axis in (camera.u, camera.v, camera.w))
    try:
        eye = center + offsets[0] * right + offsets[1] * top + depth * back
        return replace(camera, eye=three(eye))
    except LucidaError:  # a scene at the limits of the number range
        return Camera.look_at((3.0, 2.0, 5.0), (0.0, 0.0, 0.0), fov_y_deg=FOV_Y_DEG, aspect=aspect)
