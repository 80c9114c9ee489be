"""Random edits of scenes: every kind that renderer/editing knows, with random values."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from lucida.renderer.editing import changing, materials, moving, objects
from lucida.renderer.editing.outline import Item, outline
from lucida.renderer.scene import Scene, flatten
from lucida.renderer.system.errors import LucidaError

Random = np.random.Generator

FIELDS = {
    "sphere": ("radius",),
    "box": ("size",),
    "rectangle": ("width", "depth"),
    "disk": ("radius",),
    "cylinder": ("radius", "height"),
    "cone": ("radius", "height"),
    "torus": ("tube_radius", "radius"),
    "model": (),
}

SCENE = """\
# A scene to edit: comments everywhere.
lucida = 1
name = "small"   # its name
ambient = [0.1, 0.1, 0.12]

[camera]
eye = [0.3, 1.2, 5]   # from the front
target = [0, 0, 0]
fov_y_deg = 40.0

# Two materials.

[materials.red]
diffuse = "#d04020"
specular = [0.4, 0.4, 0.4]   # shiny

[materials.floor]
diffuse = [0.6, 0.6, 0.6]
checker = { diffuse = [0.1, 0.2, 0.1], size = 0.5 } # tiles

[[lights]]
type = "directional"
direction = [0.4, -1, -0.5]

# The lamp.
[[lights]]
type = "point"
position = [2, 3, 2]
color = [0.3, 0.3, 0.3]

# --- the objects ---

[[objects]]
type = "rectangle"   # the floor
material = "floor"
width = 4
depth = 4
translate = [0, -1, 0]

# The ball.
[[objects]]
type = "sphere"
name = "ball"
material = "red"
center = [-0.7, 0, 0]
radius = 0.6
# no more of the ball

[[objects]]
type = "box"
name = "box"
translate = [0.8, 0, 0]
rotate_deg = [0, 30, 0]
size = [0.5, 1.0, 0.7]

[objects.material]
diffuse = [0.2, 0.3, 0.8]

[[objects]]
type = "model"
file = "tent.obj"
translate = [0, -0.5, 1]
"""

TENT = """\
v -0.5 0 -0.5
v 0.5 0 -0.5
v 0 0.9 0
v 0.5 0 0.5
v -0.5 0 0.5
f 1 2 3
f 2 4 3
g back
f 4 5 3
f 5 1 3
"""


def check_same(one: Scene, other: Scene) -> None:
    """Assert that two scenes are equal in all that is drawn, number by number, and in names."""
    for name in ("view", "name"):
        assert getattr(one, name) == getattr(other, name), name
    a, b = ([(e.material, e.name, e.hidden) for e in s.objects] for s in (one, other))
    assert a == b
    arrays = zip(flatten(one), flatten(other), strict=True)
    assert all(np.array_equal(mine, theirs) for mine, theirs in arrays)


def edited(rng: Random, scene: Scene) -> tuple[str, Scene]:
    """The name of a random edit, and what it gives: the same scene where the edit is refused."""
    name = str(rng.choice(list(EDITS)))
    try:
        return name, EDITS[name](rng, scene)
    except LucidaError as error:
        return f"{name} (refused: {error})", scene


def _items(rng: Random, scene: Scene, lights: bool = True) -> tuple[int, ...]:
    """One item or two."""
    rows = [row for row in outline(scene) if lights or not row.is_light]
    count = min(len(rows), int(rng.integers(1, 3)))
    found = rng.choice(len(rows), count, replace=False) if rows else ()
    return tuple(item for k in found if (item := rows[int(k)].item) is not None)


def _number(rng: Random) -> float:
    return round(float(rng.uniform(0.2, 1.2)), int(rng.integers(1, 12)))


def _color(rng: Random) -> list[float] | str:
    if rng.random() < 0.3:
        return "#" + "".join(f"{part:02x}" for part in rng.integers(0, 256, 3))
    return [round(float(part), 3) for part in rng.random(3)]


def _set_shape(rng: Random, scene: Scene) -> Scene:
    items = _items(rng, scene, lights=False)[:1]
    if not items:
        return scene
    fields = FIELDS[changing.table_of(scene, items[0])["type"]]
    if not fields:
        return scene
    return changing.set_field(scene, items, str(rng.choice(fields)), _number(rng))


def _set_place(rng: Random, scene: Scene) -> Scene:
    items = _items(rng, scene)
    values = {
        "translate": tuple(rng.normal(size=3)),
        "rotate_deg": rng.uniform(-180, 180, 3),
        "scale": float(rng.uniform(0.3, 2)) if rng.random() < 0.5 else rng.uniform(-2, 2, 3),
        "center": rng.normal(size=3),
        "position": 3 * rng.normal(size=3),
        "direction": rng.normal(size=3),
    }
    there = changing.fields_of(scene, items[0]).__struct_fields__
    own = [name for name in values if name in there]
    field = str(rng.choice(own))
    optional = field in ("translate", "rotate_deg", "scale", "center")
    value = None if optional and rng.random() < 0.15 else values[field]
    return changing.set_field(scene, items[:1], field, value)


def _shift(rng: Random, scene: Scene) -> Scene:
    return moving.shift(scene, _items(rng, scene), rng.normal(size=3) * 0.4)


def _add(rng: Random, scene: Scene) -> Scene:
    kind = str(rng.choice([*objects.SHAPES, *objects.LIGHTS]))
    table = objects.new_table(scene, kind, rng.normal(size=3).round(3).tolist(), _number(rng))
    if kind in ("torus", "cylinder", "cone", "disk"):
        table["segments"] = int(rng.integers(3, 12))
    if kind == "torus":
        table["sides"] = int(rng.integers(3, 8))
    return objects.add(scene, table)[0]


def _set_material(rng: Random, scene: Scene) -> Scene:
    field, value = (
        ("diffuse", _color(rng)),
        ("specular", _color(rng)),
        ("shininess", float(rng.integers(1, 200))),
        ("checker", {"diffuse": _color(rng), "size": _number(rng)}),
        ("checker.size", _number(rng)),
        ("checker", None),
    )[rng.integers(6)]
    items = _items(rng, scene, lights=False)
    return materials.set_material(scene, items, field, value)


def _set_scene(rng: Random, scene: Scene) -> Scene:
    field = str(rng.choice(["ambient", "background"]))
    return changing.set_scene_field(scene, field, _color(rng) if rng.random() < 0.8 else None)


EDITS: dict[str, Callable[[Random, Scene], Scene]] = {
    "shape": _set_shape,
    "place": _set_place,
    "shift": _shift,
    "add": _add,
    "delete": lambda rng, scene: objects.delete(scene, _items(rng, scene)),
    "duplicate": lambda rng, s: objects.duplicate(s, _items(rng, s), rng.normal(size=3))[0],
    "rename": lambda rng, s: objects.rename(s, _items(rng, s)[0], f"n {rng.integers(99)}"),
    "hide": lambda rng, s: objects.hide(s, _items(rng, s), bool(rng.random() < 0.6)),
    "material": _set_material,
    "light": lambda rng, s: changing.set_field(s, _items(rng, s), "color", _color(rng)),
    "scene": _set_scene,
}


def item(scene: Scene, shown: str) -> Item:
    """Return the item that the outline shows by a name."""
    return next(row.item for row in outline(scene) if row.shown == shown)


def table(scene: Scene, shown: str) -> dict[str, Any]:
    return changing.table_of(scene, item(scene, shown))
