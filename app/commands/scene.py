"""`lucida scene [SCENE]`: list a scene's contents and oddities."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lucida.renderer.scene import Scene, Shape

NAME = "scene"

DESCRIPTION = """\
List what is in a scene: its objects with their types, triangles, bounds and colours, its lights
and its camera; properties of its materials that are not shown; models that are open, turned
inwards or in parts differently; the model files that it reads, marking those outside its folder;
and its models' cameras. Without SCENE: the names of the built-in scenes, the default one first."""

EPILOG = """\
exit status: 0 done (also if something is odd: all of it can be drawn), 2 a mistake or a failure

examples:
  lucida scene                        the built-in scenes
  lucida scene my-scene.toml
  lucida scene bunny.obj"""


def configure(parser: argparse.ArgumentParser) -> None:
    from .arguments import SCENE_HELP

    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=SCENE_HELP)


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.files import BUILTIN_SCENES, load_scene

    from .arguments import check_is_scene, say

    if arguments.scene is None:
        print("\n".join(BUILTIN_SCENES))
        return 0
    check_is_scene(arguments.scene)
    scene = load_scene(arguments.scene)
    say(*_contents(scene), *_named(scene))
    return 0


def _contents(scene: Scene) -> list[str]:
    """Return a line about the whole, one for each object and light, and one for each oddity."""
    from lucida.renderer.editing.outline import outline
    from lucida.renderer.files.oddities import oddities
    from lucida.renderer.files.saving import light_table
    from lucida.renderer.scene.model import Mesh, triangle_count
    from lucida.renderer.system.errors import counted, one_line, quoted

    rows = outline(scene)
    kinds = {number: row for row in rows for number in row.ids}
    triangles = triangle_count(scene.objects)
    counts = (len(scene.objects), "object"), (triangles, "triangle"), (len(scene.lights), "light")
    seen = [scene.objects[number].shape for number, _ in scene.visible]
    lines = [f"{scene.name}: {counted(*counts)}; {_bounds(seen)}"]
    for number, entry in enumerate(scene.objects):
        row, own = kinds[number], triangle_count([entry])
        color = f"color {_vector(entry.material.diffuse)}"
        lines.append(
            f"  {number:<3} {row.kind} {quoted(entry.name or row.shown)}: "
            f"{counted((own, 'triangle')) if own else 'exact'}; {_bounds([entry.shape])}; "
            f"{f'material {quoted(row.material)}' if row.material else color}"
            f"{', hidden' if entry.hidden else ''}"
        )
    for number, light in enumerate(scene.lights):
        numbers: dict[str, Any] = light_table(light)
        kind = numbers.pop("type")
        told = ", ".join(f"{name} {_vector(value)}" for name, value in numbers.items())
        lines.append(f"  light {number}: {kind}, {told}")
    lines += [f"  light {quoted(row.shown)}, hidden" for row in rows if row.is_light and row.hidden]
    camera = scene.view.camera
    lines.append(f"  camera: {camera.projection} from {_vector(camera.eye)}")
    lines += [f"  note: {one_line(note)}" for note in scene.notes]
    for number, entry in enumerate(scene.objects):
        if kinds[number].kind in ("model", "mesh") and isinstance(entry.shape, Mesh):
            lines += [f"  odd: object {number} {text}" for text in oddities(entry.shape)]
    return lines


def _named(scene: Scene) -> list[str]:
    """Return a line for each model file that a scene reads, and each camera of its models."""
    from lucida.renderer.files.outside import model_files, outside
    from lucida.renderer.system.errors import one_line, quoted

    lines = []
    for file in model_files(scene):
        assert scene.origin is not None
        where = ", outside of its folder" if outside([file], scene.origin.folder) else ""
        lines.append(f"  reads {one_line(str(file))}{where}")
    for named in scene.views:
        camera = named.view.camera
        seen = f"{camera.projection} from {_vector(camera.eye)}"
        lines.append(f"  camera {quoted(named.name)}: {seen}")
    return lines


def _bounds(shapes: list[Shape]) -> str:
    """Return the bounds of shapes in the world, as text."""
    import numpy as np

    if not shapes:
        return "nothing is visible"
    corners = np.concatenate([_corners(shape) for shape in shapes])
    return f"from {_vector(corners.min(axis=0))} to {_vector(corners.max(axis=0))}"


def _corners(shape: Shape) -> NDArray[np.float64]:
    """Return points (N, 3) in the world with a shape's bounds: all vertices of a mesh, because a
    rotated shape does not fill its own rotated box.
    """
    from lucida.renderer.editing.moving import object_box
    from lucida.renderer.scene.model import Sphere

    if isinstance(shape, Sphere):
        return object_box(shape)
    return shape.vertices @ shape.transform[:3, :3].T + shape.transform[:3, 3]


def _vector(values: Any) -> str:
    return "(" + ", ".join(f"{value + 0.0:.4g}" for value in values) + ")"
