"""`lucida render`: write one channel of one image to a file."""

from __future__ import annotations

import argparse
from contextlib import closing
from typing import TYPE_CHECKING

from lucida.app.cameras.options import add_camera_options
from lucida.renderer.system.errors import LucidaError, one_line

from . import arguments as common
from .given_camera import add_view_option
from .many import add_workers_options, look_of

if TYPE_CHECKING:
    from lucida.renderer.camera.camera import Camera
    from lucida.renderer.images.frame import Frame
    from lucida.renderer.scene.model import Scene

NAME = "render"

DESCRIPTION = "Draw a scene with one of the two renderers and write one channel into a file."

EPILOG = """\
formats, by OUT's ending:
  .png .ppm   picture: 8-bit sRGB colours
  .pgm .pbm   picture: its gray (luminance), or that thresholded at half, one bit per pixel
  .pfm        numbers: float32, linear light, one or three a pixel
  .exr        numbers: float32 R G B, Z (depth), N.X N.Y N.Z (normal); uint32 id,
              4294967295 where nothing is hit
  .npy        numbers: NumPy arrays, row 0 at the top, as in `channels`

channels:
  color       (H, W, 3) float32, linear light
  depth       (H, W) float32, the ray parameter: 1 on the image plane in perspective;
              inf where nothing is hit. Picture: the nearest hit white, misses black
  z           (H, W) float32, the distance from the eye along -w, in units of w: what
              computer vision calls depth. Otherwise like depth
  normal      (H, W, 3) float32, world space, unit, facing the viewer; 0 where nothing
              is hit. Picture: 0.5 + 0.5 n as red, green, blue
  id          (H, W) int32, the object's index in the scene, -1 where nothing is hit.
              Picture: 14 colours for colour-blind eyes, repeated; misses black

examples:
  lucida render spheres -o spheres.png
  lucida render bunny.obj -o bunny.exr --renderer ray --samples 16
  lucida render still-life -o mirrors.png --renderer ray --shadows --mirrors 4
  lucida render bunny.obj -o depth.npy --channel depth --size 640x480 --view corner.toml
  lucida render bunny.obj -o front.png --eye 0,0.1,0.5 --target 0,0.1,0 --fov 35
  lucida render still-life -o large.png --renderer ray --size 16384x16384 --workers 4

An image of more than 67 million pixels is drawn in parts, up to 16384 a side, as .png or .exr.
After a break, it continues where it stopped.

exit status: 0 written (a line says so if nothing is hit), 2 a mistake or a failure,
130 interrupted"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the file to write")
    parser.add_argument(
        "--renderer",
        choices=("raster", "ray"),
        default="raster",
        help="object order (OpenGL) or image order (CPU) (default: raster)",
    )
    parser.add_argument(
        "--channel",
        choices=("color", "depth", "z", "normal", "id"),
        default="color",
        help="what to write for each pixel (default: color)",
    )
    common.add_size_option(parser, common.large_size)
    add_view_option(parser)
    add_camera_options(parser)
    common.add_drawing_options(parser)
    add_workers_options(parser, "the parts of a large image")


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.cameras.films.frames import with_z
    from lucida.renderer.compare.why_black import hits_nothing
    from lucida.renderer.images import check_image_path, write_image
    from lucida.renderer.images.frame import LARGEST_PIXELS, stored

    if arguments.renderer != "ray":
        check_effects(arguments)
    ending = check_image_path(arguments.output)
    scene, camera = common.scene_and_camera(arguments)
    width, height = arguments.size
    if width * height > LARGEST_PIXELS or arguments.workers > 1 or arguments.scheduler:
        from .render_parts import render_in_parts

        return render_in_parts(scene, camera, arguments, ending)
    frame = draw(scene, camera, arguments)
    if not frame.complete:
        raise KeyboardInterrupt
    if arguments.channel == "z":
        frame = with_z(frame, camera)
    write_image(arguments.output, frame, stored(arguments.channel), arguments.exposure)
    print(
        f"{one_line(arguments.output)}: {arguments.channel}, {arguments.renderer}, "
        f"{width}x{height}, {1e3 * frame.time_s:.1f} ms"
    )
    if hits_nothing(frame):
        common.say_nothing_is_hit(scene, camera)
    return 0


def draw(scene: Scene, camera: Camera, arguments: argparse.Namespace) -> Frame:
    """Render with the selected renderer, with a progress bar.

    The frame has the requested channel, and id, which shows whether anything is hit.
    """
    from lucida.app.cameras.films.frames import Drawing, Shot
    from lucida.renderer.images.frame import stored

    channels = tuple(dict.fromkeys((stored(arguments.channel), "id")))
    with common.progress_bar(arguments.renderer) as progress:
        if arguments.renderer == "raster":
            from lucida.renderer.scene import flatten
            from lucida.renderer.scene.precision import check_precision

            check_precision(camera, arguments.size, lambda: flatten(scene))
        with closing(Drawing(scene, look_of(arguments))) as drawing:
            return drawing.frame(Shot(camera, arguments.size), channels, progress)


def check_effects(arguments: argparse.Namespace) -> None:
    """Raise LucidaError for effects that only the ray tracer has."""
    for switch, given in (("--shadows", arguments.shadows), ("--mirrors", arguments.mirrors)):
        if given:
            raise LucidaError(
                f"argument {switch}",
                "only image order has it: each hit may send further rays",
                "add --renderer ray",
            )
