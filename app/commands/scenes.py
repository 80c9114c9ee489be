"""`lucida scenes [SCENE]`: the names of the built-in scenes, or the contents and files of one."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from renderer.scene import Scene

NAME = "scenes"

EPILOG = """\
examples:
  lucida scenes                           the built-in scenes
  lucida scenes my-scene.toml             what is in it, and which files it names
  lucida render spheres -o spheres.png"""


def configure(parser: argparse.ArgumentParser) -> None:
    from app.commands.arguments import SCENE_HELP

    parser.description = (
        "List the built-in scenes, the default one first; or say what is in one scene,\n"
        "which model files it names (one outside of its folder is told as such),\n"
        "and which cameras its models have."
    )
    parser.epilog = EPILOG
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=SCENE_HELP)


def run(arguments: argparse.Namespace) -> int:
    from renderer.scene import BUILTIN_SCENES, load_scene

    if arguments.scene is None:
        print("\n".join(BUILTIN_SCENES))
        return 0
    from app.commands.arguments import check_is_scene, say

    check_is_scene(arguments.scene)
    say(*described(load_scene(arguments.scene)))
    return 0


def described(scene: Scene) -> list[str]:
    """Return lines on the contents of a scene, and on the model files that it names."""
    from app.commands.arguments import counted
    from renderer.errors import one_line
    from renderer.scene import Mesh
    from renderer.scene.outside import model_files, outside

    triangles = sum(len(e.shape.faces) for e in scene.objects if isinstance(e.shape, Mesh))
    told = counted(
        (len(scene.objects), "object"), (triangles, "triangle"), (len(scene.lights), "light")
    )
    lines = [f"{scene.name}: {told}"]
    for file in model_files(scene):
        assert scene.origin is not None
        where = ", outside of its folder" if outside([file], scene.origin.folder) else ""
        lines.append(f"  reads {one_line(str(file))}{where}")
    for named in scene.views:
        x, y, z = named.view.camera.eye
        seen = f"{named.view.camera.projection} from ({x:.3g}, {y:.3g}, {z:.3g})"
        lines.append(f"  camera {one_line(named.name)!r}: {seen}")
    return lines
