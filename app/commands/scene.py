"""`lucida scene FILE`: the contents of a scene, and what is odd about it."""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lucida.renderer.editing.outline import OutlineRow
    from lucida.renderer.scene import Material, Scene, Shape

NAME = "scene"

DESCRIPTION = """\
List what is in a scene: its objects with their types, triangles, bounds and materials, its lights
and its camera; properties of its materials that are not shown; models that are open, turned inside
out or in parts differently; the model files that it reads, marking those outside its folder; and
its models' cameras."""

EPILOG = """\
exit status: 0 done (also if something is odd: all of it can be drawn), 2 a mistake or a failure

examples:
  lucida scene my-scene.toml
  lucida scene bunny.obj --json"""


def configure(parser: argparse.ArgumentParser) -> None:
    from lucida.app.commands.arguments import SCENE_HELP

    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=SCENE_HELP)
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.commands.arguments import check_is_scene, say
    from lucida.renderer.files import load_scene

    check_is_scene(arguments.scene)
    scene = load_scene(arguments.scene)
    told = contents(scene)
    if arguments.json:
        say(json.dumps(told, indent=2, allow_nan=False))
    else:
        say(as_text(told), *_named(scene))
    return 0


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
        seen = f"{camera.projection} from {_vector(list(camera.eye))}"
        lines.append(f"  camera {quoted(named.name)}: {seen}")
    return lines


def contents(scene: Scene) -> dict[str, Any]:
    """Return all contents as JSON values."""
    import numpy as np

    from lucida.renderer.editing.outline import outline
    from lucida.renderer.files.oddities import oddities
    from lucida.renderer.files.views import view_table
    from lucida.renderer.scene.model import Mesh, triangles_of

    outlined = outline(scene)
    rows = [row for row in outlined if not row.is_light]
    bounds = [_bounds(entry.shape) for entry in scene.objects]
    seen = [bounds[number] for number, _ in scene.visible]
    objects = []
    for row in rows:
        for number in row.ids:
            entry = scene.objects[number]
            objects.append(
                {
                    "id": number,
                    "name": entry.name,
                    "type": row.kind,
                    "file": row.file or None,
                    "triangles": triangles_of([entry]),
                    "bounds": bounds[number].tolist(),
                    "hidden": entry.hidden,
                    "material_name": row.material or None,
                    "material": _material(entry.material),
                }
            )
    return {
        "name": scene.name,
        "triangles": sum(row.triangles for row in rows),
        "bounds": [np.min(seen, (0, 1)).tolist(), np.max(seen, (0, 1)).tolist()] if seen else None,
        "objects": objects,
        "lights": _lights(scene, [row for row in outlined if row.is_light]),
        "ambient": list(scene.ambient),
        "background": list(scene.background),
        "camera": view_table(scene.view),
        "notes": list(scene.notes),
        "odd": [
            {"object": number, "text": text}
            for row in rows
            if row.kind in ("model", "mesh")
            for number in row.ids
            if isinstance(shape := scene.objects[number].shape, Mesh)
            for text in oddities(shape)
        ],
    }


def _bounds(shape: Shape) -> NDArray[np.float64]:
    """Return the lowest and highest corner (2, 3) in the world, vertex by vertex: a rotated shape
    does not fill its own rotated box.
    """
    import numpy as np

    from lucida.renderer.editing.moving import object_box
    from lucida.renderer.scene.model import Sphere

    if isinstance(shape, Sphere):
        return object_box(shape)
    world = shape.vertices @ shape.transform[:3, :3].T + shape.transform[:3, 3]
    return np.array([world.min(axis=0), world.max(axis=0)])


def _lights(scene: Scene, rows: list[OutlineRow]) -> list[dict[str, Any]]:
    """Return the lights that are on, in the order of their numbers, then the hidden ones. rows: of
    all.
    """
    from lucida.renderer.editing.changing import fields_of
    from lucida.renderer.files.saving import light_table
    from lucida.renderer.files.schema import LightTable
    from lucida.renderer.scene.material import parse_color

    names = [row.name for row in rows if not row.hidden] or [""] * len(scene.lights)
    lights = [
        {"name": name, "hidden": False, **light_table(light)}
        for name, light in zip(names, scene.lights, strict=True)
    ]
    for row in rows:
        if row.hidden and row.item is not None:
            fields = fields_of(scene, row.item)
            assert isinstance(fields, LightTable)
            place = {k: getattr(fields, k) for k in ("position", "direction") if hasattr(fields, k)}
            told = {"name": row.name, "hidden": True, "type": row.kind, **place}
            lights.append(told | {"color": parse_color("color", fields.color)})
    return lights


def _material(material: Material) -> dict[str, Any]:
    """Return its numbers, and which images it shows."""
    from lucida.renderer.files.saving import IMAGES, material_table

    table = material_table(replace(material, texture=None, metal=None), Path())
    for name in IMAGES:
        image = getattr(material, name)
        if image is not None:
            table[name] = str(image.file) if image.file is not None else "inside the model's file"
    if material.metal is not None and material.metal.is_everywhere:
        table["metal"] = "everywhere"
    return table


def as_text(told: dict[str, Any]) -> str:
    """Return the same as text."""
    from lucida.app.commands.arguments import counted
    from lucida.renderer.system.errors import one_line, quoted

    objects, lights = told["objects"], told["lights"]
    shining = sum(not light["hidden"] for light in lights)
    count = counted((len(objects), "object"), (told["triangles"], "triangle"), (shining, "light"))
    lines = [f"{told['name']}: {count}; {_box(told['bounds'])}"]
    for entry in objects:
        triangles = counted((entry["triangles"], "triangle")) if entry["triangles"] else "exact"
        name = quoted(entry["name"]) if entry["name"] else "-"
        file = f" {one_line(entry['file'])}" if entry["file"] else ""
        material = entry["material_name"]
        made = f"material {quoted(material)}" if material else _color(entry["material"])
        made += _surface(entry["material"])
        lines.append(
            f"  {entry['id']:<3} {entry['type']}{file} {name}: {triangles}{_hidden(entry)}"
        )
        lines.append(f"      {_box(entry['bounds'])}; {made}")
    for number, light in enumerate(lights):
        place = "at" if light["type"] == "point" else "along"
        where = light.get("position") or light.get("direction")
        name = f" {quoted(light['name'])}" if light["name"] else ""
        shown = f"{light['type']}{name} {place} {_vector(where)}, color {_vector(light['color'])}"
        lines.append(f"  light {'-' if light['hidden'] else number}: {shown}{_hidden(light)}")
    camera = told["camera"]
    lines.append(f"  camera: {camera['projection']} from {_vector(camera['eye'])}")
    lines += [f"  note: {one_line(note)}" for note in told["notes"]]
    for odd in told["odd"]:
        lines.append("  " + one_line(f"odd: object {odd['object']} {odd['text']}"))
    return "\n".join(lines)


def _hidden(entry: dict[str, Any]) -> str:
    return ", hidden" if entry["hidden"] else ""


def _box(bounds: list[list[float]] | None) -> str:
    if bounds is None:
        return "nothing is visible"
    return f"from {_vector(bounds[0])} to {_vector(bounds[1])}"


def _color(material: dict[str, Any]) -> str:
    from lucida.renderer.system.errors import one_line

    images = [f", {k} {one_line(material[k])}" for k in ("texture", "metal") if k in material]
    return f"diffuse {_vector(material['diffuse'])}{''.join(images)}"


def _surface(material: dict[str, Any]) -> str:
    """Return a surface's cutout, and that its backs are not seen, as text."""
    cutout = f", holes below opacity {material['cutout']:.4g}" if "cutout" in material else ""
    return cutout + ", single-sided" * material.get("single_sided", False)


def _vector(values: list[float]) -> str:
    return "(" + ", ".join(f"{value + 0.0:.4g}" for value in values) + ")"
