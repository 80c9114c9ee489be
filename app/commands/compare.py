"""`lucida compare`: compare raster with ray, in numbers and as a picture."""

from __future__ import annotations

import argparse
import json

from lucida.app.cameras.options import add_camera_options

from . import arguments as common
from .given_camera import add_view_option

NAME = "compare"

DESCRIPTION = """\
Draw a scene with both renderers and compare object, depth, normal and colour at every pixel.
A difference is explained if the pixel's centre lies within 1/128 pixel of a line at which
the exact image jumps: a rasterizer snaps vertices to a grid that fine. Through a lens, it may
also lie within half a texel of such a line in the image that was looked up."""

EPILOG = """\
The picture shows the raster image dark, with the differing pixels in their causes' colours:
edge light blue, pattern olive, clip purple, lookup light green; unexplained vermilion, or pink
where only the colour differs. The window's view Compare shows how much they differ.
exit status: 0 no unexplained pixels, 1 some, or nothing is hit in either image, so that nothing
was compared; 2 a mistake or a failure, 130 interrupted

examples:
  lucida compare spheres
  lucida compare bunny.obj --view corner.toml --size 640x480 -o difference.png
  lucida compare bunny.obj --json"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    add_view_option(parser)
    add_camera_options(parser)
    common.add_size_option(parser)
    parser.add_argument(
        "-o", "--output", metavar="DIFF.png", help="write the picture (.png .ppm .pgm .pbm)"
    )
    parser.add_argument(
        "--backend", choices=common.BACKENDS, default="auto", help=common.BACKEND_HELP
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.compare.raster_and_ray import compare
    from lucida.renderer.images import PICTURES, check_image_path, write_picture

    if arguments.output is not None:
        check_image_path(arguments.output, PICTURES)
    scene, camera = common.scene_and_camera(arguments)
    with common.progress_bar("compare") as progress:
        comparison = compare(
            scene,
            camera,
            arguments.size,
            arguments.backend,
            progress,
        )
    if arguments.output is not None:
        write_picture(arguments.output, comparison.difference_image())
    if arguments.json:
        print(json.dumps(comparison.to_dict(), indent=2, allow_nan=False))
    else:
        print(comparison.summary())
    if comparison.nothing_hit:
        common.say_nothing_is_hit(scene, camera)
    return 1 if comparison.unexplained or comparison.nothing_hit else 0
