"""The contents of a scene as a list for selection: objects, then lights."""

from __future__ import annotations

from dataclasses import dataclass

from lucida.renderer.files.schema import ModelTable
from lucida.renderer.scene.model import Scene, SceneObject, Sphere, triangle_count
from lucida.renderer.system.errors import LucidaError

from .changing import Item, as_tables, fields_of, listed, origin_of


@dataclass(frozen=True)
class OutlineRow:
    """An object or a light.

    item: its key; None if the scene cannot be edited.
    name: its own; "" for none. shown: its label, never empty.
    kind: its type in the file: "box", "model", "point" ...
    ids: of its objects, indices into scene.objects; none for a light.
    triangles: 0 for spheres and lights.
    material: the name of a shared one; "" for its own or none.
    file: a model's, as in the scene file.
    """

    item: Item | None
    name: str
    shown: str
    kind: str
    hidden: bool
    locked: bool
    is_light: bool = False
    ids: range = range(0)
    triangles: int = 0
    material: str = ""
    file: str = ""


def outline(scene: Scene) -> tuple[OutlineRow, ...]:
    """Return the objects in the order of their ids, then the lights."""
    try:
        scene = as_tables(scene)
    except LucidaError:  # meshes made in Python
        return tuple(_read_only(number, entry) for number, entry in enumerate(scene.objects))
    origin, _ = origin_of(scene)
    rows: list[OutlineRow] = []
    for number, entry in enumerate(origin.entries):
        fields, kind = entry.fields, entry.table["type"]
        called = fields.name or (entry.objects[0].name if len(entry.objects) == 1 else "")
        file = fields.file if isinstance(fields, ModelTable) else ""
        row = OutlineRow(
            entry.key,
            fields.name,
            called or file or f"{kind} {number}",
            kind,
            fields.hidden,
            fields.locked,
            ids=range(*origin.first_ids[number : number + 2]),
            triangles=triangle_count(entry.objects),
            material=fields.material if isinstance(fields.material, str) else "",
            file=file,
        )
        rows.append(row)
    lights = zip(origin.light_keys, listed(scene, "lights"), strict=True)
    for number, (key, table) in enumerate(lights):
        light, kind = fields_of(scene, key), table["type"]
        shown = light.name or f"{kind} light {number}"
        row = OutlineRow(key, light.name, shown, kind, light.hidden, light.locked, is_light=True)
        rows.append(row)
    return tuple(rows)


def _read_only(number: int, entry: SceneObject) -> OutlineRow:
    kind = "sphere" if isinstance(entry.shape, Sphere) else "mesh"
    shown, ids = entry.name or f"{kind} {number}", range(number, number + 1)
    return OutlineRow(
        None,
        entry.name,
        shown,
        kind,
        entry.hidden,
        True,
        ids=ids,
        triangles=triangle_count([entry]),
    )
