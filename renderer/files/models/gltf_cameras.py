"""The cameras of a glTF tree, at their nodes.

As the format requires, a node's scale moves its cameras but does not change them.
Source: Khronos, glTF 2.0 Specification, "Cameras".
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterable
from typing import Annotated, Any, NamedTuple

import msgspec
import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import volume
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.tables import explained
from lucida.renderer.scene.limits import VIEWS
from lucida.renderer.scene.model import NamedView, View
from lucida.renderer.system.errors import LucidaError, under

from .gltf import PlacedNode
from .gltf_file import AGAIN, Gltf, Table

# The key in a camera's extras for clip planes that are written only because the format needs them.
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


class FoundCamera(NamedTuple):
    """has_aspect: the viewport has the file's aspect ratio, or the image's; otherwise it is 1."""

    name: str
    camera: Camera
    has_aspect: bool


def camera_views(tree: Gltf, nodes: Iterable[PlacedNode]) -> tuple[NamedView, ...]:
    """Return the views of all valid cameras, each fitted to the image. Others are ignored."""
    views: list[NamedView] = []
    for placed in nodes:
        if placed.node.camera is not None and len(views) < VIEWS:
            with contextlib.suppress(LucidaError):
                found = gltf_camera(tree, placed)
                name = found.name or f"camera {len(views) + 1}"
                views.append(NamedView(name, View(found.camera, fit=True)))
    return tuple(views)


def gltf_camera(tree: Gltf, placed: PlacedNode, size: Size | None = None) -> FoundCamera:
    """Return the camera of a node that has one. size: of the image, if known, which replaces a
    missing aspectRatio. Raises LucidaError naming the field.
    """
    assert placed.node.camera is not None
    given = tree.entry("cameras", placed.node.camera)
    with under(f"cameras[{placed.node.camera}]"):
        try:
            fields = msgspec.convert(given, GltfCamera)
        except msgspec.ValidationError as error:
            raise explained(str(error)) from None
        with np.errstate(all="ignore"):
            axes = (placed.matrix[:3, :3] / np.linalg.norm(placed.matrix[:3, :3], axis=0)).T
        if volume(*axes) < 0:  # a camera is not mirrored like its node
            axes[0] *= -1
        u, v, w = axes.tolist()
        camera = Camera(
            placed.matrix[:3, 3].tolist(), u, v, w, **_lens(fields, size)
        ).orthonormalized()
    seen = fields.perspective
    has_aspect = seen is None or seen.aspect_ratio is not None or size is not None
    return FoundCamera(placed.node.name or fields.name, camera, has_aspect)


def _lens(fields: GltfCamera, size: Size | None) -> dict[str, Any]:
    """Return the camera's fields except its pose."""
    if fields.type == "perspective" and (seen := fields.perspective) is not None:
        half = (seen.aspect_ratio or (size[0] / size[1] if size is not None else 1.0)) / 2
        lens: dict[str, Any] = {
            "distance": 0.5 / math.tan(seen.yfov / 2),
            "viewport": (-half, half, -0.5, 0.5),
            "near": seen.znear,
            "far": seen.zfar,
        }
    elif fields.type == "orthographic" and (box := fields.orthographic) is not None:
        lens = {
            "viewport": (-box.xmag, box.xmag, -box.ymag, box.ymag),
            "projection": "parallel",
            "near": box.znear or None,  # 0 is the eye's plane, where rays begin
            "far": box.zfar,
        }
    else:
        problem = f"{fields.type[:20]!r} is not perspective or orthographic, or lacks its numbers"
        raise LucidaError("type", problem, AGAIN)
    unclipped = fields.extras.get(UNCLIPPED) if isinstance(fields.extras, dict) else None
    for name in unclipped if isinstance(unclipped, list) else ():
        lens |= {"znear": {"near": None}, "zfar": {"far": None}}.get(str(name), {})
    return lens
