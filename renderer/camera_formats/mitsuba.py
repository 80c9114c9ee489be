"""A camera as a sensor of Mitsuba 3, in XML: alone, or for the scene that is exported with it.

Mitsuba's camera looks along +z with y up and x to the left. `perspective` is rigid, has square
pixels, and may be off-centre; `orthographic` takes any basis, in which the image is 2 wide.
Write only. Source: Mitsuba 3's documentation, "Sensors".
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import told_apart
from renderer.camera_formats.entries import in_image
from renderer.camera_formats.given import Options
from renderer.camera_formats.posed import PosedCamera
from renderer.camera_formats.rigid import UNSEEN_PX, centred, rigid
from renderer.errors import LucidaError

# Clip planes for cameras that have none: in units of the viewport's distance (parallel: its width),
# or of the distance of the scene's farthest point.
NEAR, FAR = 1e-4, 1e6
NEAR_OF_FARTHEST = 1e-5


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    lines = ['<?xml version="1.0" encoding="utf-8"?>', '<scene version="3.0.0">']
    for posed in cameras:
        camera, size = in_image(posed, options, "mitsuba")
        lines += sensor_lines(camera, size)
    return {"": "\n".join([*lines, "</scene>", ""]).encode()}


def sensor_lines(camera: Camera, size: Size, farthest: float | None = None) -> list[str]:
    """Return the sensor's XML, indented once.

    farthest: the distance of the scene's farthest point in world units, if known; used for cameras
    without clip planes. Raises LucidaError.
    """
    if camera.is_parallel:
        camera = centred(camera)
        kind, matrix, numbers = _orthographic(camera, size)
    else:
        camera = rigid(camera, "mitsuba", size)
        kind, matrix, numbers = _perspective(camera, size)
    numbers |= _clip(camera, farthest)
    width, height = size
    return [
        f'    <sensor type="{kind}">',
        *(f'        <float name="{name}" value="{value!r}"/>' for name, value in numbers.items()),
        *(['        <string name="fov_axis" value="x"/>'] if "fov" in numbers else []),
        '        <transform name="to_world">',
        f'            <matrix value="{values(matrix)}"/>',
        "        </transform>",
        '        <film type="hdrfilm">',
        f'            <integer name="width" value="{width}"/>',
        f'            <integer name="height" value="{height}"/>',
        '            <rfilter type="box"/>',
        "        </film>",
        "    </sensor>",
    ]


def values(matrix: np.ndarray) -> str:
    """Return a matrix's numbers, row by row, as Mitsuba's XML lists them."""
    return " ".join(map(repr, matrix.ravel().tolist()))


Fields = tuple[str, np.ndarray, dict[str, float]]


def _perspective(camera: Camera, size: Size) -> Fields:
    left, right, bottom, top = camera.viewport
    width, height = right - left, top - bottom
    pixel = (width / size[0]) / (height / size[1])
    if abs(pixel - 1) * max(size) / 2 > UNSEEN_PX:
        wanted = max(round(size[0] * height / width), 1)
        raise LucidaError(
            "viewport",
            f"is {width:g} wide and {height:g} high in an image of {size[0]} x {size[1]}: pixels "
            f"{told_apart(pixel, 1.0)[0]} times as wide as high, and mitsuba's are square",
            f"give --size {size[0]}x{wanted} if that is its shape, or a view with fit = true"
            if wanted != size[1]
            else "give a view with fit = true",
        )
    numbers = {
        "fov": math.degrees(2 * math.atan(width / 2 / camera.distance)),
        # Relative to the image's width and height, towards the right and the bottom.
        "principal_point_offset_x": (left + right) / 2 / width,
        "principal_point_offset_y": -(bottom + top) / 2 / height,
    }
    return "perspective", _to_world(camera, 1.0, 1.0), numbers


def _orthographic(camera: Camera, size: Size) -> Fields:
    _, right, _, top = camera.viewport
    # The image is 2 wide; square pixels determine its height.
    return "orthographic", _to_world(camera, right, top * size[0] / size[1]), {}


def _to_world(camera: Camera, across: float, up: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 0] = -across * np.asarray(camera.u)
    matrix[:3, 1] = up * np.asarray(camera.v)
    matrix[:3, 2] = -np.asarray(camera.w) / np.linalg.norm(camera.w)
    matrix[:3, 3] = camera.eye
    return matrix


def _clip(camera: Camera, farthest: float | None) -> dict[str, float]:
    """Return Mitsuba's clip planes, which are mandatory. If the camera has none, they are so near
    and so far that nothing is lost.
    """
    unit = float(np.linalg.norm(camera.w))
    left, right, _, _ = camera.viewport
    reach = camera.distance * unit
    if camera.is_parallel:
        reach = (right - left) * float(np.linalg.norm(camera.u))
    near, far = NEAR * reach, FAR * reach
    if farthest is not None:
        near, far = NEAR_OF_FARTHEST * farthest, 2 * farthest
    if camera.far is not None:
        far = camera.far * unit
        near = min(near, far * NEAR_OF_FARTHEST)
    if camera.near is not None:
        near = camera.near * unit
        far = far if camera.far is not None else max(far, near / NEAR_OF_FARTHEST)
    return {"near_clip": near, "far_clip": far}
