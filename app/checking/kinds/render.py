"""Both loops: an image of spheres and triangles, in the colour of the nearest object, unshaded.

Answers are arrays (H, W, 3).

The tolerance is half of 1/255, so that bytes divided by 255 are correct. A pixel is not judged if
its ray passes an edge or an outline by less than EDGE of the object's size, or hits two objects
within EDGE of each other. EDGE is a hundred times the float32 error of such a ray (viewing_ray.py,
hits.py).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from lucida.app.checking.cases import generator, rounded, shots
from lucida.app.checking.conventions import Shot, camera_values
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.app.checking.words import described

from .kind import Cases, CheckKind, Flags, Floats, array, named, text_of, wrong_numbers
from .shapes import hits

if TYPE_CHECKING:
    from numpy.random import Generator as Random

HALF_A_BYTE = 0.5 / 255
EDGE = 2e-3


class RenderKind(CheckKind):
    def cases(self, task: CheckTask) -> list[CheckCase]:
        random = generator(task)
        return [_case(task, shot, random) for shot in shots(task)]

    def wanted(self, task: CheckTask, case: CheckCase) -> str:
        return f"numbers {' x '.join(map(str, np.shape(case.right)))}"

    def read(self, task: CheckTask, case: CheckCase, value: Any) -> Floats | None:
        image = array(value)
        return image if image is not None and image.shape == np.shape(case.right) else None

    def wrong(self, task: CheckTask, cases: Cases, given: Any) -> Flags:
        pairs = zip(cases, given, strict=True)
        return np.array([_wrong_pixels(case, image).any() for case, image in pairs], bool)

    def first_wrong(self, task: CheckTask, case: CheckCase, answer: Any) -> tuple[str, str, str]:
        """Return the first wrong pixel: its place, the correct value and the given one."""
        marks = _wrong_pixels(case, answer)
        i, j = (int(part) for part in np.argwhere(marks)[0])
        height, width = marks.shape
        where = f"{int(marks.sum())} of {marks.size} pixels; the first: row {i}, column {j} "
        where += f"(from 0) of the array, {width}x{height} pixels"
        right, given = (text_of(np.asarray(image)[i, j].tolist()) for image in (case.right, answer))
        return where, right, given


RENDER = RenderKind(**described("render"))


def _wrong_pixels(case: CheckCase, image: Floats) -> Flags:
    """Return the wrong pixels of an image, bool (H, W)."""
    return np.asarray(wrong_numbers(case, image).any(axis=2) & case.values["judged"])


def _case(task: CheckTask, shot: Shot, random: Random) -> CheckCase:
    background = [rounded(value) for value in random.uniform(0.0, 0.2, 3)]
    objects = _objects(shot, random, nearest_last=random.random() < 0.5)
    image, judged = rendered(shot, objects, background)
    if task.conventions.rows == "bottom":
        image, judged = image[::-1], judged[::-1]
    scene = {"objects": objects, "background": background}
    values: dict[str, Any] = {"scene": scene, **scene, **camera_values(shot, task.conventions)}
    return CheckCase(
        named(task, values),
        image,
        HALF_A_BYTE,
        {"scene": scene, "judged": judged},
        shot.camera,
        shot.size,
        target=shot.target,
        up=shot.up,
    )


def rendered(
    shot: Shot, objects: Sequence[Mapping[str, Any]], background: Sequence[float]
) -> tuple[Floats, Flags]:
    """Return the image (H, W, 3), and the pixels that can be judged (H, W)."""
    rays = shot.camera.rays(shot.size)
    image = np.broadcast_to(np.array(background, float), (*rays.origin.shape[:2], 3)).copy()
    nearest = np.full(image.shape[:2], np.inf)
    judged = np.ones(image.shape[:2], bool)
    for shape in objects:
        t, margin = hits(rays.origin, rays.direction, shape)
        judged &= margin > EDGE
        with np.errstate(invalid="ignore"):
            judged &= ~(np.isfinite(t) & (np.abs(t - nearest) <= EDGE * t))
        closer = t < nearest
        image[closer] = shape["color"]
        nearest = np.minimum(t, nearest)
    return image, judged


def _objects(shot: Shot, random: Random, nearest_last: bool) -> list[dict[str, Any]]:
    """Return objects in front of the camera that occlude each other, others behind it on the same
    lines, and one more anywhere in the image.
    """
    left, right, bottom, top = shot.camera.viewport
    middle = np.array([left + right, bottom + top]) / 2
    reach = np.array([right - left, top - bottom]) / 2
    at = middle + random.uniform(-0.4, 0.4, 2) * reach
    near, far = (
        _object(shot, random, at, depth, size) for depth, size in ((2.0, 0.25), (5.0, 0.45))
    )
    behind = _object(shot, random, middle, -1.5, 0.4)
    beside = _object(shot, random, middle + random.uniform(-0.8, 0.8, 2) * reach, 3.5, 0.25)
    order = (far, behind, near, beside) if nearest_last else (near, beside, far, behind)
    return list(order)


def _object(shot: Shot, random: Random, at: Floats, depth: float, part: float) -> dict[str, Any]:
    """Return a sphere or a triangle.

    at: its position on the image plane.
    depth: its distance in front of the eye, in units of w.
    part: its size, as a fraction of the image's.
    """
    camera = shot.camera
    left, right, bottom, top = camera.viewport
    across = 1.0 if camera.is_parallel else depth / camera.distance
    unit = camera.basis / np.linalg.norm(camera.basis, axis=0)
    center = np.asarray(camera.eye) + camera.basis @ np.array([*(at * across), -depth])
    seen = abs(across) * min(
        (right - left) * np.linalg.norm(camera.u), (top - bottom) * np.linalg.norm(camera.v)
    )
    size = float(part * random.uniform(0.8, 1.2) * seen)
    color = [rounded(value) for value in random.uniform(0.3, 1.0, 3)]
    if random.random() < 0.6:
        where = [rounded(value, 3) for value in center]
        return {"type": "sphere", "center": where, "radius": rounded(size, 3), "color": color}
    turn = random.uniform(0.0, 2 * np.pi) + 2.1 * np.arange(3)
    around = np.column_stack([np.cos(turn), np.sin(turn), random.uniform(-0.2, 0.2, 3)])
    corners = np.round(center + 1.5 * size * around @ unit.T, 3).tolist()
    return {"type": "triangle", **dict(zip("abc", corners, strict=True)), "color": color}
