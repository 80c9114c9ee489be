"""The structure of a scene: objects with a shape and a material, lights, and an initial camera.

World space is right-handed with y up; colours are linear light.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import LARGEST, volume
from lucida.renderer.images.frame import DISPLAY
from lucida.renderer.system.errors import LucidaError, one_line, shortened

from .material import BRIGHTEST as BRIGHTEST
from .material import Checker as Checker
from .material import Color as Color
from .material import Material, color, length, vector
from .material import without_metal as without_metal
from .origin import Origin
from .texture import is_final

Floats32 = NDArray[np.float32]

LONGEST_NAME = 200  # letters
PLAIN = Material()


def _shown(name: str) -> str:
    """Return a name that windows, terminals and files can show, from any file."""
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
class PointLight:
    """A light at a point, equally strong at any distance (no fall-off, as in the lecture)."""

    position: tuple[float, float, float]
    color: Color = (1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", vector("position", self.position))
        object.__setattr__(self, "color", color("color", self.color))


@dataclass(frozen=True)
class DirectionalLight:
    """A light along `direction` (from the light to the scene), infinitely far away."""

    direction: tuple[float, float, float]
    color: Color = (1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", vector("direction", self.direction))
        object.__setattr__(self, "color", color("color", self.color))
        if not np.linalg.norm(self.direction) > 1e-12:
            raise LucidaError("direction", "(0, 0, 0) has no direction", "give e.g. (0, -1, 0)")


@dataclass(frozen=True)
class Sphere:
    """A sphere in world space, exact in both renderers."""

    center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    radius: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector("center", self.center))
        radius = length("radius", self.radius, 1e-9, "give e.g. 1.0")
        object.__setattr__(self, "radius", radius)


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles. vertices: float32 (n, 3). faces: int32 (m, 3), indices of vertices, m >= 1.

    normals: float32 (n, 3), unit, per vertex, or None for flat faces; a row of 0 makes the faces
    flat at that vertex. colors: float32 (n, 3), linear, multiply the material's diffuse.
    uv: float32 (n, 2), texture coordinates of the vertices (texture.py), or None.
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
        if not (np.abs(vertices) <= LARGEST).all():  # False for NaN, too
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

    def __repr__(self) -> str:
        return f"Mesh({len(self.vertices)} vertices, {len(self.faces)} triangles)"

    def placed(self, transform: ArrayLike) -> Mesh:
        """Return the same mesh with another transform. It shares the arrays, which are not checked
        again. Raises LucidaError.
        """
        mesh = copy.copy(self)
        object.__setattr__(mesh, "transform", _checked_transform(transform))
        return mesh


def _checked_transform(value: ArrayLike) -> NDArray[np.float64]:
    transform = _array("transform", value, np.float64, (4, 4))
    if not ((np.abs(transform) <= LARGEST).all() and (transform[3] == (0, 0, 0, 1)).all()):
        raise LucidaError("transform", "is too large, or not affine", "scale it down")
    if is_flat(transform[:3, :3]):
        raise LucidaError("transform", "is not invertible", "give scales other than 0")
    return transform


def is_flat(linear: NDArray[np.float64]) -> bool:
    """Return True if a matrix (3, 3) is singular or nearly so, and would flatten a shape."""
    most = np.maximum(np.abs(linear).max(axis=0), 1e-300)  # so that no square leaves float64
    lengths = most * np.linalg.norm(linear / most, axis=0)
    return not ((lengths > 1e-12).all() and abs(volume(*(linear / lengths).T)) > 1e-9)


Shape = Sphere | Mesh


@dataclass(frozen=True, eq=False)
class SceneObject:
    """An entry of the `id` channel: a named shape with a material.

    hidden: no renderer draws it; it keeps its id.
    """

    shape: Shape
    material: Material = PLAIN
    name: str = ""
    hidden: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", _shown(self.name))
        object.__setattr__(self, "hidden", bool(self.hidden))
        image = self.material.image
        if image is not None and image.rotate_deg and isinstance(self.shape, Sphere):
            problem = "turns its texture, which a sphere cannot show"
            raise LucidaError("material", problem, "leave rotate_deg out")
        if image is not None and isinstance(self.shape, Mesh) and self.shape.uv is None:
            raise LucidaError(
                "material",
                "has a texture, but the mesh has no texture coordinates",
                "give another material, or a mesh with coordinates",
            )


@dataclass(frozen=True)
class View:
    """A camera whose viewport may follow the image's aspect ratio.

    given: a camera, and (width, height) of its own image.
    """

    camera: Camera
    fit: bool = False
    given: tuple[Camera, tuple[int, int] | None] | None = field(
        default=None, compare=False, repr=False
    )

    def __post_init__(self) -> None:
        object.__setattr__(self, "fit", bool(self.fit))

    @property
    def own_size(self) -> tuple[int, int] | None:
        """Return the size of this camera's own image, or None."""
        return self.given[1] if self.given is not None and self.given[0] == self.camera else None

    def for_size(self, size: tuple[int, int]) -> Camera:
        """Return the camera that draws an image of (width, height).

        The pixels of a camera with its own image keep their shape.
        """
        if self.fit:
            return self.camera.fitted(size)
        own = None if self.given is None else self.given[1]
        if self.given is None or own is None or own == size:
            return self.camera
        left, right, bottom, top = self.given[0].viewport
        wide = (right - left) / own[0] * own[1] / (top - bottom)  # a pixel's width over its height
        return self.camera.fitted((wide * size[0], size[1]))


@dataclass(frozen=True)
class NamedView:
    """A view of a file in addition to the initial one."""

    name: str
    view: View

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", _shown(self.name))


@dataclass(frozen=True, eq=False)
class Scene:
    """Objects in the order of their ids, lights, and an initial view.

    origin: None for a scene made in Python. views: other views of its file, such as a glTF file's
    cameras. notes: a line for each thing in its files that is not shown.
    """

    objects: tuple[SceneObject, ...]
    lights: tuple[PointLight | DirectionalLight, ...] = ()
    ambient: Color = (0.1, 0.1, 0.1)
    background: Color = (0.0, 0.0, 0.0)
    view: View = View(Camera.canonical(), fit=True)
    name: str = ""
    origin: Origin | None = None
    views: tuple[NamedView, ...] = ()
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        objects, lights = len(self.objects), len(self.lights)
        triangles = triangle_count(self.objects)
        name = f"{self.name!r}: " if self.name else ""
        return f"Scene({name}{objects} objects, {triangles:,} triangles, {lights} lights)"

    def _repr_html_(self) -> str:
        html: str = import_module(DISPLAY).scene_html(self)
        return html

    @property
    def visible(self) -> tuple[tuple[int, SceneObject], ...]:
        """Return the objects that are not hidden, each with its id."""
        return tuple((k, entry) for k, entry in enumerate(self.objects) if not entry.hidden)

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", tuple(self.objects))
        object.__setattr__(self, "lights", tuple(self.lights))
        object.__setattr__(self, "name", _shown(self.name))
        for name in ("ambient", "background"):
            object.__setattr__(self, name, color(name, getattr(self, name)))


def triangle_count(objects: Iterable[SceneObject]) -> int:
    """Return the number of triangles of some objects; a sphere has none."""
    return sum(len(entry.shape.faces) for entry in objects if isinstance(entry.shape, Mesh))


def has_textures(scene: Scene) -> bool:
    """Return True if any object of the scene has a texture or a metal map."""
    materials = [entry.material for entry in scene.objects]
    return any(each.image is not None or each.metal is not None for each in materials)


def check_scene(scene: object) -> Scene:
    """Return the scene. Raises LucidaError for anything else, such as a file's name."""
    if isinstance(scene, Scene):
        return scene
    remedy = "give load_scene(...) of it" if isinstance(scene, str | Path) else "give a Scene"
    raise LucidaError("scene", f"is of type {type(scene).__name__}, not a Scene", remedy)
