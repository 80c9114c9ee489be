"""The contents of a camera file as values, and as text: a line for each value.

Pure; for the command line.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras import CameraSet, PosedCamera, format_named
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import one_line

from .basis import measures
from .other_words import of_any_size

LISTED = 3  # the number of names and sizes that are listed
ROUNDING = 1e-14  # relative to a vector's largest component: smaller ones are rounding
ORTHONORMAL = 1e-4  # the largest error of a basis's dot products

Fact = tuple[str, str]  # the name of a quantity, "" if it continues the previous one; its text


def facts(found: CameraSet, chosen: PosedCamera | None = None) -> list[Fact]:
    """Return the facts about a file: about the selected camera, or else about all together."""
    told = [("format", f"{found.format}: {format_named(found.format).what}")]
    told += [("" if number else "taken", phrase) for number, phrase in enumerate(found.taken)]
    cameras = found.cameras if chosen is None else (chosen,)
    told += _of_all(found) if chosen is None else _of_one(chosen)
    lenses = [one.camera.lens for one in cameras if one.camera.lens is not None]
    if lenses:
        more = f", the first of {len(lenses)}" if len(lenses) > 1 else ""
        told.append(("lens", f"{lenses[0]}{more}"))
    return [(name, one_line(text)) for name, text in told]


def as_text(told: Sequence[Fact]) -> str:
    """Return one line per fact, in two columns."""
    width = max(len(name) for name, _ in told) + 2
    return "\n".join(f"{name:{width}}{text}" for name, text in told)


def _of_all(found: CameraSet) -> list[Fact]:
    names = [camera.name for camera in found.cameras if camera.name]
    sizes = [_size_text(size) for size in dict.fromkeys(camera.size for camera in found.cameras)]
    count = str(len(found.cameras))
    told = [("cameras", f"{count}: {_listed(names)}" if names else count), ("size", _listed(sizes))]
    if found.points is not None and len(found.points):
        told.append(("points", f"{len(found.points)} of a reconstruction"))
    return told


def _listed(names: list[str]) -> str:
    return ", ".join(names[:LISTED]) + (", ..." if len(names) > LISTED else "")


def _of_one(posed: PosedCamera) -> list[Fact]:
    """Return a line for each value of the camera that the file has; see as_data()."""
    values = _camera_data(posed) | {"size": _size_text(posed.size)}
    told = [
        (name, _text(value))
        for name, value in values.items()
        if value not in (None, "", False) and name != "lens"
    ]
    if values["K"] is not None:
        told.append(("", "K, R and t count pixels from the centre of the first one"))
    elif not posed.camera.is_parallel:
        left, right, bottom, top = posed.camera.viewport
        shape = f", if W / H is {(right - left) / (top - bottom):.5g}" * posed.fit
        told.append(("K of W x H", of_any_size(posed.camera, "center") + shape))
    return told


def _text(value: Any) -> str:
    """Return a flag, a text, a number, a vector or a matrix as text."""
    if isinstance(value, list) and isinstance(value[0], list):
        return ", ".join(map(_text, value))
    if isinstance(value, list):
        least = ROUNDING * max(map(abs, value))
        return "(" + ", ".join(_text(one if abs(one) >= least else 0.0) for one in value) + ")"
    if isinstance(value, bool | str):
        return str(value)
    return f"{value + 0.0:.7g}"  # + 0.0: no negative zero


def basis_text(camera: Camera) -> str:
    """Describe a basis by its handedness and, if it is not orthonormal, lengths and angles."""
    hand = "right-handed" if camera.determinant > 0 else "left-handed: the picture is mirrored"
    if np.abs(camera.basis.T @ camera.basis - np.eye(3)).max() <= ORTHONORMAL:
        return f"orthonormal, {hand}"
    found = measures(camera.u, camera.v, camera.w)
    lengths, angles = _text(list(found.lengths)), _text(list(found.angles_deg))
    return f"lengths {lengths}, angles uv, vw, wu {angles} degrees, {hand}"


def as_data(found: CameraSet, chosen: PosedCamera | None = None) -> dict[str, Any]:
    """Return the facts about a file as JSON values.

    K, R and t map a point to pixels whose centres are whole numbers. They are None for a parallel
    camera, and if there is no image size.
    """
    cameras = found.cameras if chosen is None else (chosen,)
    return {
        "format": found.format,
        "taken": list(found.taken),
        "cameras": [_camera_data(posed) for posed in cameras],
        "points": 0 if found.points is None else len(found.points),
    }


def _camera_data(posed: PosedCamera) -> dict[str, Any]:
    size, view = posed.size, View(posed.camera, posed.fit)
    camera = view.camera if size is None else view.for_size(size)
    matrices: dict[str, Any] = dict.fromkeys("KRt")
    if size is not None and not camera.is_parallel:
        parts = zip("KRt", camera.intrinsics(size), strict=True)
        matrices = {name: part.tolist() for name, part in parts}
    return {
        "name": posed.name,
        "image": posed.image,
        "size": None if size is None else list(size),
        **{name: list(getattr(camera, name)) for name in ("eye", "u", "v", "w")},
        "distance": camera.distance,
        "viewport": list(camera.viewport),
        "fit": posed.fit,
        "projection": camera.projection,
        "near": camera.near,
        "far": camera.far,
        "fov_deg": None if camera.is_parallel else [camera.fov_x_deg, camera.fov_y_deg],
        "basis": basis_text(camera),
        **matrices,
        "lens": camera.lens and {"model": camera.lens.model, **camera.lens.coefficients},
    }


def _size_text(size: Size | None) -> str:
    return "of any size" if size is None else f"{size[0]}x{size[1]}"
