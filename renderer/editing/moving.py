"""Moving, rotating and scaling items by a matrix, as handles do, with the result in the file's
fields.

A matrix is converted to translate, rotate_deg and scale, and to the fields of spheres and lights. A
matrix that these cannot hold (a shear; one that makes a sphere an ellipsoid) is an error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.editing.changing import (
    Item,
    Table,
    as_tables,
    entry_of,
    fields_of,
    find,
    plain,
    with_changed,
)
from lucida.renderer.files.schema import (
    DirectionalLightTable,
    MeshTable,
    PointLightTable,
    SphereTable,
)
from lucida.renderer.scene.boxes import extent, world_boxes
from lucida.renderer.scene.model import Scene, Shape, Sphere
from lucida.renderer.scene.shapes import placement
from lucida.renderer.system.errors import LucidaError

Floats = NDArray[np.float64]

TOLERANCE = 1e-6  # of lengths and cosines: a smaller shear is rounding
DIGITS = 12  # significant digits in the file: the rest is rounding


def matrix_of(scene: Scene, item: Item) -> Floats:
    """Return world_from_item (4, 4), for handles.

    For an object, this is the transform of its object space. A sphere's is scaled by its radius. A
    point light's is at its position. A directional light's has its z axis opposite to the
    direction, and is at the origin.
    """
    fields = fields_of(scene, item)
    if isinstance(fields, SphereTable):
        return placement(fields.center, scale=fields.radius)
    if isinstance(fields, MeshTable):
        return placement(fields.translate, fields.rotate_deg, fields.scale)
    if isinstance(fields, PointLightTable):
        return placement(fields.position)
    assert isinstance(fields, DirectionalLightTable)
    z = -np.asarray(fields.direction) / np.linalg.norm(fields.direction)
    x = np.cross((0.0, 1.0, 0.0) if abs(z[1]) < 0.9 else (1.0, 0.0, 0.0), z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    return matrix


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


def transform(scene: Scene, items: Sequence[Item], matrix: ArrayLike) -> Scene:
    """Return the scene with some items transformed by an affine matrix (4, 4) in the world.

    Their new matrix is matrix @ matrix_of(). During a drag, pass the scene from its beginning and
    the matrix of the whole drag. Raises LucidaError if an item cannot be transformed so.
    """
    moved = np.asarray(matrix, float)
    if moved.shape != (4, 4) or not np.isfinite(moved).all():
        raise LucidaError("matrix", "is not 4 x 4 finite numbers", "give an affine matrix")
    scene = as_tables(scene)
    return with_changed(
        scene, items, lambda item, table: {**table, **_moved(fields_of(scene, item), moved)}
    )


def _moved(fields: Any, matrix: Floats) -> Table:
    """Return the changes to the item's table."""
    linear = matrix[:3, :3]

    def point(value: Sequence[float]) -> list[float]:
        return _numbers(linear @ value + matrix[:3, 3], value)

    if isinstance(fields, PointLightTable):
        return {"position": point(fields.position)}
    if isinstance(fields, DirectionalLightTable):
        turned = linear @ fields.direction
        length = np.linalg.norm(turned)
        if not length > 0:
            raise LucidaError("scale", "flattens the light's direction", "turn it only")
        turned *= np.linalg.norm(fields.direction) / length  # scaling must not change its length
        return {"direction": _numbers(turned, fields.direction)}
    if isinstance(fields, SphereTable):
        factor = math.cbrt(abs(np.linalg.det(linear)))
        if not np.abs(linear.T @ linear - factor**2 * np.eye(3)).max() <= TOLERANCE * factor**2:
            raise LucidaError(
                "scale", "would make an ellipsoid of a sphere", "scale a sphere by one factor"
            )
        radius = _number(factor * fields.radius, fields.radius)
        return {"center": point(fields.center)} | (
            {"radius": radius} if radius != fields.radius else {}
        )
    if np.array_equal(linear, np.eye(3)):
        return {"translate": point(fields.translate)}
    now = placement(fields.translate, fields.rotate_deg, fields.scale)
    angles, factors = decomposed(linear @ now[:3, :3], fields.rotate_deg, fields.scale)
    was = (fields.scale,) * 3 if isinstance(fields.scale, int | float) else fields.scale
    scales = _numbers(factors, was)
    is_one = isinstance(fields.scale, int | float) and scales == [scales[0]] * 3
    found = {
        "translate": point(fields.translate),
        "rotate_deg": _numbers(angles, fields.rotate_deg),
        "scale": scales[0] if is_one else scales,
    }
    return {name: value for name, value in found.items() if not _same(value, getattr(fields, name))}


def decomposed(
    linear: Floats, rotate_deg: Sequence[float], scale: float | Sequence[float]
) -> tuple[Floats, Floats]:
    """Return (rotate_deg, scale), each (3,), of a matrix (3, 3).

    The factors keep the signs of the given ones; the first changes its sign in a mirror image.
    Raises LucidaError for a shear or a singular matrix.
    """
    lengths = np.linalg.norm(linear, axis=0)
    if not (lengths > 1e-12).all():
        raise LucidaError("scale", "flattens the object", "give factors other than 0")
    unit = linear / lengths
    if np.abs(unit.T @ unit - np.eye(3)).max() > TOLERANCE:
        raise LucidaError(
            "scale",
            "would shear the object, which a scene file cannot hold",
            "scale along the object's own axes, or by one factor",
        )
    signs = np.sign(np.broadcast_to(np.asarray(scale, float), 3)).copy()
    if np.linalg.det(unit * signs) < 0:
        signs[0] *= -1
    return _angles(unit * signs, np.asarray(rotate_deg, float)), lengths * signs


def _angles(rotation: Floats, near: Floats) -> Floats:
    """Return rotation angles about x, then y, then z, in degrees, nearest to `near`."""
    cosine = math.hypot(rotation[0, 0], rotation[1, 0])
    y = math.atan2(-rotation[2, 0], cosine)
    if cosine < 1e-9:  # gimbal lock: keep z
        z = math.radians(near[2])
        about_z = placement((0, 0, 0), (0, 0, near[2]))[:3, :3]
        rest = about_z.T @ rotation  # Ry Rx
        x = math.atan2(-rest[1, 2], rest[1, 1])
        choices = [(x, y, z)]
    else:
        x = math.atan2(rotation[2, 1], rotation[2, 2])
        z = math.atan2(rotation[1, 0], rotation[0, 0])
        choices = [(x, y, z), (x + math.pi, math.pi - y, z + math.pi)]
    found = [np.degrees(choice) for choice in choices]
    found = [angles + 360 * np.round((near - angles) / 360) for angles in found]
    return min(found, key=lambda angles: float(np.abs(angles - near).sum()))


def _numbers(values: ArrayLike, before: Sequence[float]) -> list[float]:
    found = np.asarray(values, float).tolist()
    return [_number(value, was) for value, was in zip(found, before, strict=True)]


def _number(value: float, before: float) -> float:
    """Return a number rounded for the file: the old one if the two differ only by rounding."""
    if abs(value - before) <= 1e-12 * max(abs(before), 1.0):
        return before
    return float(f"{value:.{DIGITS}g}") + 0.0


def _same(value: Any, before: Any) -> bool:
    return bool(value == plain(before))
