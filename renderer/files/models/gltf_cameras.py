"""The cameras of a glTF tree, at their nodes.

A node's scale moves its cameras but does not change them, as the format says.
Source: Khronos, glTF 2.0 Specification, "Cameras".
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Annotated, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import volume
from lucida.renderer.files.models.gltf_file import Gltf, Table, entry_at
from lucida.renderer.files.models.gltf_nodes import PlacedNode
from lucida.renderer.files.tables import explained
from lucida.renderer.scene.limits import VIEWS
from lucida.renderer.scene.model import NamedView, View
from lucida.renderer.system.errors import LucidaError, under

# In a camera's extras: the names of clip planes that are written because the format needs a number.
UNCLIPPED = "lucida_unclipped"


Positive = Annotated[float, msgspec.Meta(gt=0)]


class PerspectiveFields(Table):
    yfov: Annotated[float, msgspec.Meta(gt=0, lt=math.pi)]  # radians
    znear: Positive
    zfar: Positive | None = None
    aspect_ratio: Positive | None = None


class OrthographicFields(Table):
    xmag: Positive
    ymag: Positive
    znear: Annotated[float, msgspec.Meta(ge=0)]
    zfar: Positive


class GltfCamera(Table):
    type: str
    name: str = ""
    perspective: PerspectiveFields | None = None
    orthographic: OrthographicFields | None = None
    extras: Any = None


@dataclass(frozen=True)
class FoundCamera:
    """A camera of the file.

    has_aspect: the viewport has the file's own aspect ratio; otherwise it is 1.
    """

    name: str
    camera: Camera
    has_aspect: bool


def camera_views(tree: Gltf, nodes: Iterable[PlacedNode]) -> tuple[NamedView, ...]:
    """Return the views of all sound cameras, each fitted to the image. A model is not refused for
    its cameras.
    """
    views: list[NamedView] = []
    for placed in nodes:
        if placed.node.camera is not None and len(views) < VIEWS:
            try:
                found = gltf_camera(tree, placed)
            except LucidaError:
                continue
            name = found.name or f"camera {len(views) + 1}"
            views.append(NamedView(name, View(found.camera, fit=True)))
    return tuple(views)


def gltf_camera(tree: Gltf, placed: PlacedNode) -> FoundCamera:
    """Return the camera of a node that has one. Raises LucidaError naming the field."""
    number = placed.node.camera
    assert number is not None
    given = entry_at(tree.cameras, number, f"{placed.field}.camera")
    field = f"cameras[{number}]"
    try:
        fields = msgspec.convert(given, GltfCamera)
    except msgspec.ValidationError as error:
        raise explained(str(error)).within(field) from None
    eye, (u, v, w) = _pose(placed)
    name = placed.node.name or fields.name
    with under(field):
        lens, has_aspect = _lens(fields)
        camera = Camera(eye=eye, u=u, v=v, w=w, **lens).orthonormalized()
    return FoundCamera(name, _unclipped(camera, fields.extras), has_aspect)


def _lens(fields: GltfCamera) -> tuple[dict[str, Any], bool]:
    """Return the camera's fields except its pose, and True if the aspect ratio is the file's."""
    if fields.type == "perspective" and (seen := fields.perspective) is not None:
        half = (seen.aspect_ratio or 1.0) / 2
        lens: dict[str, Any] = {
            "distance": 0.5 / math.tan(seen.yfov / 2),
            "viewport": (-half, half, -0.5, 0.5),
            "near": seen.znear,
            "far": seen.zfar,
        }
        return lens, seen.aspect_ratio is not None
    if fields.type == "orthographic" and (box := fields.orthographic) is not None:
        lens = {
            "viewport": (-box.xmag, box.xmag, -box.ymag, box.ymag),
            "projection": "parallel",
            "near": box.znear or None,  # 0 is the eye's own plane, where rays begin
            "far": box.zfar,
        }
        return lens, True
    problem = f"{fields.type[:20]!r} is neither perspective nor orthographic, or its numbers lack"
    raise LucidaError("type", problem, "export it again")


def _unclipped(camera: Camera, extras: Any) -> Camera:
    """Return the camera without the clip planes that were written only because the format needs
    them.
    """
    names = extras.get(UNCLIPPED) if isinstance(extras, dict) else None
    if isinstance(names, list):
        camera = replace(camera, near=None) if "znear" in names else camera
        camera = replace(camera, far=None) if "zfar" in names else camera
    return camera


def _pose(placed: PlacedNode) -> tuple[Any, NDArray[np.float64]]:
    """Return the eye, and the unit directions u, v, w, right-handed: a camera's axes are not
    scaled or mirrored like its node.
    """
    linear = placed.matrix[:3, :3]
    lengths = np.linalg.norm(linear, axis=0)
    if not (np.isfinite(placed.matrix).all() and (lengths > 1e-12).all()):
        problem = "is scaled to nothing, or beyond all numbers, and holds a camera"
        raise LucidaError(placed.field, problem, "give it a scale other than 0")
    axes = (linear / lengths).T
    if volume(*axes) < 0:
        axes[0] *= -1
    return placed.matrix[:3, 3].tolist(), axes
