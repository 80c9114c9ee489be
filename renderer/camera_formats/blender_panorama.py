"""Blender's panoramic cameras, which Cycles renders: those that are a lens of Lens.

A picture is `sensor / fisheye_lens` wide, or spans ranges of angles. shift_x and shift_y move it,
in units of its own width and height. Source: Blender, intern/cycles/kernel/camera/projection.h, and
pictures of directions that Blender 5.0.1 rendered.
"""

from __future__ import annotations

import math

from renderer.camera import Camera
from renderer.camera_checks import listed, number, positive
from renderer.camera_formats.blender_values import Values
from renderer.errors import LucidaError
from renderer.lenses import Lens

_POLYNOMIAL = tuple(f"fisheye_polynomial_k{n}" for n in range(5))
_RANGES = {
    "EQUIRECTANGULAR": ("longitude_min", "longitude_max", "latitude_min", "latitude_max"),
    "CENTRAL_CYLINDRICAL": tuple(
        f"central_cylindrical_range_{axis}_{end}" for axis in "uv" for end in ("min", "max")
    ),
}
# The model of Lens of each panorama_type, in the order in which one is chosen to write.
_MODELS = {
    "EQUIRECTANGULAR": "equirectangular",
    "CENTRAL_CYLINDRICAL": "cylindrical",
    "FISHEYE_EQUISOLID": "equisolid",
    "FISHEYE_LENS_POLYNOMIAL": "equidistant",
    "FISHEYE_EQUIDISTANT": "equidistant",
}
LENSES = tuple(dict.fromkeys(_MODELS.values()))
DEFAULTS: Values = {
    "panorama_type": "FISHEYE_EQUISOLID",
    "fisheye_fov": math.pi,
    "fisheye_lens": 10.5,
    "longitude_min": -math.pi,
    "longitude_max": math.pi,
    "latitude_min": -math.pi / 2,
    "latitude_max": math.pi / 2,
    "central_cylindrical_range_u_min": -math.pi,
    "central_cylindrical_range_u_max": math.pi,
    "central_cylindrical_range_v_min": -1.0,
    "central_cylindrical_range_v_max": 1.0,
    "central_cylindrical_radius": 1.0,
    **dict.fromkeys(_POLYNOMIAL, 0.0),
}
_LONGEST_LENS, _LEAST_SENSOR = 100.0, 1.0  # Blender's own bounds, in millimetres
_SENSOR = 36.0
_ROUNDING = 1e-6  # radians


def lens(values: Values) -> Lens:
    """Return the lens of a camera of the type PANO. Raises LucidaError."""
    kind = values.get("panorama_type", DEFAULTS["panorama_type"])
    if not isinstance(kind, str) or kind not in _MODELS:
        problem = f"{kind!r} is a lens that is not supported"
        raise LucidaError("panorama_type", problem, f"give one of {', '.join(_MODELS)}")
    if kind == "FISHEYE_LENS_POLYNOMIAL":
        for name in (_POLYNOMIAL[0], *_POLYNOMIAL[2:]):
            if _number(values, name):
                problem = f"{values[name]!r} is a lens that is not supported"
                raise LucidaError(name, problem, f"give {_POLYNOMIAL[1]} alone")
    return Lens(_MODELS[kind])


def needed(values: Values) -> tuple[str, ...]:
    """Return the names of the values that determine the field of view."""
    kind = values.get("panorama_type", DEFAULTS["panorama_type"])
    names = {"FISHEYE_EQUIDISTANT": ("fisheye_fov",), "FISHEYE_LENS_POLYNOMIAL": ("sensor_width",)}
    return _RANGES.get(kind, names.get(kind, ("fisheye_lens", "sensor_width")))


def edges(values: Values) -> tuple[float, ...] | None:
    """Return left, right, bottom and top at distance 1; None if they depend on the sensor."""
    kind = values.get("panorama_type", DEFAULTS["panorama_type"])
    if kind == "FISHEYE_EQUIDISTANT":
        half = positive("fisheye_fov", _number(values, "fisheye_fov"), "3.14, in radians") / 2
        return -half, half, -half, half
    if kind not in _RANGES:
        return None
    found = [_number(values, name) for name in _RANGES[kind]]
    if kind == "CENTRAL_CYLINDRICAL":
        radius = positive(name := "central_cylindrical_radius", _number(values, name), "1")
        found[2:] = found[2] / radius, found[3] / radius
    return tuple(found)


def focal_mm(values: Values) -> float:
    """Return the focal length that edges() lacks."""
    if values.get("panorama_type") == "FISHEYE_LENS_POLYNOMIAL":
        slope = _number(values, name := _POLYNOMIAL[1])
        return 1 / positive(name, -slope, "-0.1, in radians a millimetre")
    return positive("fisheye_lens", _number(values, "fisheye_lens"), "10.5")


def entry(camera: Camera) -> Values:
    """Return the values of a rigid camera with a lens of LENSES. Raises LucidaError."""
    assert camera.lens is not None
    model = camera.lens.model
    kind = next(kind for kind, its_model in _MODELS.items() if its_model == model)
    own = [edge / camera.distance for edge in camera.viewport]
    found: Values = {"type": "PANO", "panorama_type": kind}
    if kind in _RANGES:
        up = math.pi / 2 if model == "equirectangular" else math.inf
        bounds = (math.pi, math.pi, up, up)
        if any(abs(edge) > bound + _ROUNDING for edge, bound in zip(own, bounds, strict=True)):
            problem = f"{listed(camera.viewport)} is more than the whole sphere"
            raise LucidaError("viewport", problem, "give at most 2 pi by pi")
        return found | dict(zip(_RANGES[kind], own, strict=True))
    seen = own[1] - own[0]
    length = _SENSOR / seen
    if kind == "FISHEYE_LENS_POLYNOMIAL":
        found |= dict.fromkeys(_POLYNOMIAL, 0.0) | {_POLYNOMIAL[1]: -1 / length}
    else:
        length = min(length, _LONGEST_LENS)
        found["fisheye_lens"] = length
    if length * seen < _LEAST_SENSOR:
        problem = f"{listed(camera.viewport)} is narrower than a fisheye of Blender"
        raise LucidaError("viewport", problem, "give a wider one")
    found |= {"fisheye_fov": 2 * math.pi, "sensor_fit": "HORIZONTAL", "sensor_width": length * seen}
    return found | {
        "shift_x": (own[0] + own[1]) / 2 / seen,
        "shift_y": (own[2] + own[3]) / 2 / (own[3] - own[2]),
    }


def _number(values: Values, name: str) -> float:
    return number(name, values.get(name, DEFAULTS[name]))
