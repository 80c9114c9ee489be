"""The cameras of glTF files, .gltf and .glb, each at its node, and a writer of .gltf files with
only cameras.

A glTF camera is centred and has no skew; it does not store an image size.
Source: Khronos, glTF 2.0 Specification, "Cameras".
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from typing import Any

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import listed
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.models.gltf import placed_nodes
from lucida.renderer.files.models.gltf_cameras import UNCLIPPED, gltf_camera
from lucida.renderer.files.models.gltf_file import Gltf, parse_gltf
from lucida.renderer.scene.limits import OBJECTS
from lucida.renderer.system.errors import LucidaError

from .given import Given, Options
from .posed import CameraSet, PosedCamera, sized
from .rigid import ANY_SIZE, UNSEEN_PX, pose_of, rigid

# Clip planes of a camera without them, in units of the viewport's distance (parallel: its height).
NEAR, FAR = 1e-3, 1e3


def recognises(given: Given) -> bool:
    if given.data[:4] == b"glTF":
        return True
    tree = given.json
    return isinstance(tree, dict) and "asset" in tree and ("cameras" in tree or "nodes" in tree)


def read(given: Given, options: Options) -> CameraSet:
    tree, _ = parse_gltf(given.data, given.name)
    cameras: list[PosedCamera] = []
    shown: set[int] = set()
    taken = ["y up, looking along -z", "znear and zfar clip"]
    for placed in placed_nodes(tree):
        if placed.node.camera is None:
            continue
        if len(cameras) == OBJECTS:
            raise LucidaError("nodes", f"hold more than {OBJECTS} cameras", "split the file")
        found = gltf_camera(tree, placed, options.size)
        shown.add(placed.node.camera)
        fit = not found.has_aspect
        if fit:
            name = found.name or len(cameras)
            taken.append(f"{name!r} has no aspectRatio: its yfov is for an image wider than high")
        cameras.append(PosedCamera(found.camera, options.size, found.name, fit=fit))
    notes = tuple(_notes(tree, shown))
    return CameraSet("gltf", tuple(cameras), (*taken, *notes), notes=notes)


def _notes(tree: Gltf, shown: set[int]) -> Iterator[str]:
    """Yield a note for each ignored part of a file."""
    if tree.animations:
        yield "animations are not used: the cameras are at their nodes' resting places"
    for number in sorted(set(range(len(tree.cameras))) - shown):
        yield f"cameras[{number}] is not used: no node of the scene holds it"


def write(cameras: Sequence[PosedCamera], options: Options) -> bytes:
    lenses, nodes = [], []
    for number, posed in enumerate(cameras):
        camera, size = sized(posed, options)
        camera = rigid(camera, "gltf")
        lenses.append(camera_table(camera, size))
        nodes.append({"name": posed.name, "camera": number, "matrix": node_matrix(camera)})
        if not posed.name:
            del nodes[-1]["name"]
    tree = {
        "asset": {"version": "2.0", "generator": "Lucida"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": lenses,
    }
    return (json.dumps(tree, indent=1, ensure_ascii=False) + "\n").encode()


def node_matrix(camera: Camera) -> list[float]:
    """Return a rigid camera's world_from_camera, column by column, as glTF stores matrices."""
    numbers: list[float] = pose_of(camera).T.ravel().tolist()
    return numbers


def camera_table(camera: Camera, size: Size | None) -> dict[str, Any]:
    """Return an entry of a tree's cameras, for a rigid camera.

    size: of the image, if known. Raises LucidaError for an off-centre viewport.
    """
    left, right, bottom, top = camera.viewport
    width, height = right - left, top - bottom
    pixels = size or ANY_SIZE
    off = (left + right) / 2 / width, (bottom + top) / 2 / height
    if max(abs(off[0]) * pixels[0], abs(off[1]) * pixels[1]) > UNSEEN_PX:
        parts = f"{off[0]:.3g} of its width and {off[1]:.3g} of its height"
        raise LucidaError(
            "viewport",
            f"{listed(camera.viewport)} is off the middle by {parts}, which gltf cannot hold",
            "centre it, or write opencv or colmap",
        )
    reach = height if camera.is_parallel else camera.distance
    clip = {
        "znear": NEAR * reach if camera.near is None else camera.near,
        "zfar": camera.far,
    }
    if camera.is_parallel:
        clip["zfar"] = FAR * reach if camera.far is None else camera.far
        table: dict[str, Any] = {
            "type": "orthographic",
            "orthographic": {"xmag": width / 2, "ymag": height / 2, **clip},
        }
    else:
        fields: dict[str, Any] = {"yfov": 2 * math.atan2(height / 2, camera.distance), **clip}
        fields["aspectRatio"] = width / height
        if camera.far is None:
            del fields["zfar"]  # glTF's infinite projection
        table = {"type": "perspective", "perspective": fields}
    made = [name for name, given in (("znear", camera.near), ("zfar", camera.far)) if given is None]
    if made:
        table["extras"] = {UNCLIPPED: made}
    return table
