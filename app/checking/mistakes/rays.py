"""The lines for the viewing ray of a pixel in a task's words, and their mistakes.

With all values of the camera, and (i, j) from 0 with row 0 at the top, they are the camera's
contract:

    x = left + (j + 0.5) / width * (right - left)
    y = top - (i + 0.5) / height * (top - bottom)
    origin = eye
    direction = x*u + y*v - distance*w
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.checking.mistakes.basis import (
    BASIS_LINES,
    BASIS_MISTAKES,
    FORWARD_LINES,
    FORWARD_MISTAKES,
)
from app.checking.mistakes.bodies import body_lines, body_mistakes
from app.checking.mistakes.corners import corner_program, has_corners
from app.checking.mistakes.pixels import pixel_lines, pixel_mistakes
from app.checking.mistakes.program import Mistake, Program
from app.checking.mistakes.sides import sides_part
from app.checking.mistakes.viewport import viewport_lines, viewport_mistakes
from renderer.camera import Camera, Size
from renderer.pixels import Indexing

Floats = NDArray[np.float64]

# The words that a task passes by default.
WORDS = frozenset(
    {"i", "j", "width", "height", "eye", "u", "v", "w", "distance"}
    | {"left", "right", "bottom", "top", "projection"}
)

PIXEL_NAMES = ("i", "j", "x_pixel", "y_pixel", "x01", "y01", "x11", "y11")


@dataclass(frozen=True)
class RayTask:
    """The conventions of a task that asks for rays.

    words: what the task passes. Of the pixel: i, j; x_pixel, y_pixel, its centre in pixels; x01,
    y01; x11, y11. Of the camera: eye; u, v, w or target, up or camera_to_world or world_to_camera;
    left, right, bottom, top or fov_y, fov_x, in degrees or with _rad in radians, and aspect; or the
    words of sides.py and corners.py. With other words, the lines are those of the camera contract.
    indexing, from_top: how i counts rows and j columns; y01 and y11 start at the first row.
    axes: of the matrices' camera space, as in Conventions.
    """

    projection: str = "perspective"
    indexing: Indexing = Indexing.ARRAY
    from_top: bool = True
    words: frozenset[str] = WORDS
    axes: tuple[int, int, int] = (1, 1, 1)


@functools.lru_cache(256)
def ray_program(task: RayTask) -> Program:
    """Return the correct lines and their mistakes. They make origin and direction."""
    words = task.words
    is_parallel = task.projection == "parallel"
    if has_corners(words) and not is_parallel:
        return corner_program(words, task.indexing, task.from_top)
    sides = None if "left" in words else sides_part(words)
    has_angle = "left" not in words and any(word.startswith("fov_") for word in words)
    distance = "1" if has_angle and "distance" not in words else "distance"
    matrix = ""
    if not {"u", "v", "w"} & words:
        matrix = next((m for m in ("camera_to_world", "world_to_camera") if m in words), "")
    parts = [
        (
            pixel_lines(words, task.indexing, task.from_top),
            pixel_mistakes(words, task.indexing, task.from_top, "" if is_parallel else distance),
        ),
        (
            body_lines(is_parallel, matrix, distance, task.axes),
            body_mistakes(is_parallel, matrix, distance, task.axes),
        ),
    ]
    if sides is not None:
        parts.insert(0, sides)
    elif has_angle:
        parts.insert(0, (viewport_lines(words), viewport_mistakes(words)))
    if "up" in words and not matrix and not {"u", "v", "w"} & words:
        if "target" in words:
            parts.insert(0, (BASIS_LINES, BASIS_MISTAKES))
        elif "forward" in words:
            parts.insert(0, (FORWARD_LINES, FORWARD_MISTAKES))
    lines = tuple(line for part, _ in parts for line in part)
    if task.axes != (1, 1, 1):  # so that mistakes in that space are reported first
        parts.reverse()
    mistakes = [mistake for _, part in parts for mistake in part]
    mistakes.sort(key=lambda mistake: not mistake.is_common)
    return Program(lines, tuple(mistakes), ("origin", "direction"))


def ray_values(
    camera: Camera, i: ArrayLike, j: ArrayLike, size: Size, task: RayTask | None = None
) -> dict[str, Any]:
    """Return the values that the lines use: all words but target and up.

    i, j: pixels, 0-based, row 0 at the top.
    size: of the image, (width, height).
    """
    task = task or RayTask(camera.projection)
    row, column = (np.asarray(value, float)[..., None] for value in np.broadcast_arrays(i, j))
    width, height = size
    left, right, bottom, top = camera.viewport
    to_world = np.eye(4)
    to_world[:3, :3] = camera.basis * np.array(task.axes, float)
    to_world[:3, 3] = camera.eye
    corner = camera.basis @ [left, bottom, -camera.distance] + camera.eye
    horizontal, vertical = camera.basis[:, :2].T * [[right - left], [top - bottom]]
    x01 = (column + 0.5) / width
    down = (row + 0.5) / height
    y01 = down if task.from_top else 1.0 - down
    if not task.from_top:
        row = height - 1 - row
    return {
        "i": row + task.indexing.value,
        "j": column + task.indexing.value,
        "x_pixel": x01 * width,
        "y_pixel": y01 * height,
        "x01": x01,
        "y01": y01,
        "x11": 2 * x01 - 1,
        "y11": 2 * y01 - 1,
        "width": float(width),
        "height": float(height),
        "eye": np.asarray(camera.eye),
        "u": np.asarray(camera.u),
        "v": np.asarray(camera.v),
        "w": np.asarray(camera.w),
        "distance": camera.distance,
        "left": left,
        "right": right,
        "bottom": bottom,
        "top": top,
        **_angles(camera),
        "aspect": (right - left) / (top - bottom),
        "viewport_width": right - left,
        "viewport_height": top - bottom,
        "forward": -np.asarray(camera.w),
        "camera_to_world": to_world,
        "world_to_camera": np.linalg.inv(to_world),
        "bottom_left": corner,
        "horizontal": horizontal,
        "vertical": vertical,
        "pixel00": corner + 0.5 / width * horizontal + (1 - 0.5 / height) * vertical,
        "delta_u": horizontal / width,
        "delta_v": -vertical / height,
    }


def _angles(camera: Camera) -> dict[str, float]:
    """Return the fields of view of an orthonormal camera with a symmetric viewport."""
    left, right, bottom, top = camera.viewport
    across = 2 * math.atan2((right - left) / 2, camera.distance)
    along = 2 * math.atan2((top - bottom) / 2, camera.distance)
    angles = {
        "fov_x": across,
        "fov_y": along,
        "fov_long": max(across, along),
        "fov_short": min(across, along),
    }
    degrees = {name: math.degrees(angle) for name, angle in angles.items()}
    return degrees | {f"{name}_rad": angle for name, angle in angles.items()}


def run_rays(
    program: Program, known: Mapping[str, Any], mistakes: tuple[Mistake, ...] = ()
) -> tuple[Floats, Floats]:
    """Return origins and directions, (..., 3) for each pixel in `known`."""
    origin, direction = program.run(known, mistakes)
    pixels = (np.shape(known[name]) for name in PIXEL_NAMES if name in known)
    shape = np.broadcast_shapes(*pixels, np.shape(origin), np.shape(direction))
    return np.broadcast_to(origin, shape), np.broadcast_to(direction, shape)


def camera_rays(
    camera: Camera,
    size: Size,
    mistakes: tuple[Mistake, ...] = (),
    indexing: Indexing = Indexing.ARRAY,
) -> tuple[Floats, Floats]:
    """Return the rays of a whole image with these mistakes, (height, width, 3) each. The lines are
    those of `ray_program` for the camera's projection.
    """
    task = RayTask(camera.projection, indexing)
    i, j = np.arange(size[1])[:, None], np.arange(size[0])
    return run_rays(ray_program(task), ray_values(camera, i, j, size, task), mistakes)
