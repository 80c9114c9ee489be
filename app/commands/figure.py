"""`lucida figure`: write the outside view, an image or both, or the probe as a figure."""

from __future__ import annotations

import argparse
from typing import get_args

from lucida.app.cameras.options import add_camera_options
from lucida.renderer.system.errors import LucidaError, one_line

from . import arguments as common
from .given_camera import add_view_option

NAME = "figure"

DESCRIPTION = """\
Write a figure for slides or a paper: the scene and its camera from outside, an image or both, or
the formulas of a pixel. The window's File > Export figure does the same."""

EPILOG = """\
formats, by OUT's ending:
  .svg  lines and letters as vectors, over the shaded scene
  .pdf  the same, printed by Chromium or Chrome
  .png  pixels
  .tex  with --what probe: the formulas as LaTeX

examples:
  lucida figure still-life -o camera.svg
  lucida figure bunny.obj -o pair.png --what pair --size 1920x960 --ground transparent
  lucida figure spheres -o ray.pdf --mark 300,400 --scale 1.5
  lucida figure spheres -o pixel.tex --what probe --mark 300,400

exit status: 0 written, 2 a mistake; then nothing is written"""


def configure(parser: argparse.ArgumentParser) -> None:
    from lucida.app.state.bounds import range_of
    from lucida.app.window.figure_choice import FigureChoice, Ground, What

    parser.description, parser.epilog = DESCRIPTION, EPILOG
    least, most = range_of(FigureChoice, "scale")
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the file to write")
    parser.add_argument(
        "--what",
        choices=get_args(What),
        default="outside",
        help="the outside view, an image, both, or a pixel's formulas (default: outside)",
    )
    parser.add_argument(
        "--ground",
        choices=get_args(Ground),
        default="white",
        help="the background; shown: as in the window (default: white)",
    )
    parser.add_argument(
        "--scale",
        type=common.real(
            lambda scale: least <= scale <= most, f"is not a scale; give {least:g} to {most:g}"
        ),
        default=1.0,
        help="scale of lines and letters (default: 1)",
    )
    parser.add_argument(
        "--mark", type=_pixel, metavar="ROW,COLUMN", help="a pixel whose ray is shown, from 0"
    )
    common.add_size_option(parser)
    add_view_option(parser)
    add_camera_options(parser)


def _pixel(text: str) -> tuple[int, int]:
    row, comma, column = text.partition(",")
    if not (comma and row.strip().isdecimal() and column.strip().isdecimal()):
        raise argparse.ArgumentTypeError(f"{text!r} is not a pixel; give e.g. 300,400")
    return int(row), int(column)


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.window.figure_choice import FigureChoice, check_ending
    from lucida.renderer.camera.image_plane import has_pixel
    from lucida.renderer.system.atomic import atomic_write, check_writable

    check_writable(arguments.output)
    ending = check_ending(arguments.output)
    scene, view = common.scene_and_view(arguments)
    if arguments.mark is not None and not has_pixel(arguments.size, arguments.mark):
        raise LucidaError("argument --mark", "is outside of the image", "change it, or --size")
    if arguments.what == "probe" and arguments.mark is None:
        raise LucidaError("--what probe", "shows no pixel", "add --mark ROW,COLUMN")
    choice = FigureChoice(arguments.what, arguments.size, arguments.scale, arguments.ground)
    from lucida.app.window.launch import draw_figure  # loads the window

    written = draw_figure(scene, view, choice, ending, arguments.mark)
    with atomic_write(arguments.output) as file:
        file.write(written)
    width, height = arguments.size
    common.say(f"{one_line(arguments.output)}: {arguments.what}, {width}x{height}")
    return 0
