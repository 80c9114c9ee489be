"""`lucida render` of a large image, in parts."""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from pathlib import Path

from lucida.app.cameras.films.encoding import image_writer
from lucida.app.cameras.films.film import Film
from lucida.app.cameras.films.frames import Shot
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.frame import LARGEST_PIXELS, stored
from lucida.renderer.scene import flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.precision import check_precision
from lucida.renderer.system.errors import LucidaError, one_line

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
    look = replace(look_of(arguments), channel=arguments.channel, ending=ending)
    film = Film(path, scene, shots, look, image_writer(stored(arguments.channel), size))
    make_film(film, arguments, "parts")
    print(
        f"{one_line(arguments.output)}: {arguments.channel}, {arguments.renderer}, "
        f"{size[0]}x{size[1]}, {time.perf_counter() - start_s:.1f} s"
    )
    return 0


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
