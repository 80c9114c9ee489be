"""`lucida pick`: print what one pixel of an image sees, with the numbers of `render`."""

from __future__ import annotations

import argparse
import json

from lucida.app.cameras.options import add_camera_options
from lucida.renderer.camera.pixels import Pixel
from lucida.renderer.system.errors import LucidaError

from . import arguments as common
from .given_camera import add_view_option

NAME = "pick"

DESCRIPTION = """\
Print what one pixel of an image sees: the object, ray parameter t, distance z, point, normal,
colour.
Rows are counted from the top, columns from the left, both from 0."""

EPILOG = """\
t is measured as in `lucida render --channel depth`: 1 on the image plane in perspective; z is the
distance along -w (`--channel z`). The normal is of unit length and faces the viewer; the colour is
linear light, and sRGB as in a picture.
exit status: 0 done (also if the pixel sees the background), 2 a mistake or a failure,
130 interrupted

examples:
  lucida pick spheres 360 640
  lucida pick bunny.obj 100 200 --size 640x480 --view corner.toml --json"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument("row", type=_whole, metavar="ROW", help="the pixel's row")
    parser.add_argument("column", type=_whole, metavar="COLUMN", help="and its column")
    common.add_size_option(parser)
    add_view_option(parser)
    add_camera_options(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.compare.pixel_report import as_text, picked
    from lucida.renderer.trace import Tracer

    posed = common.own_camera(arguments)
    pixel = _pixel(arguments)
    scene, camera = common.scene_and_camera(arguments, posed)
    # Draw the whole image, so that the pixel is the same as in a file.
    with common.progress_bar("ray") as progress, Tracer(scene) as tracer:
        frame = tracer.render(camera, arguments.size, progress=progress)
    seen = picked(scene, camera, frame, pixel)
    print(json.dumps(seen, indent=2, allow_nan=False) if arguments.json else as_text(seen))
    return 0


def _pixel(arguments: argparse.Namespace) -> Pixel:
    """Return the requested pixel. Raises LucidaError if it is outside the image."""
    width, height = arguments.size
    for name, value, count in (("ROW", arguments.row, height), ("COLUMN", arguments.column, width)):
        if not 0 <= value < count:
            problem = f"{value} is outside an image of {width}x{height}"
            raise LucidaError(name, problem, f"give 0 to {count - 1}")
    return arguments.row, arguments.column


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number; give e.g. 12") from None
