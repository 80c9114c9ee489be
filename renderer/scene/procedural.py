"""From a scene file's table of a shape to its mesh.

Knows nothing of models, materials or places.
"""

from __future__ import annotations

from collections.abc import Hashable

from renderer.scene import shape_coordinates, shapes
from renderer.scene.limits import SEGMENTS
from renderer.scene.model import Mesh
from renderer.scene.schema import (
    BoxTable,
    ConeTable,
    CylinderTable,
    DiskTable,
    MeshTable,
    RectangleTable,
    SphereTable,
    TorusTable,
)


def shape_of(table: MeshTable) -> Hashable:
    """Return a key that is equal for tables of the same shape, whatever their place and
    material.
    """
    own = (name for name in table.__struct_fields__ if name not in MeshTable.__struct_fields__)
    return (type(table), *(getattr(table, name) for name in own))


def mesh_of(table: MeshTable) -> Mesh:
    """The shape in its own space. Raises LucidaError."""
    match table:
        case BoxTable():
            return shapes.box(table.size)
        case RectangleTable():
            return shapes.rectangle(table.width, table.depth)
        case DiskTable():
            return shapes.disk(table.radius, table.segments)
        case CylinderTable():
            return shapes.cylinder(table.radius, table.height, table.segments, table.smooth)
        case ConeTable():
            return shapes.cone(table.radius, table.height, table.segments, table.smooth)
        case TorusTable():
            return shapes.torus(
                table.radius, table.tube_radius, table.segments, table.sides, table.smooth
            )
    raise AssertionError(f"no mesh for {table!r}")


def mapped(mesh: Mesh, table: MeshTable) -> Mesh:
    """Return the mesh of a table with texture coordinates: schema.py documents them."""
    match table:
        case BoxTable():
            return shape_coordinates.on_box(mesh)
        case CylinderTable() | ConeTable():
            return shape_coordinates.on_cylinder(mesh)
        case TorusTable():
            return shape_coordinates.on_torus(mesh, table.radius)
    return shape_coordinates.on_plane(mesh)


def made_triangles(table: SphereTable | MeshTable) -> int:
    """Return the number of triangles of a shape; 0 for a sphere, which has none, and for a
    model.
    """
    match table:
        case BoxTable():
            return 12
        case RectangleTable():
            return 2
        case DiskTable():
            return _bounded(table.segments)
        case CylinderTable():
            return 4 * _bounded(table.segments)
        case ConeTable():
            return 2 * _bounded(table.segments)
        case TorusTable():
            return 2 * _bounded(table.segments) * _bounded(table.sides)
    return 0


def _bounded(count: int) -> int:
    """A number of segments as far as it is legal; the shape refuses others."""
    return min(max(count, 0), SEGMENTS)
