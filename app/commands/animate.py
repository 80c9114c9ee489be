"""`lucida animate`: a film of a scene."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.app.cameras.options import add_camera_options
from lucida.renderer.system.errors import LucidaError, counted, one_line

from . import arguments as common
from .given_camera import add_view_option
from .many import add_workers_options, look_of, make_film
from .render import check_effects

if TYPE_CHECKING:
    from lucida.renderer.camera.camera import Camera
    from lucida.renderer.scene.focus import Focus
    from lucida.renderer.scene.model import View

NAME = "animate"

DESCRIPTION = "Draw a film: a scene, seen by a camera that moves."

EPILOG = """\
OUT is a film (.mp4 with H.264), or a folder of PNGs if it has no ending or ends with a slash. Run
the same command again after a break: it continues where it stopped.

examples:
  lucida animate still-life --orbit -o orbit.mp4
  lucida animate spheres --dolly-zoom --seconds 3 -o vertigo.mp4
  lucida animate bunny.obj --path keys.toml -o frames --renderer ray --samples 16 --workers 4
  lucida animate scene.toml --orbit -o orbit.mp4 --scheduler tcp://cluster:8786

exit status: 0 written, 2 a mistake or a failure, 130 interrupted"""

LONGEST = 100_000  # frames


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the film (see below)")
    path = parser.add_argument_group("the camera's path").add_mutually_exclusive_group(
        required=True
    )
    path.add_argument("--orbit", action="store_true", help="once around the scene")
    path.add_argument(
        "--dolly-zoom",
        action="store_true",
        help="move back and zoom in: the subject keeps its size",
    )
    path.add_argument(
        "--path", metavar="KEYS", help="through the cameras of this file (docs/animation.md)"
    )
    parser.add_argument(
        "--seconds",
        type=common.real(lambda s: 0 < s <= 3600, "is not a time; give up to 3600"),
        metavar="S",
        help="length of the film (default: 4, or as KEYS says)",
    )
    parser.add_argument(
        "--fps",
        type=common.real(lambda f: 0.1 <= f <= 240, "is not a rate; give 0.1 to 240"),
        default=30.0,
        metavar="F",
        help="frames a second (default: 30)",
    )
    parser.add_argument(
        "--renderer", choices=("raster", "ray"), default="raster", help="(default: raster)"
    )
    common.add_size_option(parser)
    common.add_drawing_options(parser)
    add_workers_options(parser, "frames")
    add_view_option(parser)
    add_camera_options(parser)


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.cameras.films.encoding import film_writer
    from lucida.app.cameras.films.film import Film
    from lucida.app.cameras.films.frames import Shot
    from lucida.renderer.scene.focus import scene_focus

    if arguments.renderer == "raster":
        check_effects(arguments)
    scene, view = common.scene_and_view(arguments)
    look, path = look_of(arguments), Path(arguments.output)
    cameras = _cameras(arguments, view, scene_focus(scene))
    is_folder = arguments.output.endswith(("/", os.sep))
    write = None if is_folder else film_writer(path, arguments.size, arguments.fps)
    shots = [Shot(camera, arguments.size) for camera in cameras]
    make_film(Film(path, scene, shots, look, write), arguments, "frames")
    print(
        f"{one_line(arguments.output)}: {counted((len(cameras), 'frame'))}, "
        f"{arguments.size[0]}x{arguments.size[1]}, {len(cameras) / arguments.fps:.4g} s"
    )
    return 0


def _cameras(arguments: argparse.Namespace, view: View, focus: Focus) -> list[Camera]:
    from lucida.app.cameras.films.paths import around, dolly_zoom, through

    size, keys = arguments.size, None
    if arguments.path is not None:
        from lucida.app.cameras.films.key_file import load_keys

        keys = load_keys(arguments.path)
    seconds = arguments.seconds or (sum(key.seconds for key in keys[:-1]) if keys else 4.0)
    count = max(1, round(seconds * arguments.fps))
    if count > LONGEST:
        raise LucidaError("--fps", f"{count} frames are too many", f"stay within {LONGEST}")
    if keys is not None:
        return through(keys, focus, size, count)
    make = around if arguments.orbit else dolly_zoom
    return make(view, focus, size, count)
