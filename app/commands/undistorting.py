"""`lucida camera FILE --undistort OUT`: cameras without their lenses, and what they photographed.

OUT has the layout of FILE's format: COLMAP's images/ and sparse/, otherwise the file of cameras and
next to it the photographs, named as in it.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path, PurePosixPath

import numpy as np
from PIL import Image

from app.commands.arguments import counted
from app.photograph.reading import decoded
from renderer.atomic import atomic_write
from renderer.camera_formats import CameraSet, Options, PosedCamera, written
from renderer.camera_formats.colmap import points_text
from renderer.camera_formats.given import Given
from renderer.errors import LucidaError, one_line
from renderer.undistort import undistorted, undistorted_camera

_ANY_SIZE = 1 << 30  # pixels a side: a photograph is read whole
_QUALITY = 95  # of JPEG and WebP
_SHAPE = 0.01  # relative: by which a photograph's proportions may differ from its camera's


def undistort(
    source: Given,
    found: CameraSet,
    cameras: Sequence[PosedCamera],
    out: Path,
    options: Options,
    progress: Callable[[float], None],
) -> list[str]:
    """Write OUT, a new folder. Return what was done, a line each.

    cameras: those of `found` to write. A photograph that is missing or broken, or has other
    proportions than its camera, is left out and reported. Raises LucidaError.
    """
    _check_new(out)
    for posed in cameras:
        if posed.size is None:
            raise LucidaError("--size", "is missing: INPUT has no image size", "give --size WxH")
    named = [replace(posed, name=_inside(posed)) for posed in cameras]
    is_model = found.format == "colmap"
    files = written([_without_lens(posed) for posed in named], found.format, options)
    if found.points is not None and found.point_colors is not None:
        files["points3D.txt"] = points_text(found.points, found.point_colors)
    own_name = source.path.name if source.path and not source.is_folder else "cameras"
    pictures, folder = (out / "images", out / "sparse") if is_model else (out, out)
    folder.mkdir(parents=True, exist_ok=True)
    lines: list[str] = []
    pairs = [(one, other) for one, other in zip(cameras, named, strict=True) if one.image]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(_photograph, one, pictures / other.name) for one, other in pairs]
        try:
            for done, job in enumerate(jobs, 1):
                try:
                    job.result()
                except LucidaError as error:
                    lines.append(f"left out: {one_line(str(error))}")
                progress(done / len(jobs))
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    for name, data in files.items():
        with atomic_write(folder / (name or own_name)) as file:
            file.write(data)
    told = counted((len(cameras), "camera"), (len(jobs) - len(lines), "photograph"))
    return [f"{one_line(str(out))}: {found.format}, {told}", *lines]


def _check_new(out: Path) -> None:
    try:
        if os.path.lexists(out) and (not out.is_dir() or any(out.iterdir())):
            raise LucidaError("--undistort", f"{str(out)!r} exists", "give a new folder's name")
        out.mkdir(exist_ok=True)
    except OSError as error:
        problem = f"{str(out)!r} cannot be made: {error.strerror}"
        raise LucidaError("--undistort", problem, "give another folder") from None


def _inside(posed: PosedCamera) -> str:
    """Return a photograph's name, with its ending, without parts that lead out of its folder."""
    name = PurePosixPath((posed.name or posed.image).replace("\\", "/"))
    ending = "" if name.suffix else PurePosixPath(posed.image).suffix
    parts = [part for part in name.parts if part.strip("/.") and ":" not in part]
    return "/".join(parts) + ending


def _without_lens(posed: PosedCamera) -> PosedCamera:
    if posed.camera.lens is None or posed.size is None:
        return posed
    camera, size = undistorted_camera(posed.camera.pinhole, posed.camera.lens, posed.size)
    return replace(posed, camera=camera, size=size)


def _photograph(posed: PosedCamera, target: Path) -> None:
    """Write a camera's photograph without its lens. Raises LucidaError."""
    assert posed.size is not None
    photograph = decoded(Path(posed.image), (_ANY_SIZE, _ANY_SIZE))
    (width, height), (own_width, own_height) = photograph.size, posed.size
    if abs(width * own_height / (height * own_width) - 1) > _SHAPE:
        problem = f"is {width}x{height}, its camera's image {own_width}x{own_height}"
        raise LucidaError("", problem, "give the photograph of this camera", posed.image)
    pixels = photograph.pixels
    if posed.camera.lens is not None:
        pixels = undistorted(pixels, posed.camera.pinhole, posed.camera.lens, posed.size)
    alpha = pixels[..., 3:]
    endings = Image.registered_extensions()
    kind = endings.get(target.suffix.lower(), "PNG")
    if photograph.pixels[..., 3].min(initial=255) == 255 or kind == "JPEG":
        picture = Image.fromarray(pixels[..., :3])
    else:  # from colours times alpha
        straight = pixels[..., :3].astype(np.float32) * 255 / np.maximum(alpha, 1)
        straight = np.rint(np.minimum(straight, 255)).astype(np.uint8)
        picture = Image.fromarray(np.concatenate([straight, alpha], axis=2))
    target.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(target) as file:
        picture.save(file, kind, quality=_QUALITY)
