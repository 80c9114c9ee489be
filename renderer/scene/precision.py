"""The limits of float32: cameras too narrow or too wide to be drawn correctly.

Pure. The check runs before a picture is drawn or compared, and rejects it in one line.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.system.errors import LucidaError

from .boxes import corners_of
from .flat import FlatScene

# GL clips in float32. An edge made by clipping is 1024 pixels outside the image (MARGIN,
# renderer/raster/scene_data.py), and has an error of 2^-24 of the clipped length.
LARGEST_PX = 2.0**34
# A point far off the axis has an error of 2^-24 of its distance, also along the axis. Relative to
# its depth, the error grows with the tangent of its angle to the axis.
LARGEST_TANGENT = 2.0**12
_BITS = "for the 24 bits of float32, in which images are drawn"


def check_precision(camera: Camera, size: Size, flat: Callable[[], FlatScene]) -> None:
    """Raise LucidaError if float32 cannot distinguish the pixels of an image.

    flat: returns the scene; only called for narrow and for parallel views.
    """
    left, right, bottom, top = camera.viewport
    farthest = max(abs(left), abs(right)), max(abs(bottom), abs(top))
    unit = 1.0 if camera.is_parallel else camera.distance * math.hypot(*camera.w)
    lengths = math.hypot(*camera.u) / unit, math.hypot(*camera.v) / unit
    pixel = min((right - left) / size[0] * lengths[0], (top - bottom) / size[1] * lengths[1])
    if not camera.is_parallel:
        if max(farthest[0] * lengths[0], farthest[1] * lengths[1]) > LARGEST_TANGENT:
            problem = f"sees {camera.fov_x_deg:.9g} x {camera.fov_y_deg:.9g} degrees, too wide"
            raise LucidaError("camera", f"{problem} {_BITS}", "narrow its field of view")
        if 2 / pixel <= LARGEST_PX:
            return
    corners = corners_of(flat().bounds)
    reach = float(np.linalg.norm(np.ptp(corners, axis=0)))
    if not camera.is_parallel and reach:
        away = float(np.linalg.norm(corners - np.asarray(camera.eye), axis=1).max())
        reach /= max(away, reach / 2)
    if reach / pixel > LARGEST_PX:
        problem = f"sees so little that the scene is {reach / pixel:.2g} pixels large, too many"
        times = f"{reach / pixel / LARGEST_PX:.2g}"
        raise LucidaError("camera", f"{problem} {_BITS}", f"enlarge its view {times} times")
