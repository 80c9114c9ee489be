"""`lucida export`: write a scene and its camera as glTF."""

from __future__ import annotations

import argparse

from lucida.app.cameras.options import add_camera_options
from lucida.renderer.system.errors import counted, one_line

from . import arguments as common
from .given_camera import add_view_option

NAME = "export"

DESCRIPTION = """\
Write a scene, its materials, its lights and a camera as glTF 2.0 (.glb), with KHR_lights_punctual
and KHR_materials_specular. What could not be carried over is listed, and recorded in the file."""

EPILOG = """\
examples:
  lucida export still-life -o still-life.glb
  lucida export bunny.obj -o bunny.glb --view corner.toml --size 640x480

exit status: 0 written, 2 a mistake, or a camera that the format cannot hold; then nothing is
written"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument(
        "-o", "--output", metavar="OUT", required=True, help="the .glb file to write"
    )
    common.add_size_option(parser)
    add_view_option(parser)
    add_camera_options(parser)


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.files.export import check_export_path, export_scene

    check_export_path(arguments.output)
    scene, camera = common.scene_and_camera(arguments)
    left_out = export_scene(arguments.output, scene, camera, arguments.size)
    counts = counted((len(scene.visible), "object"), (len(scene.lights), "light"))
    common.say(f"{one_line(arguments.output)}: {counts}", *(f"  {line}" for line in left_out))
    return 0
