"""The contents of a scene, as a list to select from: objects, then lights."""

from __future__ import annotations

from dataclasses import dataclass

from lucida.renderer.editing.changing import Item, as_tables, fields_of, listed, origin_of
from lucida.renderer.files.schema import ModelTable
from lucida.renderer.scene.model import Scene, Sphere, triangles_of
from lucida.renderer.system.errors import LucidaError


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
    is_light: bool
    ids: range
    triangles: int
    hidden: bool
    locked: bool
    material: str = ""
    file: str = ""


def outline(scene: Scene) -> tuple[OutlineRow, ...]:
    """Return the objects in the order of their ids, then the lights."""
    try:
        scene = as_tables(scene)
    except LucidaError:
        return _read_only(scene)
    origin, _ = origin_of(scene)
    rows: list[OutlineRow] = []
    first = 0
    for number, entry in enumerate(origin.entries):
        fields, kind = entry.fields, entry.table["type"]
        ids = range(first, first + len(entry.objects))
        first = ids.stop
        called = fields.name or (entry.objects[0].name if len(entry.objects) == 1 else "")
        is_model = isinstance(fields, ModelTable)
        rows.append(
            OutlineRow(
                entry.key,
                fields.name,
                called or (fields.file if is_model else f"{kind} {number}"),
                kind,
                False,
                ids,
                triangles_of(entry.objects),
                fields.hidden,
                fields.locked,
                fields.material if isinstance(fields.material, str) else "",
                fields.file if is_model else "",
            )
        )
    for number, (key, table) in enumerate(
        zip(origin.light_keys, listed(scene, "lights"), strict=True)
    ):
        light = fields_of(scene, key)
        shown = light.name or f"{table['type']} light {number}"
        rows.append(
            OutlineRow(
                key,
                light.name,
                shown,
                table["type"],
                True,
                range(0),
                0,
                light.hidden,
                light.locked,
            )
        )
    return tuple(rows)


def _read_only(scene: Scene) -> tuple[OutlineRow, ...]:
    """Return the outline of a scene with meshes made in Python."""
    rows = []
    for number, entry in enumerate(scene.objects):
        kind = "sphere" if isinstance(entry.shape, Sphere) else "mesh"
        shown, ids = entry.name or f"{kind} {number}", range(number, number + 1)
        triangles = triangles_of([entry])
        rows.append(
            OutlineRow(
                None, entry.name, shown, kind, False, ids, triangles, entry.hidden, locked=True
            )
        )
    return tuple(rows)
