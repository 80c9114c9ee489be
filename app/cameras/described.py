"""The contents of a camera file as values, and as text: a line for each value.

Pure; for the command line.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from lucida.app.cameras.basis import measures
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import CameraSet, PosedCamera, format_named
from lucida.renderer.files.cameras.distortion import effect, shift_px
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import one_line

TOLD = 3  # cameras in a file, and sizes, to list
ROUNDING = 1e-14  # of a vector's largest component: less is rounding
EXACT, NEARLY = 1e-12, 1e-4  # errors of an orthonormal basis's dot products


class Fact(NamedTuple):
    """A line. name: of a quantity, "" if it continues the previous one. text: its numbers, in
    words.
    """

    name: str
    text: str


def facts(found: CameraSet, chosen: PosedCamera | None = None) -> list[Fact]:
    """Return the lines on a file: on the selected camera, else on all together."""
    told = [Fact("format", f"{found.format}: {format_named(found.format).what}")]
    told += [Fact("taken" if not i else "", phrase) for i, phrase in enumerate(found.taken)]
    told += _of_all(found) if chosen is None else _of_one(chosen)
    return [Fact(name, one_line(text)) for name, text in told]


def as_text(told: Sequence[Fact]) -> str:
    """Return one line per fact, in two columns."""
    width = max(len(fact.name) for fact in told) + 2
    return "\n".join(f"{name:{width}}{text}" for name, text in told)


def lens_text(cameras: Sequence[PosedCamera], ignored: bool = False) -> str:
    """Return the first lens, and its effect; "" if there is none.

    ignored: among those that were left out when reading, instead of those that the cameras have.
    """
    lenses = [(one, one.ignored if ignored else one.camera.lens) for one in cameras]
    found = [(one, lens) for one, lens in lenses if lens is not None]
    if not found:
        return ""
    posed, lens = found[0]
    told = f"{lens}{' ignored' if ignored else ''}: it moves "
    told += effect(posed.camera, lens, posed.size)
    return told if len(found) == 1 else f"{told}, the first of {len(found)}"


def _of_all(found: CameraSet) -> list[Fact]:
    cameras = found.cameras
    names = [camera.name for camera in cameras if camera.name]
    told = [Fact("cameras", f"{len(cameras)}: {_listed(names)}" if names else str(len(cameras)))]
    sizes = dict.fromkeys(camera.size for camera in cameras)
    told.append(Fact("size", _listed([_size_text(size) for size in sizes])))
    if found.points is not None and len(found.points):
        told.append(Fact("points", f"{len(found.points)} of a reconstruction"))
    return told + _lens_facts(cameras)


def _listed(names: list[str]) -> str:
    return ", ".join(names[:TOLD]) + (", ..." if len(names) > TOLD else "")


def _lens_facts(cameras: Sequence[PosedCamera]) -> list[Fact]:
    found = {"lens": lens_text(cameras), "distortion": lens_text(cameras, ignored=True)}
    return [Fact(name, text) for name, text in found.items() if text]


def _of_one(posed: PosedCamera) -> list[Fact]:
    """Return a line for each value of the camera that the file has; see as_data()."""
    values = _camera_data(posed) | {"size": _size_text(posed.size)}
    told = [
        Fact(name, _text(value))
        for name, value in values.items()
        if value not in (None, "", False)
        and name not in ("lens", "ignored")
        and (name != "image" or value != posed.name)
    ]
    if values["K"] is not None:
        told.append(Fact("", "K, R and t count pixels from the centre of the first one"))
    return told + _lens_facts([posed])


def _text(value: Any) -> str:
    """Return a flag, a text, a number, a vector or a matrix as text."""
    if value is True:
        return "true"
    if isinstance(value, str):
        return value
    if not isinstance(value, list):
        return _number(value)
    if isinstance(value[0], list):
        return ", ".join(map(_text, value))
    numbers = np.array(value)
    numbers[np.abs(numbers) < ROUNDING * np.abs(numbers).max()] = 0.0
    return "(" + ", ".join(map(_number, numbers.tolist())) + ")"


def basis_text(camera: Camera) -> str:
    """Describe whether a basis is orthonormal, and its handedness."""
    hand = "right-handed" if camera.determinant > 0 else "left-handed: the picture is mirrored"
    error = float(np.abs(camera.basis.T @ camera.basis - np.eye(3)).max())
    if error <= NEARLY:
        within = "" if error <= EXACT else f" within {error:.1g}"
        return f"orthonormal{within}, {hand}"
    found = measures(camera.u, camera.v, camera.w)
    pairs = zip(("u and v", "v and w", "w and u"), found.angles_deg, strict=True)
    skewed = [
        f"{pair} at {_number(angle)} degrees" for pair, angle in pairs if abs(angle - 90) > 1e-4
    ]
    lengths = zip("uvw", found.lengths, strict=True)
    scaled = [f"|{name}| = {_number(length)}" for name, length in lengths if abs(length - 1) > 1e-6]
    what = "skewed" if skewed else "orthogonal"
    return f"{what}, {', '.join([*skewed, *scaled])}, {hand}"


def as_data(found: CameraSet, chosen: PosedCamera | None = None) -> dict[str, Any]:
    """Return the same as JSON values.

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
    camera, size = _for_own_size(posed), posed.size
    pixels = None if size is None or camera.is_parallel else camera.intrinsics(size)
    return {
        "name": posed.name,
        "image": posed.image,
        "size": None if size is None else list(size),
        "eye": list(camera.eye),
        "u": list(camera.u),
        "v": list(camera.v),
        "w": list(camera.w),
        "distance": camera.distance,
        "viewport": list(camera.viewport),
        "fit": posed.fit,
        "projection": camera.projection,
        "near": camera.near,
        "far": camera.far,
        "fov_deg": None if camera.is_parallel else [camera.fov_x_deg, camera.fov_y_deg],
        "basis": basis_text(camera),
        "K": None if pixels is None else pixels.K.tolist(),
        "R": None if pixels is None else pixels.R.tolist(),
        "t": None if pixels is None else pixels.t.tolist(),
        "lens": _lens_data(posed, camera.lens),
        "ignored": _lens_data(posed, posed.ignored),
    }


def _lens_data(posed: PosedCamera, lens: Lens | None) -> dict[str, Any] | None:
    if lens is None:
        return None
    sizes = [None, None] if posed.size is None else shift_px(posed.camera, lens, posed.size)
    moved = dict(zip(("median_px", "largest_px"), sizes, strict=True))
    return {"model": lens.model, **moved, **lens.coefficients}


def _for_own_size(posed: PosedCamera) -> Camera:
    view = View(posed.camera, posed.fit)
    return view.camera if posed.size is None else view.for_size(posed.size)


def _size_text(size: Size | None) -> str:
    return "of any size" if size is None else f"{size[0]}x{size[1]}"


def _number(value: float) -> str:
    return f"{value + 0.0:.7g}"  # + 0.0: no negative zero
