"""The tables of scene files and view files, as msgspec structures that document the format.

Constraints beyond the types are checked by the structures that the tables become.

A colour is [red, green, blue] in linear light, or "#rrggbb" in sRGB, as in colour pickers.
Lengths are in world units, angles in degrees, y is up.
"""

from __future__ import annotations

from typing import Any

import msgspec

Numbers3 = tuple[float, float, float]
ColorValue = Numbers3 | str


class StrictTable(msgspec.Struct, kw_only=True, forbid_unknown_fields=True):
    """A table in which an unknown field is an error."""


class LensFields(StrictTable):
    """The fields of [camera] in both forms."""

    projection: str = "perspective"
    near: float | None = None
    far: float | None = None
    lens: dict[str, Any] | None = None
    fit: bool | None = None


class CameraFields(LensFields):
    """[camera] by the camera's own fields, in view files and scene files.

    The default of every field is the canonical camera's.

    lens: its model and coefficients. fit: widen the viewport to each image's aspect ratio.
    """

    eye: Numbers3 = (0.0, 0.0, 0.0)
    u: Numbers3 = (1.0, 0.0, 0.0)
    v: Numbers3 = (0.0, 1.0, 0.0)
    w: Numbers3 = (0.0, 0.0, 1.0)
    distance: float = 1.0
    viewport: tuple[float, float, float, float] = (-0.5, 0.5, -0.5, 0.5)


class LookAtFields(LensFields, kw_only=True):
    """[camera] by its target, in view files and scene files; recognised by `target`.

    Give fov_y_deg, or the distance of a viewport 1 high. aspect: the viewport's width over its
    height; a fitted picture contains all of it. fit: as above, by default true.
    """

    eye: Numbers3
    target: Numbers3
    up: Numbers3 = (0.0, 1.0, 0.0)
    fov_y_deg: float | None = None
    distance: float | None = None
    aspect: float = 1.0


class ViewFile(StrictTable):
    """A view file: `lucida = 1`, if given, and [camera]: CameraFields or LookAtFields."""

    camera: dict[str, Any]


class CheckerTable(StrictTable):
    """checker = { diffuse, size }: every other cell of a pattern of cubes takes this colour."""

    diffuse: ColorValue = (0.05, 0.05, 0.05)
    size: float = 1.0


class TextureTable(StrictTable):
    """texture = { file, wrap, scale, offset, rotate_deg }, or the file alone: an image that diffuse
    multiplies.

    file: its path, relative to the scene file, and in that file's folder. wrap: the texels beyond
    the image: "repeat", "mirror" or "clamp", or two of them, across and up. scale: how often the
    image fits into the area that it would otherwise cover once. offset: added to the texture
    coordinates, in widths and heights of the image; 0.25 shows the part a quarter farther right.
    rotate_deg: turns the coordinates counter-clockwise about the image's lower left corner, after
    the scale and before the offset; not on a sphere.

    The image covers each side of a box; a rectangle, with its lower edge in front (+z); and the
    square around a disk or an end of a cylinder or cone. It covers the side of a cylinder, a cone,
    a torus (around its tube from the outside, upwards) and a sphere (from pole to pole) once around
    y, with its middle in front (+z). A model needs its own coordinates.
    """

    file: str
    wrap: str | tuple[str, str] = "repeat"
    scale: float | tuple[float, float] = 1.0
    offset: tuple[float, float] = (0.0, 0.0)
    rotate_deg: float = 0.0


class MetalTable(StrictTable):
    """metal = { file, metalness, roughness }, or the file alone: an image of the metalness (blue,
    as in glTF) and the roughness (green). A metal's highlight has the texture's colour. The image
    covers the same area as a texture. metalness, roughness: factors of these values; without a
    file, the values everywhere.
    """

    file: str = ""
    metalness: float = 1.0
    roughness: float = 1.0


class MaterialTable(StrictTable):
    """[materials.NAME], or a table in an object's `material`: with a checker, a texture, or none.

    diffuse: white by default if there is a texture or a metal. cutout: an opacity, 0 to 1; the
    surface has a hole, for rays and shadows, wherever the texture's is less.
    single_sided: a triangle is visible only from the side on which its corners go
    counter-clockwise; it keeps its shadow. Neither of the two affects spheres.
    """

    diffuse: ColorValue | None = None
    specular: ColorValue = (0.0, 0.0, 0.0)
    shininess: float = 50.0
    checker: CheckerTable | None = None
    texture: str | TextureTable | None = None
    metal: str | MetalTable | None = None
    cutout: float | None = None
    single_sided: bool = False


class ObjectTable(StrictTable, tag_field="type"):
    """The fields of all [[objects]]. material: a name from [materials], or a table.

    hidden: neither renderer draws it. locked: the window's mouse cannot select or move it.
    """

    name: str = ""
    material: str | MaterialTable | None = None
    hidden: bool = False
    locked: bool = False


class SphereTable(ObjectTable, tag="sphere"):
    """An exact sphere."""

    center: Numbers3 = (0.0, 0.0, 0.0)
    radius: float = 1.0


class MeshTable(ObjectTable):
    """The fields of all objects made of triangles: scaled first, then rotated, then translated.

    rotate_deg: about the world's x axis, then y, then z. scale: one factor or three.
    """

    translate: Numbers3 = (0.0, 0.0, 0.0)
    rotate_deg: Numbers3 = (0.0, 0.0, 0.0)
    scale: float | Numbers3 = 1.0


class BoxTable(MeshTable, tag="box"):
    """size: the sides along x, y and z, or one number for a cube. Centred on its origin."""

    size: float | Numbers3 = 1.0


class RectangleTable(MeshTable, tag="rectangle"):
    """In the plane y = 0, facing up."""

    width: float = 1.0
    depth: float = 1.0


class DiskTable(MeshTable, tag="disk"):
    """In the plane y = 0, facing up."""

    radius: float = 0.5
    segments: int = 64


class RoundTable(MeshTable):
    """The fields of a cylinder and a cone."""

    radius: float = 0.5
    height: float = 1.0
    segments: int = 64
    smooth: bool = True


class CylinderTable(RoundTable, tag="cylinder"):
    """A closed cylinder about the y axis."""


class ConeTable(RoundTable, tag="cone"):
    """A closed cone about the y axis, its tip up."""


class TorusTable(MeshTable, tag="torus"):
    """A torus about the y axis: a tube of tube_radius around a circle of radius."""

    radius: float = 0.5
    tube_radius: float = 0.2
    segments: int = 96
    sides: int = 48
    smooth: bool = True


class ModelTable(MeshTable, tag="model", kw_only=True):
    """A model file, its path relative to the scene file. material: replaces the file's own.
    single_sided: replaces its materials' value."""

    file: str
    single_sided: bool | None = None


AnyObject = (
    SphereTable
    | BoxTable
    | RectangleTable
    | DiskTable
    | CylinderTable
    | ConeTable
    | TorusTable
    | ModelTable
)


class LightTable(StrictTable, tag_field="type"):
    """The fields of all [[lights]]. hidden: the light is off. locked: as for objects."""

    name: str = ""
    color: ColorValue = (1.0, 1.0, 1.0)
    hidden: bool = False
    locked: bool = False


class PointLightTable(LightTable, tag="point", kw_only=True):
    """A light that shines from `position`, without falling off."""

    position: Numbers3


class DirectionalLightTable(LightTable, tag="directional", kw_only=True):
    """A light that shines along `direction`, from infinitely far away."""

    direction: Numbers3


AnyLight = PointLightTable | DirectionalLightTable


class SceneFile(StrictTable, kw_only=True):
    """A scene file. The default lights, and a camera that sees all, replace missing ones.

    The inner tables are read one by one, each by its structure above.
    """

    name: str = ""
    ambient: ColorValue | None = None
    background: ColorValue | None = None
    camera: dict[str, Any] | None = None
    materials: dict[str, Any] = {}
    objects: list[Any]
    lights: list[Any] | None = None
