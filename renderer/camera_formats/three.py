"""Cameras of three.js, as Object3D.toJSON() writes them: alone, or within the scene's objects.

A camera looks along -z with y up; `matrix` is parent-from-camera, column-major. An off-centre
picture has a view offset, which also holds its size in pixels. If near and far are missing,
three.js uses its defaults; here they are fitted to the scene.
Source: three.js, PerspectiveCamera and OrthographicCamera .updateProjectionMatrix(), ObjectLoader.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from typing import Any
from uuid import NAMESPACE_URL, uuid5

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import LARGEST, Floats, listed, number, numbers, positive
from renderer.camera_formats.entries import errors_within, sized
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.posed import CameraSet, PosedCamera
from renderer.camera_formats.rigid import ROUNDED, pose_of, rigid, rotation_of
from renderer.errors import LucidaError

PERSPECTIVE, PARALLEL = "PerspectiveCamera", "OrthographicCamera"
Table = dict[str, Any]
Window = tuple[float, float, float, float]  # left, right, bottom, top

_PARTS = {"fullWidth": 1.0, "fullHeight": 1.0, "width": 1.0, "height": 1.0}


def recognises(given: Given) -> bool:
    return _root(given) is not None


def read(given: Given, options: Options) -> CameraSet:
    root = _root(given)
    if root is None:
        raise LucidaError("object", "is no object of three.js", "give what .toJSON() returns")
    posed = []
    for field, table, pose in _objects(root):
        if table.get("type") in (PERSPECTIVE, PARALLEL):
            with errors_within(field):
                posed.append(_posed(table, pose, options))
    taken: tuple[str, ...] = ("camera to world, column after column", "y up, -z forward")
    if any(camera.fit for camera in posed):
        taken += ("no size of an image is given: widened to each image's",)
    return CameraSet("three", tuple(posed), taken)


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    tables = []
    for posed in cameras:
        camera, size = sized(posed, options)
        with errors_within(posed.name):
            tables.append(_table(camera, size, posed.name))
    if len(tables) == 1:
        root = tables[0]
    else:
        root = {"type": "Group", "name": "cameras", "layers": 1}
        root |= {"matrix": np.eye(4).ravel().tolist(), "children": tables}
    root = {"uuid": _uuid(root)} | root
    metadata = {"version": 4.6, "type": "Object", "generator": "Lucida"}
    return {"": (json.dumps({"metadata": metadata, "object": root}, indent=1) + "\n").encode()}


def _root(given: Given) -> Table | None:
    """Return the object in the file; None if there is none."""
    file = given.json
    if not isinstance(file, dict):
        return None
    root = file.get("object", file if file.get("type") in (PERSPECTIVE, PARALLEL) else None)
    return root if isinstance(root, dict) and isinstance(root.get("type"), str) else None


def _objects(root: Table) -> Iterator[tuple[str, Table, Floats]]:
    """Yield field, object and world-from-object matrix of everything in the tree, in the file's
    order.
    """
    waiting: list[tuple[str, object, Floats]] = [("object", root, np.eye(4))]
    while waiting:
        field, table, parent = waiting.pop()
        if not isinstance(table, dict):
            raise LucidaError(field, "is no object", "give what .toJSON() returns")
        with errors_within(field), np.errstate(all="ignore"):
            pose = parent @ _matrix(table)
            if not np.abs(pose).max() <= LARGEST:
                problem = "leads beyond what can be drawn, with those above it"
                raise LucidaError("matrix", problem, f"stay within {LARGEST:g}")
            children = table.get("children", [])
            if not isinstance(children, list):
                raise LucidaError("children", "is no list", "give a list of objects")
        yield field, table, pose
        below = [(f"{field}.children[{i}]", child, pose) for i, child in enumerate(children)]
        waiting += reversed(below)


def _matrix(table: Table) -> Floats:
    """Return an object's matrix to its parent, (4, 4)."""
    if "matrix" in table:
        matrix = np.reshape(numbers("matrix", table["matrix"], 16), (4, 4)).T
        if matrix[3].tolist() != [0, 0, 0, 1]:
            problem = f"its last row is {listed(matrix[3])}, not (0, 0, 0, 1)"
            raise LucidaError("matrix", problem, "give it column after column")
        return matrix
    matrix = np.eye(4)
    scale = np.asarray(numbers("scale", table.get("scale", (1, 1, 1)), 3))
    if "quaternion" in table:
        x, y, z, w = numbers("quaternion", table["quaternion"], 4)
        matrix[:3, :3] = rotation_of((w, x, y, z)) * scale
    elif "rotation" in table:
        problem = "are angles without a matrix, which three.js writes beside them"
        raise LucidaError("rotation", problem, "give matrix, or quaternion")
    else:
        matrix[:3, :3] *= scale
    matrix[:3, 3] = numbers("position", table.get("position", (0, 0, 0)), 3)
    return matrix


def _posed(table: Table, pose: Floats, options: Options) -> PosedCamera:
    view = _view(table)
    parallel = table["type"] == PARALLEL
    window = _parallel_window(table, view) if parallel else _window(table, view)
    near, far = (_clip(table, name) for name in ("near", "far"))
    axes, eye = _axes(pose), pose[:3, 3]
    u, v, w = axes.T.tolist()
    if parallel and near is not None and near <= 0:
        # A parallel camera with near <= 0 also sees what is behind it: move the eye back.
        eye = eye - near * axes[:, 2]
        far, near = None if far is None else far - near, None
    camera = Camera(
        tuple(eye.tolist()),
        u,
        v,
        w,
        viewport=window,
        projection="parallel" if parallel else "perspective",
        near=near,
        far=far,
    )
    size = options.size
    if view is not None:
        width, height = view["width"], view["height"]
        if width.is_integer() and height.is_integer() and width * height > 1:
            size = int(width), int(height)
    name = table.get("name", "")
    return PosedCamera(camera, size, name if isinstance(name, str) else "", fit=view is None)


def _axes(pose: Floats) -> Floats:
    """Return the columns u, v, w of a pose, normalised.

    A camera's own scale has no effect in newer versions of three.js. Raises LucidaError if the pose
    is not a rotation: versions differ in how they treat that.
    """
    linear = pose[:3, :3]
    lengths = np.linalg.norm(linear, axis=0)
    if not (lengths > 1e-12).all():
        raise LucidaError("matrix", f"has columns of length {listed(lengths)}", "give a rotation")
    axes = np.asarray(linear / lengths)
    u, v, w = axes.T
    if max(abs(u @ v), abs(v @ w), abs(w @ u)) > ROUNDED:
        problem = f"its columns {listed(u)}, {listed(v)}, {listed(w)} are not at right angles"
        raise LucidaError("matrix", problem, "give a rotation; no parent may stretch it")
    if np.linalg.det(axes) < 0:
        problem = f"its columns {listed(u)}, {listed(v)}, {listed(w)} are left-handed"
        raise LucidaError("matrix", problem, "negate the first, which mirrors the picture")
    return axes


def _window(table: Table, view: dict[str, float] | None) -> Window:
    """Return the viewport at distance 1, following updateProjectionMatrix() step by step."""
    fov, aspect = _positive(table, "fov", 50.0), _positive(table, "aspect", 1.0)
    if not fov < 180:
        raise LucidaError("fov", f"{fov:g} is not below 180", "give degrees, such as 50")
    top = math.tan(math.radians(fov) / 2) / _positive(table, "zoom", 1.0)
    height = 2 * top
    width = aspect * height
    left = -width / 2
    if view is not None:
        left += view["offsetX"] * width / view["fullWidth"]
        top -= view["offsetY"] * height / view["fullHeight"]
        width *= view["width"] / view["fullWidth"]
        height *= view["height"] / view["fullHeight"]
    film = number("filmOffset", table.get("filmOffset", 0.0))
    left += film / (_positive(table, "filmGauge", 35.0) * min(aspect, 1))
    return left, left + width, top - height, top


def _parallel_window(table: Table, view: dict[str, float] | None) -> Window:
    left, right, top, bottom = (
        number(name, table.get(name, default))
        for name, default in (("left", -1), ("right", 1), ("top", 1), ("bottom", -1))
    )
    zoom = _positive(table, "zoom", 1.0)
    width, height = (right - left) / zoom, (top - bottom) / zoom
    left, top = (left + right - width) / 2, (top + bottom + height) / 2
    if view is not None:
        across, down = width / view["fullWidth"], height / view["fullHeight"]
        left += across * view["offsetX"]
        top -= down * view["offsetY"]
        width, height = across * view["width"], down * view["height"]
    return left, left + width, top - height, top


def _view(table: Table) -> dict[str, float] | None:
    """Return the arguments of .setViewOffset(); None if it is not enabled."""
    view = table.get("view")
    if view is None:
        return None
    if not isinstance(view, dict):
        raise LucidaError("view", "is no object", "give what .setViewOffset() made, or null")
    if not view.get("enabled", True):
        return None
    with errors_within("view"):
        parts = {name: _positive(view, name, default) for name, default in _PARTS.items()}
        return parts | {name: number(name, view.get(name, 0.0)) for name in ("offsetX", "offsetY")}


def _clip(table: Table, name: str) -> float | None:
    """Return near or far; JSON has null for an infinite one."""
    value = table.get(name)
    return None if value is None else number(name, value)


def _positive(table: Table, name: str, default: float) -> float:
    return positive(name, table.get(name, default), f"{default:g}")


def _table(camera: Camera, size: Size | None, name: str) -> Table:
    """Return a camera as an object. Its view, off-centre or not, has the size of the image."""
    camera = rigid(camera, "three.js", size)
    left, right, bottom, top = camera.viewport
    table: Table = {
        "type": PARALLEL if camera.is_parallel else PERSPECTIVE,
        "name": name,
        "layers": 1,
        "matrix": pose_of(camera).T.ravel().tolist(),
        "up": [0, 1, 0],
        "zoom": 1,
    }
    table |= {key: getattr(camera, key) for key in ("near", "far") if getattr(camera, key)}
    width, height = size or (1, 1)
    view: Table = {"enabled": True, "fullWidth": width, "fullHeight": height}
    view |= {"offsetX": 0.0, "offsetY": 0.0, "width": width, "height": height}
    if camera.is_parallel:
        table |= {"left": left, "right": right, "top": top, "bottom": bottom}
    else:
        half = (top - bottom) / 2 / camera.distance
        table |= {"fov": math.degrees(2 * math.atan(half)), "focus": 10, "filmGauge": 35}
        table |= {"aspect": (right - left) / (top - bottom), "filmOffset": 0}
        view["offsetX"] = (left + right) / 2 / (right - left) * width
        view["offsetY"] = -(top + bottom) / 2 / (top - bottom) * height
    if size is not None or view["offsetX"] or view["offsetY"]:
        table["view"] = view
    return table | {"uuid": _uuid(table)}


def _uuid(table: Table) -> str:
    """Return a UUID that is the same for the same camera, so that exports are reproducible."""
    return str(uuid5(NAMESPACE_URL, json.dumps(table)))
