"""The structure of a scene: objects with a shape and a material, lights, and an initial camera.

Defines the structures and validates them. World space is right-handed with y up; colours are linear
light.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import accumulate
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.camera import Camera
from renderer.camera_checks import LARGEST, volume
from renderer.errors import LucidaError, one_line, shortened
from renderer.images.display import from_srgb
from renderer.scene.metal import Metal, reflectances
from renderer.scene.noting import Noted
from renderer.scene.texture import WHITE, Texture, is_final

Color = tuple[float, float, float]
ItemKind = Literal["objects", "lights"]
Floats32 = NDArray[np.float32]

BRIGHTEST = 1e6
LONGEST_NAME = 200  # letters

Keys = tuple[tuple[int, ...], tuple[int, ...]]  # of a scene's objects, and of its lights


def vector(name: str, value: Iterable[float]) -> tuple[float, float, float]:
    """Three finite numbers as a tuple, or a LucidaError that names them."""
    try:
        x, y, z = (float(component) for component in value)
    except (TypeError, ValueError):
        raise LucidaError(name, f"{value!r} is not 3 numbers", "give e.g. [0, 1, 0]") from None
    for component in (x, y, z):
        if not math.isfinite(component) or abs(component) > LARGEST:
            raise LucidaError(name, f"{component} is not a usable number", "give finite numbers")
    return x, y, z


def color(name: str, value: Iterable[float]) -> Color:
    """Three finite numbers >= 0 as a tuple, or a LucidaError that names them."""
    rgb = vector(name, value)
    for component in rgb:
        if not 0 <= component <= BRIGHTEST:
            raise LucidaError(
                name, f"{component:g} is outside 0 to {BRIGHTEST:g}", "give red, green, blue >= 0"
            )
    return rgb


def _shown(name: str) -> str:
    """A name that windows, terminals and files take, whatever file it comes from."""
    return name if name.isalnum() and len(name) < 80 else shortened(one_line(name), LONGEST_NAME)


def _array(name: str, value: ArrayLike, dtype: type, shape: tuple[int | None, int]) -> np.ndarray:
    try:
        array: np.ndarray = np.array(
            value, dtype, order="C", copy=None if is_final(value) else True
        )
    except (TypeError, ValueError, OverflowError):
        raise LucidaError(name, "is not an array of numbers", f"give {dtype.__name__}") from None
    if array.ndim != 2 or any(
        want not in (None, have) for want, have in zip(shape, array.shape, strict=True)
    ):
        wanted = " x ".join("n" if n is None else str(n) for n in shape)
        raise LucidaError(name, f"has shape {array.shape}", f"give {wanted} numbers")
    array.setflags(write=False)
    return array


@dataclass(frozen=True)
class Checker:
    """A solid pattern of cubes in object space: every other cell takes `diffuse`.

    size: a cell's side, in the object's units; one cell is centred on the object's origin.
    """

    diffuse: Color = (0.05, 0.05, 0.05)
    size: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "diffuse", color("diffuse", self.diffuse))
        _check_length("size", self.size, 1e-6, "give a cell's side, e.g. 1")


@dataclass(frozen=True)
class Material:
    """Blinn and Phong's shading: diffuse and specular reflectance, and the highlight's exponent.

    One pattern: none, a checker, or a texture, whose colours diffuse multiplies. metal: a map of
    where the surface is a metal; specular is then that of the rest. Of triangles alone: cutout:
    where the texture's opacity is less than this, there is a hole; single_sided: they are seen only
    on the side from which their corners go counter-clockwise in the space of their object; they
    cast shadows all the same.
    """

    diffuse: Color = (0.7, 0.7, 0.7)
    specular: Color = (0.0, 0.0, 0.0)
    shininess: float = 50.0
    checker: Checker | None = None
    texture: Texture | None = None
    metal: Metal | None = None
    cutout: float | None = None
    single_sided: bool = False

    @property
    def image(self) -> Texture | None:
        """The image that is looked up on the surface: the texture; white if there is a metal
        alone.
        """
        return self.texture or (WHITE if self.metal is not None else None)

    def __post_init__(self) -> None:
        for name in ("diffuse", "specular"):
            object.__setattr__(self, name, color(name, getattr(self, name)))
        if not 1 <= self.shininess <= 1000:
            raise LucidaError(
                "shininess", f"{self.shininess:g} is outside 1 to 1000", "give e.g. 50"
            )
        if self.checker is not None and self.image is not None:
            given = "metal" if self.texture is None else "texture"
            raise LucidaError(given, "is given, and so is a checker", "give one of them")
        if self.cutout is not None and not 0 < self.cutout <= 1e6:
            problem = f"{self.cutout:g} is not an opacity above 0"
            raise LucidaError("cutout", problem, "give e.g. 0.5")


def without_metal(material: Material) -> Material:
    """Return what a material with a metal looks like from far away, with its texture, if any."""
    if material.metal is None or material.image is None:
        return material
    light = from_srgb(material.image.texels[..., :3].reshape(-1, 3).mean(axis=0) / np.float32(255))
    diffuse, metal = np.array(material.diffuse), material.metal
    matt, _ = reflectances(diffuse, *metal.mean, 0.0)
    _, shine = reflectances(diffuse * light, *metal.mean, np.array(material.specular))
    return replace(
        material, diffuse=tuple(matt.tolist()), specular=tuple(shine.tolist()), metal=None
    )


@dataclass(frozen=True)
class PointLight:
    """Shines from a point, equally far and near (no fall-off: the lecture's model)."""

    position: tuple[float, float, float]
    color: Color = (1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", vector("position", self.position))
        object.__setattr__(self, "color", color("color", self.color))


@dataclass(frozen=True)
class DirectionalLight:
    """Shines along `direction` (from the light to the scene), from infinitely far."""

    direction: tuple[float, float, float]
    color: Color = (1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", vector("direction", self.direction))
        object.__setattr__(self, "color", color("color", self.color))
        if not np.linalg.norm(self.direction) > 1e-12:
            raise LucidaError("direction", "(0, 0, 0) has no direction", "give e.g. (0, -1, 0)")


def _check_length(field: str, value: float, least: float, remedy: str) -> None:
    """Raises LucidaError where a length is not one from least to LARGEST."""
    if not least <= value <= LARGEST:
        wrong = f"is outside {least:g} to {LARGEST:g}" if value > 0 else "is not above 0"
        raise LucidaError(field, f"{value:g} {wrong}", remedy)


@dataclass(frozen=True)
class Sphere:
    """Exact in both renderers, never triangles. In world space."""

    center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    radius: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector("center", self.center))
        _check_length("radius", self.radius, 1e-9, "give e.g. 1.0")


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles. vertices: float32 (n, 3). faces: int32 (m, 3), indices of vertices, m >= 1.

    normals: float32 (n, 3), unit, per vertex, or None for flat faces; a row of 0 makes the faces
    at that vertex flat there. colors: float32 (n, 3), linear, multiply the material's diffuse.
    uv: float32 (n, 2), where of a texture each vertex is (texture.py), or None for no such places.
    transform: float64 (4, 4), world_from_object, affine and invertible. Arrays are read-only.
    """

    vertices: Floats32
    faces: NDArray[np.int32]
    normals: Floats32 | None = None
    colors: Floats32 | None = None
    transform: NDArray[np.float64] = field(default_factory=lambda: np.eye(4))
    uv: Floats32 | None = None

    def __post_init__(self) -> None:
        vertices = _array("vertices", self.vertices, np.float32, (None, 3))
        if not len(vertices):
            raise LucidaError("vertices", "is empty", "give a mesh with at least one triangle")
        if not (np.abs(vertices) <= LARGEST).all():  # False for NaN too
            raise LucidaError("vertices", "holds NaN or infinity", "repair the mesh")
        faces = np.asarray(self.faces)
        if faces.ndim == 2 and len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
            raise LucidaError("faces", "names a vertex that does not exist", "repair the mesh")
        faces = _array("faces", faces, np.int32, (None, 3))
        if not len(faces):
            raise LucidaError("faces", "is empty", "give a mesh with at least one triangle")
        object.__setattr__(self, "vertices", vertices)
        object.__setattr__(self, "faces", faces)
        for name, width in (("normals", 3), ("colors", 3), ("uv", 2)):
            value = getattr(self, name)
            if value is not None:
                value = _array(name, value, np.float32, (len(vertices), width))
                if not np.isfinite(value).all():
                    raise LucidaError(name, "holds NaN or infinity", "repair the mesh")
                object.__setattr__(self, name, value)
        object.__setattr__(self, "transform", _checked_transform(self.transform))

    def placed(self, transform: ArrayLike) -> Mesh:
        """The same triangles with another transform: the same arrays, which are not checked again.
        Raises LucidaError."""
        mesh = copy.copy(self)
        object.__setattr__(mesh, "transform", _checked_transform(transform))
        return mesh


def _checked_transform(value: ArrayLike) -> NDArray[np.float64]:
    transform = _array("transform", value, np.float64, (4, 4))
    if not ((np.abs(transform) <= LARGEST).all() and (transform[3] == (0, 0, 0, 1)).all()):
        raise LucidaError("transform", "is too large, or not affine", "scale it down")
    linear = transform[:3, :3]
    lengths = np.linalg.norm(linear, axis=0)
    if not ((lengths > 1e-12).all() and abs(volume(*(linear / lengths).T)) > 1e-9):
        raise LucidaError("transform", "is not invertible", "give scales other than 0")
    return transform


Shape = Sphere | Mesh


@dataclass(frozen=True, eq=False)
class SceneObject:
    """One entry of the `id` channel: a named shape with a material. hidden: neither renderer draws
    it, and it keeps its id."""

    shape: Shape
    material: Material = Material()
    name: str = ""
    hidden: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", _shown(self.name))
        image = self.material.image
        if image is not None and image.rotate_deg and isinstance(self.shape, Sphere):
            problem = "turns its texture, which a sphere cannot show"
            raise LucidaError("material", problem, "leave rotate_deg out")
        if image is not None and isinstance(self.shape, Mesh) and self.shape.uv is None:
            raise LucidaError(
                "material",
                "has a texture, and the mesh no texture coordinates",
                "give another material, or a mesh with coordinates",
            )


@dataclass(frozen=True)
class View:
    """A camera, and whether its viewport follows the image's aspect ratio.

    given: a camera, and (width, height) of the image that it was given for.
    """

    camera: Camera
    fit: bool = False
    given: tuple[Camera, tuple[int, int] | None] | None = field(
        default=None, compare=False, repr=False
    )

    @property
    def own_size(self) -> tuple[int, int] | None:
        """Return the size of the image that this very camera was given for, if there is one."""
        return self.given[1] if self.given is not None and self.given[0] == self.camera else None

    def for_size(self, size: tuple[int, int]) -> Camera:
        """The camera to draw an image of (width, height) with."""
        return self.camera.fitted(size) if self.fit else self.camera


@dataclass(frozen=True)
class NamedView:
    """A view of a file in addition to the initial one."""

    name: str
    view: View

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", _shown(self.name))


@dataclass(frozen=True, eq=False)
class FileEntry:
    """One of the [[objects]] of a scene file, and the objects made from it. Never written to.

    key: a number that no other entry has in this process; it stays, whatever is edited. table: as
    in the file; fields: the same as a structure of schema.py. material: the one that it names or
    gives, None for neither. made: its shapes as they were built or read, before they were placed;
    none for a sphere. objects: the scene's, in their order; a model has one for each of its parts.
    views: the model's own cameras; path: its file's, absolute; notes: what of its textures is not
    shown.
    """

    key: int
    table: dict[str, Any]
    fields: Any
    material: Material | None
    made: tuple[SceneObject, ...]
    objects: tuple[SceneObject, ...]
    views: tuple[NamedView, ...] = ()
    path: str = ""
    notes: tuple[str, ...] = ()


class SavedFile:
    """The contents of a scene's file when this program last read or wrote it.

    Shared by all the versions that editing makes of a scene, including those that undo brings back:
    when one of them is saved, all know it. So it is the one thing here that changes; only saving
    changes it, and one window's thread at a time. path: None while there is no such file. text: the
    file's own, the basis for writing another one; "" for none. tables: its contents, None for
    nothing yet; keys: of its objects and of its lights, in their order there.
    """

    def __init__(
        self,
        path: Path | None = None,
        text: str = "",
        tables: dict[str, Any] | None = None,
        keys: Keys = ((), ()),
    ) -> None:
        self.path, self.text, self.tables, self.keys = path, text, tables, keys


@dataclass(frozen=True, eq=False)
class Origin:
    """The origin of a scene, so that it can be written again.

    source: an argument of load_scene, a built-in scene's name or an absolute path; "" for neither.
    tables: of its scene file, as read or edited, never written to; None for a model alone. folder:
    the start of its paths. files: all that it was read from, as they were then; none of what is
    built in. entries: one for each of the tables' objects. light_keys: one for each of their
    lights, as FileEntry.key. saved: the file itself.
    """

    source: str
    tables: dict[str, Any] | None = None
    folder: Path = Path()
    files: Noted = field(default_factory=dict)
    entries: tuple[FileEntry, ...] = ()
    light_keys: tuple[int, ...] = ()
    saved: SavedFile = field(default_factory=SavedFile)

    @cached_property
    def keys(self) -> Keys:
        """The keys of the objects and of the lights."""
        return tuple(entry.key for entry in self.entries), self.light_keys

    @cached_property
    def places(self) -> dict[int, tuple[ItemKind, int]]:
        """By key: in which list of the tables an item is, and its number there."""
        kinds: tuple[ItemKind, ItemKind] = ("objects", "lights")
        return {
            key: (kind, number)
            for kind, keys in zip(kinds, self.keys, strict=True)
            for number, key in enumerate(keys)
        }

    @cached_property
    def first_ids(self) -> tuple[int, ...]:
        """The first of each entry's ids in images, and the number of all ids."""
        return tuple(accumulate((len(entry.objects) for entry in self.entries), initial=0))


@dataclass(frozen=True, eq=False)
class Scene:
    """Objects in the order of their ids, lights, and a view to begin with. origin: None for a
    scene that was made in Python. views: others that its file has: a glTF file's cameras. notes:
    what of its files is not shown, a line each."""

    objects: tuple[SceneObject, ...]
    lights: tuple[PointLight | DirectionalLight, ...] = ()
    ambient: Color = (0.1, 0.1, 0.1)
    background: Color = (0.0, 0.0, 0.0)
    view: View = View(Camera.canonical(), fit=True)
    name: str = ""
    origin: Origin | None = None
    views: tuple[NamedView, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def visible(self) -> tuple[tuple[int, SceneObject], ...]:
        """The objects that are not hidden, each with its id."""
        return tuple((k, entry) for k, entry in enumerate(self.objects) if not entry.hidden)

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", tuple(self.objects))
        object.__setattr__(self, "lights", tuple(self.lights))
        object.__setattr__(self, "name", _shown(self.name))
        for name in ("ambient", "background"):
            object.__setattr__(self, name, color(name, getattr(self, name)))


def triangles_of(objects: Iterable[SceneObject]) -> int:
    return sum(len(entry.shape.faces) for entry in objects if isinstance(entry.shape, Mesh))


def has_textures(scene: Scene) -> bool:
    """Return whether any object of the scene has a texture."""
    return any(entry.material.image is not None for entry in scene.objects)


def has_metals(scene: Scene) -> bool:
    """Return whether any object of the scene has a metal map."""
    return any(entry.material.metal is not None for entry in scene.objects)


def check_scene(scene: object) -> Scene:
    """The scene; raises LucidaError for anything else, such as a file's name."""
    if isinstance(scene, Scene):
        return scene
    remedy = "give load_scene(...) of it" if isinstance(scene, str | Path) else "give a Scene"
    raise LucidaError("scene", f"is a {type(scene).__name__}, not a Scene", remedy)
