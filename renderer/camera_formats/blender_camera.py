"""Blender's camera model: the pose and the viewport that a camera's values describe.

Source: Blender, source/blender/blenkernel/intern/camera.cc, BKE_camera_params_compute_viewplane().
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats, listed, number, numbers, positive
from renderer.camera_formats import blender_panorama
from renderer.camera_formats.blender_values import Values
from renderer.camera_formats.entries import errors_as
from renderer.camera_formats.given import Options
from renderer.camera_formats.posed import PosedCamera
from renderer.camera_formats.rigid import rotation_of
from renderer.errors import LucidaError
from renderer.frame import check_size
from renderer.intrinsics import matrix

# Blender's default camera. The clip planes have no defaults here: unless they are given, they are
# fitted to the scene.
DEFAULTS: Values = {
    "type": "PERSP",
    "lens": 50.0,
    "sensor_width": 36.0,
    "sensor_height": 24.0,
    "sensor_fit": "AUTO",
    "shift_x": 0.0,
    "shift_y": 0.0,
    "ortho_scale": 6.0,
    "resolution_x": 1920,
    "resolution_y": 1080,
    "resolution_percentage": 100,
    "pixel_aspect_x": 1.0,
    "pixel_aspect_y": 1.0,
    "location": (0.0, 0.0, 0.0),
    **blender_panorama.DEFAULTS,
}
DEGREES = ("_degrees", "_deg")
ANGLES = {"angle": "", "angle_x": "sensor_width", "angle_y": "sensor_height"}
EULER = frozenset(f"rotation_euler{unit}" for unit in ("", *DEGREES))
TURNS = EULER | {"matrix_world", "rotation_mode", "rotation_quaternion"}
KNOWN = frozenset(DEFAULTS) | TURNS | {"clip_start", "clip_end"}
KNOWN |= {f"{angle}{unit}" for angle in ANGLES for unit in ("", *DEGREES)}
TYPES = {"PERSP": "perspective", "ORTHO": "parallel", "PANO": "perspective"}
# Blender's names for the parts of a camera.
FIELDS = dict.fromkeys("uvw", "matrix_world")
FIELDS |= {"near": "clip_start", "far": "clip_end", "viewport": "lens"}
FITS = ("AUTO", "HORIZONTAL", "VERTICAL")
_TURNS_OF_RADIANS = 4 * math.pi  # larger angles are probably in degrees


def posed(values: Values, options: Options) -> PosedCamera:
    """Return the camera that a script's or a file's values describe. Raises LucidaError naming the
    value.
    """
    pose = _pose(values)
    lengths = np.linalg.norm(pose[:3, :3], axis=0)
    if not (lengths > 1e-12).all():
        problem = f"has columns of length {listed(lengths)}"
        raise LucidaError("matrix_world", problem, "give a rotation")
    u, v, w = (pose[:3, :3] / lengths).T.tolist()  # Blender removes a camera's scale
    kind = values.get("type", DEFAULTS["type"])
    if not isinstance(kind, str) or kind not in TYPES:
        raise LucidaError(
            "type", f"{kind!r} is no {' or '.join(TYPES)}", "change the camera's type"
        )
    lens = blender_panorama.lens(values) if kind == "PANO" else None
    viewport, size = _viewport(values, options, kind)
    near, far = (
        None if values.get(name) is None else number(name, values[name])
        for name in ("clip_start", "clip_end")
    )
    try:
        camera = Camera(pose[:3, 3].tolist(), u, v, w, 1.0, viewport, TYPES[kind], near, far, lens)
    except LucidaError as error:
        field = FIELDS.get(error.field, error.field)
        raise LucidaError(field, error.problem, error.remedy) from None
    name = values.get("name", "")
    return PosedCamera(camera, size, name if isinstance(name, str) else "")


def _viewport(
    values: Values, options: Options, kind: str
) -> tuple[tuple[float, float, float, float], Size]:
    """Return the viewport at distance 1, and the image's size.

    Follows BKE_camera_params_compute_viewplane(), which works in pixels of a picture centred on (0,
    0).
    """
    size = _size(values, options)
    width, height = size
    shift_x, shift_y = (
        number(name, values.get(name, DEFAULTS[name])) for name in ("shift_x", "shift_y")
    )
    is_panorama = kind == "PANO"
    if is_panorama and (edges := blender_panorama.edges(values)) is not None:
        left, right, bottom, top = edges
        x, y = shift_x * (right - left), shift_y * (top - bottom)
        return (left + x, right + x, bottom + y, top + y), size
    stretch = _positive(values, "pixel_aspect_y") / _positive(values, "pixel_aspect_x")
    fit = values.get("sensor_fit", DEFAULTS["sensor_fit"])
    if fit not in FITS:
        raise LucidaError("sensor_fit", f"{fit!r} is unknown", f"give one of {', '.join(FITS)}")
    horizontal = fit == "HORIZONTAL" or (fit == "AUTO" and width >= stretch * height)
    side = width if horizontal else stretch * height
    if kind == "ORTHO":
        seen = _positive(values, "ortho_scale")
    else:
        sensor = _positive(values, "sensor_height" if fit == "VERTICAL" else "sensor_width")
        seen = sensor / (
            blender_panorama.focal_mm(values) if is_panorama else _lens(values, sensor)
        )
    pixel = seen / side
    across = shift_x * (width if is_panorama else side)
    up = shift_y * (stretch * height if is_panorama else side)
    half_width, half_height = width / 2, stretch * height / 2
    left, right = (across - half_width) * pixel, (across + half_width) * pixel
    return (left, right, (up - half_height) * pixel, (up + half_height) * pixel), size


def _size(values: Values, options: Options) -> Size:
    names = ("resolution_x", "resolution_y")
    if options.size is not None and not values.keys() & set(names):
        return options.size
    percentage = _positive(values, "resolution_percentage")
    sides = [_positive(values, name) for name in names]
    for name, side in zip(names, sides, strict=True):
        if not side.is_integer():
            raise LucidaError(name, f"{side:g} is no whole number", "give pixels")
    # Integer division, as in BKE_render_resolution(): 100 pixels at 29 % are 29, but
    # 100 * 0.29 < 29.
    width, height = (int(side * percentage / 100) for side in sides)
    with errors_as("resolution_x"):
        return check_size((width, height))


def _lens(values: Values, sensor: float) -> float:
    """Return the focal length in millimetres, from lens or an angle.

    sensor: the side that `angle` spans.
    """
    for angle, side in ANGLES.items():
        field, value = _angles(values, angle)
        if field:
            if "lens" in values:
                raise LucidaError(field, "is given beside lens", "give one of the two")
            spanned = number(field, value)
            if not 0 < spanned < math.pi:
                problem = f"{spanned:g} radians are not between 0 and pi"
                raise LucidaError(field, problem, f"give radians, or {angle}_degrees")
            return (_positive(values, side) if side else sensor) / 2 / math.tan(spanned / 2)
    return _positive(values, "lens")


def _pose(values: Values) -> Floats:
    """Return matrix_world, (4, 4)."""
    if "matrix_world" in values:
        pose = np.array(matrix("matrix_world", values["matrix_world"], (4, 4)))
        numbers("matrix_world", pose.ravel(), 16)  # checks that none is too large
        if pose[3].tolist() != [0, 0, 0, 1]:
            problem = f"its last row is {listed(pose[3])}, not (0, 0, 0, 1)"
            raise LucidaError("matrix_world", problem, "give it row by row")
        return pose
    pose = np.eye(4)
    pose[:3, 3] = numbers("location", values.get("location", DEFAULTS["location"]), 3)
    field, angles = _angles(values, "rotation_euler")
    order = values.get("rotation_mode", "" if field or "rotation_quaternion" not in values else "Q")
    if isinstance(angles, dict):  # of Euler(angles, order)
        order, angles = angles.get("order"), angles.get("angles")
    order = order or "XYZ"
    if order in ("QUATERNION", "Q"):
        quaternion = numbers("rotation_quaternion", values.get("rotation_quaternion"), 4)
        with errors_as("rotation_quaternion"):
            pose[:3, :3] = rotation_of(quaternion)
        return pose
    if not isinstance(order, str) or sorted(order) != ["X", "Y", "Z"]:
        problem = f"{order!r} is not XYZ in any order, or QUATERNION"
        raise LucidaError("rotation_mode", problem, "give rotation_euler, or matrix_world")
    turns = dict(zip("XYZ", numbers(field, angles, 3) if field else (0.0, 0.0, 0.0), strict=True))
    if field and max(map(abs, turns.values())) > _TURNS_OF_RADIANS:
        problem = f"{listed(turns.values())} radians are more than two turns"
        raise LucidaError(field, problem, "write degrees as rotation_euler_degrees or radians()")
    for axis in order:  # the first is applied first
        pose[:3, :3] = _turn("XYZ".index(axis), turns[axis]) @ pose[:3, :3]
    return pose


def _angles(values: Values, name: str) -> tuple[str, Any]:
    """Return the field of that name and its value in radians; "" if it is missing."""
    for unit in DEGREES:
        if (field := name + unit) in values:
            value = values[field]
            if isinstance(value, list | tuple):
                return field, [math.radians(one) for one in numbers(field, value, len(value))]
            return field, math.radians(number(field, value))
    return (name, values[name]) if name in values else ("", None)


def _turn(axis: int, angle: float) -> Floats:
    """Return the rotation by an angle in radians about one axis."""
    one, other = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[one, one] = turn[other, other] = math.cos(angle)
    turn[other, one] = math.sin(angle)
    turn[one, other] = -math.sin(angle)
    return turn


def _positive(values: Values, name: str) -> float:
    return positive(name, values.get(name, DEFAULTS[name]), DEFAULTS[name])
