"""Moving items in the world, as by their handle, with the result in the file's fields."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.files.schema import PointLightTable
from lucida.renderer.scene.boxes import extent, world_boxes
from lucida.renderer.scene.model import Scene, Shape, Sphere
from lucida.renderer.system.errors import LucidaError

from .changing import Item, as_tables, entry_of, fields_of, find, with_changed

Floats = NDArray[np.float64]

PLACES = ("center", "translate", "position")  # of a sphere, a mesh, a point light
DIGITS = 12  # significant digits in the file; the rest is rounding


def bounds_of(scene: Scene, items: Sequence[Item]) -> Floats | None:
    """Return the lowest and highest corner (2, 3) of objects and point lights in the world; None if
    none of the items has a position.
    """
    scene = as_tables(scene)
    boxes: list[tuple[Any, Any]] = []
    for item in items:
        kind, _ = find(scene, item)
        if kind == "lights":
            fields = fields_of(scene, item)
            if isinstance(fields, PointLightTable):
                boxes.append((fields.position, fields.position))
            continue
        for entry in entry_of(scene, item).objects:
            low, high = object_box(entry.shape)
            boxes.append((low, high))
    if not boxes:
        return None
    return np.array([np.min([b[0] for b in boxes], 0), np.max([b[1] for b in boxes], 0)])


def object_box(shape: Shape) -> Floats:
    """Return the lowest and highest corner (2, 3), in the world, of a sphere or of a mesh's
    bounding box.
    """
    if isinstance(shape, Sphere):
        center = np.asarray(shape.center)
        return np.array([center - shape.radius, center + shape.radius])
    own = np.array(extent(shape.vertices), float)
    low, high = world_boxes(shape.transform[None], own[None])
    return np.array([low[0], high[0]])


def shift(scene: Scene, items: Sequence[Item], by: ArrayLike) -> Scene:
    """Return the scene with some items moved by a vector (3,) in the world; a directional light
    stays, because it has no position. During a drag, pass the initial scene and the total motion.

    Raises LucidaError if an item cannot be moved.
    """
    way = np.asarray(by, float)
    if way.shape != (3,) or not np.isfinite(way).all():
        raise LucidaError("by", "is not three finite numbers", "give a vector")

    def moved(item: Item, table: dict[str, Any]) -> dict[str, Any]:
        fields = fields_of(scene, item)
        place = next((name for name in PLACES if hasattr(fields, name)), None)
        if place is None:
            return table
        before = getattr(fields, place)
        ends = zip((np.asarray(before, float) + way).tolist(), before, strict=True)
        return {**table, place: [_number(value, was) for value, was in ends]}

    scene = as_tables(scene)
    return with_changed(scene, items, moved)


def _number(value: float, before: float) -> float:
    """Return a number rounded for the file: the old one if the two differ only by rounding."""
    if abs(value - before) <= 1e-12 * max(abs(before), 1.0):
        return before
    return float(f"{value:.{DIGITS}g}") + 0.0
