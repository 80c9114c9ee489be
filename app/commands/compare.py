"""`lucida compare`: compare raster with ray, in numbers and as a picture."""

from __future__ import annotations

import argparse
import json
import math

from lucida.app.cameras.options import add_camera_options
from lucida.app.commands import arguments as common
from lucida.app.commands.given_camera import add_view_option

NAME = "compare"

DESCRIPTION = """\
Draw a scene with both renderers and compare object, depth, normal and colour at every pixel.
A difference is explained if the pixel's centre lies within 1/128 pixel of a line at which
the exact image jumps: a rasterizer snaps vertices to a grid that fine. Through a lens, it may
also lie within half a texel of such a line in the image that was looked up."""

EPILOG = """\
The picture shows the raster image dark, with the differing pixels in their causes' colours:
edge light blue, pattern olive, clip purple, lookup light green; unexplained vermilion, or pink
where only the colour differs. Or it shows the difference in false colours: absolute, black (none)
to white; signed, blue (raster larger) over white (none) to orange (ray larger).
exit status: 0 no unexplained pixels, 1 some, or nothing is hit in either image, so that nothing
was compared; 2 a mistake or a failure, 130 interrupted

examples:
  lucida compare spheres
  lucida compare bunny.obj --view corner.toml --size 640x480 -o difference.png
  lucida compare spheres -o difference.png --show signed --gain 64
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
        "--show",
        choices=("causes", "absolute", "signed"),
        help="what the picture of -o shows (default: causes)",
    )
    parser.add_argument(
        "--channel",
        choices=("color", "depth", "z", "normal", "id"),
        help="the channel of absolute and signed; depth (t) and z differ\n"
        "relative to the ray image's, and therefore equally (default: color)",
    )
    parser.add_argument(
        "--gain",
        type=common.real(
            lambda gain: 0 < gain < math.inf, "is not a gain; give a number above 0, e.g. 16"
        ),
        metavar="G",
        help="the factor of the difference in these (default: 1)",
    )
    parser.add_argument(
        "--backend", choices=common.BACKENDS, default="auto", help=common.BACKEND_HELP
    )
    common.add_lens_options(parser)
    common.add_from_option(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.compare.raster_and_ray import compare
    from lucida.renderer.images import PICTURES, check_image_path, write_picture
    from lucida.renderer.images.frame import stored
    from lucida.renderer.system.errors import LucidaError

    show, channel, gain = arguments.show, arguments.channel, arguments.gain
    if arguments.output is not None:
        check_image_path(arguments.output, PICTURES)
    elif show or channel or gain:
        raise LucidaError("--show, --channel, --gain", "are for the picture", "add -o DIFF.png")
    if (channel or gain) and show in (None, "causes"):
        remedy = "add --show absolute or --show signed"
        raise LucidaError("--channel, --gain", "are not for a picture of causes", remedy)
    scene, camera = common.scene_and_camera(arguments)
    with common.progress_bar("compare") as progress:
        comparison = compare(
            scene,
            camera,
            arguments.size,
            arguments.backend,
            progress,
            arguments.enlargement,
        )
    if arguments.output is not None:
        if show in (None, "causes"):
            picture = comparison.difference_image()
        else:
            compared = stored(channel or "color")
            picture = comparison.false_color(compared, gain or 1.0, show == "signed")
        write_picture(arguments.output, picture)
    if arguments.json:
        print(json.dumps(comparison.to_dict(arguments.indexing), indent=2, allow_nan=False))
    else:
        print(comparison.summary(arguments.indexing))
    if comparison.nothing_hit:
        common.say_nothing_is_hit(scene, camera)
    return 1 if comparison.unexplained or comparison.nothing_hit else 0
