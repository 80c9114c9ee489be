"""A pasted matrix without a name: the camera of each usual meaning. Pure."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, listed, three
from lucida.renderer.files.cameras import opencv
from lucida.renderer.files.cameras.given import Options
from lucida.renderer.files.cameras.rigid import rigid
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

MOST_CHARACTERS = 4000
ROUNDED = 5e-3  # error of a rotation that was printed with few digits
PARALLEL = 1e-3  # sine of the angle between rows that are parallel
SKEW = 0.05  # relative to fx: the largest skew of a computed K
AXES = {
    "y up, z back (OpenGL)": (1, 1, 1),
    "y down, z forward (OpenCV)": (1, -1, -1),
}
TRANSPOSED = ", transposed (for row vectors)"

# Comments, names, and numbers that belong to no matrix: 4x4, m[16], reshape(4, 4).
_OTHER = re.compile(
    r"#[^\n]*|//[^\n]*|\breshape\([^)]*\)|\b\d+ ?x ?\d+\b|\[\s*\d*\s*\]|\b[A-Za-z_]\w*"
)
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclass(frozen=True)
class Meaning:
    """A meaning of a matrix.

    words: its description, a line for each name; the last line states the camera's place.
    view: that camera's view.
    """

    words: str
    view: View


def matrix_in(text: str) -> Floats | None:
    """Return the 16 or 12 numbers of a text, (4, 4) or (3, 4); None if it holds another count."""
    numbers = _NUMBER.findall(_OTHER.sub(" ", text)) if len(text) <= MOST_CHARACTERS else []
    return np.array(numbers, float).reshape(-1, 4) if len(numbers) in (12, 16) else None


def meanings(matrix: Floats, now: View, center: ArrayLike) -> list[Meaning]:
    """Return the usual meanings of a matrix that make a camera.

    Those whose camera looks at `center`, the scene's middle, come first. now: the current view, for
    values that a matrix leaves open.
    """
    found: dict[tuple[float, ...], tuple[list[str], View]] = {}
    transposed = matrix.reshape(4, -1).T
    for order, rows in (("", matrix), (TRANSPOSED, transposed)):
        for words, make in _ways(rows, now):
            try:
                view = make()
            except (LucidaError, np.linalg.LinAlgError):
                continue
            c = view.camera
            key = np.round([*c.eye, *c.u, *c.v, *c.w, *c.viewport], 6) + 0.0
            found.setdefault(tuple(key.tolist()), ([], view))[0].append(words + order)
    ordered = sorted(found.values(), key=lambda one: -_aim(one[1].camera, np.asarray(center)))
    return [Meaning("\n".join([*words, _place(view.camera)]), view) for words, view in ordered]


def _ways(rows: Floats, now: View) -> Iterator[tuple[str, Callable[[], View]]]:
    """Yield the meanings of a matrix for column vectors."""
    last = rows[3] if len(rows) == 4 else (0, 0, 0, 1)
    if not np.allclose(last, (0, 0, 0, 1), atol=1e-5):
        depth, distance = rows[2:, :3]
        lengths = np.linalg.norm(depth) * np.linalg.norm(distance)
        if np.linalg.norm(np.cross(depth, distance)) <= PARALLEL * lengths:
            yield "projection times view (MVP)", partial(_product, rows, "perspective")
    elif _is_rotation(rows[:3, :3]):
        for axes, signs in AXES.items():
            yield f"camera to world, {axes}", partial(_pose, rows, signs, now, inverse=False)
            yield f"world to camera, {axes}", partial(_pose, rows, signs, now, inverse=True)
    elif len(rows) == 4:
        yield "parallel projection times view (MVP)", partial(_product, rows, "parallel")
    else:
        yield "P = K [R | t], in pixels", partial(_pixels, rows)


def _is_rotation(linear: Floats) -> bool:
    """Return True for a rotation, up to rounding and a scale."""
    scale = np.cbrt(np.linalg.det(linear))
    return bool(scale > 0 and np.abs(linear @ linear.T / scale**2 - np.eye(3)).max() < ROUNDED)


def _pose(rows: Floats, axes: tuple[int, ...], now: View, inverse: bool) -> View:
    pose = np.vstack([rows[:3], (0, 0, 0, 1)])
    pose = np.linalg.inv(pose) if inverse else pose
    linear = pose[:3, :3] / np.cbrt(np.linalg.det(pose[:3, :3])) * axes
    u, v, w = linear.T.tolist()
    return replace(now, camera=replace(now.camera, eye=pose[:3, 3].tolist(), u=u, v=v, w=w))


def _product(rows: Floats, projection: str) -> View:
    """Read clip_from_world: the corners of clip space are those of the viewport."""
    if projection == "parallel":
        u, v, along, middle = np.linalg.inv(rows)[:3].T
        eye, w = middle - along, -along
    else:
        seen = rows[[0, 1, 3]]
        u, v, ahead = (basis := np.linalg.inv(seen[:, :3])).T
        eye, w = -basis @ seen[:, 3], -ahead
    v = v * np.sign(np.linalg.det([u, v, w]))  # left-handed: y points down (Vulkan)
    viewport = (-1, 1, -1, 1)
    camera = Camera(three(eye), three(u), three(v), three(w), 1.0, viewport, projection)
    return View(rigid(camera, "a camera"), fit=True)


def _pixels(rows: Floats) -> View:
    """Read P. Its image is the one whose middle is the principal point."""
    posed = opencv.read_table({"P": rows}, Options(), "center").cameras[0]
    assert posed.size is not None
    K = posed.camera.intrinsics(posed.size).K
    if abs(K[0, 1]) > SKEW * K[0, 0]:
        raise LucidaError("P", "is skewed")
    return View(posed.camera, fit=True)


def _aim(camera: Camera, center: Floats) -> float:
    """Return the cosine of the angle between the view direction and the direction to `center`."""
    way, w = center - camera.eye, np.asarray(camera.w)
    return float(-w @ way / max(float(np.linalg.norm(way) * np.linalg.norm(w)), 1e-12))


def _place(camera: Camera) -> str:
    ahead = -np.asarray(camera.w) / np.linalg.norm(camera.w)
    eye, ahead = (np.round(one, 3) + 0.0 for one in (camera.eye, ahead))  # 0.0, not -0.0
    return f"eye {listed(eye)}, looks along {listed(ahead)}"
