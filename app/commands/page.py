"""`lucida page`: write a scene as one HTML page that works in any browser."""

from __future__ import annotations

import argparse

from lucida.app.cameras.options import add_camera_options
from lucida.renderer.system.errors import one_line

from . import arguments as common
from .given_camera import add_view_option

NAME = "page"

DESCRIPTION = """\
Write a scene as one HTML page: both images, the outside view and a pixel's ray, live, in any
browser, from a disk or a web site. The page is complete: it loads nothing else."""

EPILOG = """\
The raster image needs WebGL 2; the ray image does not. docs/page.md says how to put a page into a
course's site.

examples:
  lucida page still-life -o still-life.html
  lucida page bunny.obj -o bunny.html --eye 0,1,4

exit status: 0 written, 2 a mistake, or a scene that is too large; then nothing is written"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the page, .html")
    parser.set_defaults(size=None)  # a page's images fit the available space
    add_view_option(parser)
    add_camera_options(parser)


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.web.scene_page import check_page_path, write_scene_page

    check_page_path(arguments.output)
    scene, view = common.scene_and_view(arguments)
    size = write_scene_page(arguments.output, scene, view)
    common.say(f"{one_line(arguments.output)}: {size / 1e6:.2f} MB")
    return 0
