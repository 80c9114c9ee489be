"""`lucida render` of many pictures: the parts of a large image, or the cameras of a data set."""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from lucida.app.cameras.films.encoding import image_writer
from lucida.app.cameras.films.film import Film
from lucida.app.cameras.films.frames import Look, Shot
from lucida.app.cameras.options import with_camera_options
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras import PosedCamera, read_cameras
from lucida.renderer.images.frame import LARGEST_PIXELS, check_size, stored
from lucida.renderer.scene import flatten
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.scene.precision import check_precision
from lucida.renderer.system.atomic import file_stem
from lucida.renderer.system.errors import LucidaError, counted, one_line

from . import arguments as common
from .given_camera import say_notes
from .many import look_of, make_film

JOINED = (".png", ".exr")  # formats of an image in parts
PART_PIXELS = 1 << 21
BLOCK = 32  # rows: parts that begin at its multiples equal the whole image, bit for bit


def parts_of(size: Size) -> list[tuple[int, int]]:
    """Return the rows of an image's parts: the first, and the one past the last."""
    width, height = size
    step = max(1, PART_PIXELS // (width * BLOCK)) * BLOCK
    return [(first, min(first + step, height)) for first in range(0, height, step)]


def render_in_parts(
    scene: Scene, camera: Camera, arguments: argparse.Namespace, ending: str
) -> int:
    """Draw an image in parts, and join them. Raises LucidaError if the format does not allow it."""
    _check_joined(arguments, ending)
    start_s, size, path = time.perf_counter(), arguments.size, Path(arguments.output)
    if arguments.renderer == "raster":
        check_precision(camera, size, lambda: flatten(scene))
    shots = [Shot(camera, size, rows) for rows in parts_of(size)]
    look = _look(arguments, ending)
    film = Film(path, scene, shots, look, image_writer(stored(arguments.channel), size))
    make_film(film, arguments, "parts")
    print(
        f"{one_line(arguments.output)}: {arguments.channel}, {arguments.renderer}, "
        f"{size[0]}x{size[1]}, {time.perf_counter() - start_s:.1f} s"
    )
    return 0


def _look(arguments: argparse.Namespace, ending: str) -> Look:
    return replace(look_of(arguments), channel=arguments.channel, ending=ending)


def render_all(arguments: argparse.Namespace) -> int:
    """Draw an image for each camera of a data set, named like its photograph."""
    if arguments.view is None:
        raise LucidaError("argument --all", "has no cameras", "give a data set by --view")
    start_s, given = time.perf_counter(), arguments.size
    found = read_cameras(arguments.view)
    scene, _ = common.scene_and_view(arguments, found.cameras[0])
    say_notes(found, arguments.view)
    shots = []
    for posed in found.cameras:
        size = check_size(given or posed.size or common.DEFAULT_SIZE)
        view = with_camera_options(arguments, View(posed.camera, posed.fit))
        shots.append(Shot(view.for_size(size), size))
    look = _look(arguments, arguments.format or ".png")
    names = file_names(found.cameras)
    make_film(Film(Path(arguments.output), scene, shots, look, None, names), arguments, "images")
    print(
        f"{one_line(arguments.output)}: {counted((len(shots), 'image'))}, "
        f"{arguments.channel}, "
        f"{arguments.renderer}, {time.perf_counter() - start_s:.1f} s"
    )
    return 0


def file_names(cameras: Sequence[PosedCamera]) -> list[str]:
    """Return names of files without an ending: those of the photographs, or else of the cameras;
    numbers if they are not all different.
    """
    names = [file_stem(Path(one.image or one.name).stem, "._- ") for one in cameras]
    if "" in names or len({name.lower() for name in names}) < len(names):
        return [f"{number:06d}" for number in range(len(cameras))]
    return names


def _check_joined(arguments: argparse.Namespace, ending: str) -> None:
    width, height = arguments.size
    field, problem = "argument --workers", "draws an image in parts"
    if width * height > LARGEST_PIXELS:
        field, problem = "argument --size", f"{width}x{height} is drawn in parts"
    if ending not in JOINED:
        raise LucidaError(field, f"{problem}, which {ending} cannot be", "give .png or .exr")
    if ending == ".png" and stored(arguments.channel) == "depth":
        problem += ", which have no nearest hit in common"
        raise LucidaError(field, problem, "give .exr for the depth")
