"""NeRF's cameras: transforms.json as the synthetic scenes, instant-ngp and nerfstudio write it.

transform_matrix is camera-to-world, with OpenGL's axes: x right, y up, looking along -z.
Sources: nerfstudio's documentation, "Data conventions"; instant-ngp, "NeRF dataset tips".
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import listed
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import check_for_lens, pixel_offset, viewport_of
from lucida.renderer.files.cameras import nerf_lens
from lucida.renderer.files.cameras.distortion import FileLens
from lucida.renderer.files.cameras.entries import (
    ORIGIN_TOLD,
    affine,
    in_image,
    is_rotation,
    number_of,
    size_of,
)
from lucida.renderer.files.cameras.given import Given, Options
from lucida.renderer.files.cameras.nerf_lens import (
    NAMES,
    PANORAMA,
    coefficients,
    is_panorama,
    lens_in,
    model_for,
)
from lucida.renderer.files.cameras.posed import CameraSet, PosedCamera
from lucida.renderer.files.cameras.rigid import pinhole, pose_of
from lucida.renderer.files.cameras.unused import entries_of, notes_on
from lucida.renderer.system.errors import LucidaError, errors_as, under

Table = Mapping[str, Any]

LENSES = nerf_lens.LENSES

# All entries that determine a camera's optics, as opposed to its pose.
_OPTICAL = {
    *("fl_x", "fl_y", "cx", "cy", "w", "h", "camera_angle_x", "camera_angle_y"),
    *("camera_model", "is_fisheye"),
    *NAMES,
}
_USED = {"frames", "transform_matrix", "file_path"}
_HARMLESS = """
aabb* renderaabb* *filename* *filepath* *path up camera*id cameralabel colmapimid rotation sharpness
sharpen* *depth* *mask* *semantic* orientationoverride nextralearnabledims *transparent fixpremult
wantimportance image*id *bounds near far time timestamp split
"""
_APPLIED = "it was applied to the poses, which are shown as they are in the file"
_OF_PROGRAM = "the program's own units; the poses are shown as they are in the file"
_MEANINGS = {
    "applied*": _APPLIED,
    "scale": _OF_PROGRAM,
    "offset": _OF_PROGRAM,
    "fisheyecropradius": "pixels outside of it are masked; the whole image's camera is shown",
    "?fov": "degrees from edge to edge; fl_x or camera_angle_x is used",
}
# instant-ngp's lenses and axes that are not in camera_model; its equirectangular one is Lambert's.
_REFUSED = {
    "equirectangular": "is a lens that is not supported",
    "orthographic": "is a lens that is not supported",
    "fthetap*": "is an f-theta lens's",
    "frommitsuba": "turns the axes of the poses",
    "rollingshutter": "takes the rows of an image from different places",
}
_ENDING = re.compile(r"[^.]\.[A-Za-z]\w*\Z")
_SHARED = 1e-12  # relative: frames' numbers that differ by less are written once


def recognises(given: Given) -> bool:
    table = given.json
    frames = table.get("frames") if isinstance(table, dict) else None
    return isinstance(frames, list) and any(
        isinstance(part, dict) and "transform_matrix" in part for part in (table, *frames)
    )


def read(given: Given, options: Options) -> CameraSet:
    table = given.json
    if not isinstance(table, dict):
        raise LucidaError("", "is no JSON object", "give a transforms.json")
    frames = table.get("frames")
    if not isinstance(frames, list):
        raise LucidaError("frames", "is missing" if frames is None else "is no list", "give frames")
    if not frames:
        raise LucidaError("frames", "is empty", "give a frame with its transform_matrix")
    folder = given.path and given.path.parent
    size, sizing = _size_for_all(table, frames, folder, options)
    origin = options.pixel_origin or "corner"
    shared = {name: value for name, value in table.items() if name in _OPTICAL}
    optics: dict[str, _Optics] = {}  # by all the values that determine them
    disagree = False
    cameras = []
    for i, frame in enumerate(frames):
        if not isinstance(frame, dict):
            raise LucidaError(f"frames[{i}]", "is no JSON object", "give a transform_matrix")
        try:
            pose = _pose({**table, **frame})
            own = {name: value for name, value in frame.items() if name in _OPTICAL}
            key = repr(own) if own else ""
            if key not in optics:
                optical = {**shared, **own}
                optics[key] = _optics(optical, size, origin, options)
                disagree = disagree or _disagree(optical)
            name = frame.get("file_path", table.get("file_path", ""))
            cameras.append(_camera(pose, optics[key], name, folder))
        except LucidaError as error:
            inside = error.field in ("transform_matrix", *frame)
            raise error.within(f"frames[{i}]") if inside else error from None
    told = ["transform_matrix takes the camera's points to the world"]
    told += ["axes x right, y up, looking along -z (OpenGL)", ORIGIN_TOLD[origin]]
    if not is_rotation(np.array([(c.camera.u, c.camera.v, c.camera.w) for c in cameras])):
        told.append("transform_matrix is no rotation, and held as it is")
    if disagree:
        told.append("fl_x is taken: camera_angle_x is another angle than fl_x and w make")
    notes = notes_on(_unused(table, frames), _HARMLESS, _MEANINGS, _REFUSED)
    notes = (sizing, *notes) if sizing else notes
    return CameraSet("nerf", tuple(cameras), (*told, *notes), notes=notes)


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    origin = options.pixel_origin or "corner"
    model, frames = model_for(cameras), []
    for i, posed in enumerate(cameras):
        with under(posed.name):
            frames.append(_frame(posed, i, options, origin, model))
    shared = {
        name: value
        for name, value in (frames[0].items() if frames else ())
        if isinstance(value, int | float)
        and all(math.isclose(frame[name], value, rel_tol=_SHARED) for frame in frames)
    }
    own = [{name: frame[name] for name in frame if name not in shared} for frame in frames]
    is_fisheye = {"is_fisheye": True} if model == "OPENCV_FISHEYE" else {}  # for instant-ngp
    table = {"camera_model": model, **is_fisheye, **shared, "frames": own}
    return {"": (json.dumps(table, indent=2, ensure_ascii=False) + "\n").encode()}


def _unused(table: Table, frames: Sequence[Table]) -> Iterator[tuple[str, Any]]:
    """Yield the values that are not used, of the file and of its frames."""
    for part in (table, *frames):
        for name, value in part.items():
            if name not in _USED | _OPTICAL:
                yield from entries_of({name: value})


def _size_for_all(
    table: Table, frames: Sequence[Any], folder: Path | None, options: Options
) -> tuple[Size | None, str]:
    """Return the size for frames that have none, and its origin in words."""
    lacking = [
        frame for frame in frames if isinstance(frame, dict) and not {"w", "h"} & {*table, *frame}
    ]
    if not lacking or options.size is not None:
        return options.size, ""
    image = _image(lacking[0].get("file_path", ""), folder)
    if found := _size_of_image(image):
        return found, f"no w and h: the size of {image}, {found[0]} x {found[1]}"
    return None, "no w and h, nor an image: a square one is taken"


def _size_of_image(path: str) -> Size | None:
    """Return the size of an existing image. Return None if it cannot be read; viewers of the image
    report the error.
    """
    from PIL import Image

    try:
        if Path(path).is_file():  # reading from a pipe might never end
            with Image.open(path) as image:
                return image.size
    except (OSError, ValueError, Image.DecompressionBombError, Image.DecompressionBombWarning):
        pass
    return None


def _image(name: object, folder: Path | None) -> str:
    """Return the photograph's path; the synthetic scenes omit its ending. Raises LucidaError."""
    if not isinstance(name, str):
        raise LucidaError("file_path", f"{name!r} is no text", "give the image's path")
    if not name:
        return ""
    path = (folder or Path()) / PurePosixPath(name.replace("\\", "/"))
    return str(path if _ENDING.search(path.name) else path.with_name(f"{path.name}.png"))


def _pose(table: Table) -> list[Any]:
    """Return (u, v, w, eye) of one frame. Raises LucidaError."""
    if "transform_matrix" not in table:
        raise LucidaError("transform_matrix", "is missing", "give 4 x 4 numbers")
    columns: list[Any] = affine("transform_matrix", table["transform_matrix"])[:3].T.tolist()
    return columns


class _Optics(NamedTuple):
    """Everything about a frame but its pose.

    viewport: at distance 1. signs: factors of u and v, -1 for a mirrored image.
    """

    size: Size | None
    viewport: tuple[float, float, float, float]
    signs: tuple[int, int] = (1, 1)
    lens: FileLens = FileLens(None, None)


def _camera(pose: list[Any], optics: _Optics, name: object, folder: Path | None) -> PosedCamera:
    image = _image(name, folder)
    u, v, w, eye = map(tuple, pose)
    if optics.signs != (1, 1):
        u, v = (
            tuple(sign * part for part in axis)
            for axis, sign in zip((u, v), optics.signs, strict=True)
        )
    try:
        camera = Camera(eye, u, v, w, 1.0, optics.viewport, lens=optics.lens.used)
    except LucidaError as error:
        if error.field not in ("u", "v", "w"):
            raise
        problem = f"has columns {listed(u)}, {listed(v)} and {listed(w)}: it has no inverse"
        raise LucidaError("transform_matrix", problem, "give a rotation") from None
    name = str(name).removeprefix("./")
    return PosedCamera(camera, optics.size, name, image, ignored=optics.lens.ignored)


def _optics(table: Table, size: Size | None, origin: str, options: Options) -> _Optics:
    """Return the optics of a table.

    table: optical entries only, so that frames with equal entries share their optics. size: for
    tables without one. Raises LucidaError.
    """
    if "w" in table or "h" in table:
        for name in "wh":
            if name not in table:
                raise LucidaError(name, "is missing", "give w and h, or neither and --size WxH")
        size = size_of("w", table["w"], table["h"])
    if size is None:
        half = _half_of_square(table)
        return _Optics(None, (-half, half, -half, half), lens=lens_in(table, options))
    fx, fy, cx, cy = _intrinsics(table, size)
    if table.get("camera_model") == PANORAMA:
        fx, fy = fx / math.pi, fy / math.pi
    with errors_as("fl_x"):
        viewport = viewport_of(fx, fy, cx, cy, size, origin)
    lens = lens_in(table, options)
    signs = (-1 if fx < 0 else 1, -1 if fy < 0 else 1)
    if lens.used is not None:
        with errors_as("fl_x"):
            check_for_lens(np.diag([fx, fy, 1.0]))
    return _Optics(size, viewport, signs, lens)


def _disagree(table: Table) -> bool:
    """Return True if both forms of the focal length are given and differ by more than 1 %."""
    angle = table.get("camera_angle_x")
    if not isinstance(angle, float) or not 0 < angle < math.pi or not {"fl_x", "w"} <= table.keys():
        return False
    fx = table["w"] / 2 / math.tan(angle / 2)
    return not math.isclose(fx, table["fl_x"], rel_tol=0.01)


def _half_of_square(table: Table) -> float:
    """Return half the width, at distance 1, of an image of which only the angle is known."""
    if is_panorama(table) or "fl_x" in table or "camera_angle_x" not in table:
        raise LucidaError("w", "is missing", "give w and h, or --size WxH")
    return _half_width(table, "camera_angle_x")


def _half_width(table: Table, name: str) -> float:
    """Return half the image's width at distance 1, from its angle in radians."""
    angle = number_of(name, table[name])
    if not 0 < angle < math.pi:
        problem = f"{angle:g} is not between 0 and pi"
        raise LucidaError(name, problem, "give the angle from edge to edge in radians")
    return math.tan(angle / 2)


def _intrinsics(table: Table, size: Size) -> tuple[float, float, float, float]:
    """Return fx, fy, cx and cy."""
    width, height = size

    if table.get("latlong"):  # of the whole sphere
        return width / (2 * math.pi), height / math.pi, width / 2, height / 2

    def entry(name: str, default: float) -> float:
        return number_of(name, table[name]) if name in table else default

    if not {"fl_x", "camera_angle_x"} & table.keys():
        raise LucidaError("fl_x", "is missing", "give fl_x or camera_angle_x")
    by_angle = "fl_x" not in table
    fx = width / 2 / _half_width(table, "camera_angle_x") if by_angle else entry("fl_x", 0.0)
    fy = fx
    if by_angle and "camera_angle_y" in table and "fl_y" not in table:
        fy = height / 2 / _half_width(table, "camera_angle_y")
    return fx, entry("fl_y", fy), entry("cx", width / 2), entry("cy", height / 2)


def _frame(
    posed: PosedCamera, index: int, options: Options, origin: str, model: str
) -> dict[str, Any]:
    camera, size = in_image(posed, options, "NeRF")
    camera, (fx, fy, cx, cy) = pinhole(camera, size, "NeRF")
    offset, frame = pixel_offset(origin), coefficients(camera.lens, model)
    if model == PANORAMA:
        fx, fy = math.pi * fx, math.pi * fy
    else:
        angles = zip("xy", size, (fx, fy), strict=True)
        frame |= {f"camera_angle_{axis}": 2 * math.atan(side / 2 / f) for axis, side, f in angles}
    return {
        "file_path": posed.name or posed.image or f"frame_{index:05}",
        "w": size[0],
        "h": size[1],
        "fl_x": fx,
        "fl_y": fy,
        "cx": cx - offset,
        "cy": cy - offset,
        **frame,
        "transform_matrix": pose_of(camera).tolist(),
    }
