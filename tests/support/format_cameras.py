"""Random cameras for the formats that others use, and what tells whether two see the same."""

from __future__ import annotations

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_formats import CameraSet, PosedCamera, read_cameras
from renderer.camera_formats.given import Given


def straight_camera(random: np.random.Generator, projection: str = "perspective") -> Camera:
    """Any camera with axes at right angles, of any lengths; in perspective, w leans: off-axis."""
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    axes[:, 0] *= np.linalg.det(axes)
    u, v, w = (axes * random.uniform(0.3, 3, 3)).T
    if projection == "perspective":
        w = w + random.uniform(-0.5, 0.5) * u + random.uniform(-0.5, 0.5) * v
    x, y = random.uniform(-1, 1, 2)
    half_x, half_y = random.uniform(0.1, 1, 2)
    viewport = (x - half_x, x + half_x, y - half_y, y + half_y)
    eye = 5 * random.normal(size=3)
    return Camera(eye, u, v, w, random.uniform(0.3, 4), viewport, projection)


def any_size(random: np.random.Generator) -> Size:
    width, height = random.integers(100, 2000, 2).tolist()
    return width, height


def farthest_px(one: Camera, other: Camera, size: Size, random: np.random.Generator) -> float:
    """How far apart two cameras see the same points of an image, in pixels."""
    row, column = random.uniform(0, 1, (2, 20)) * np.array(size[::-1])[:, None]
    ray = one.ray(row, column, size)
    points = ray.origin + random.uniform(0.5, 5, (20, 1)) * ray.direction
    seen = other.project(points, size)
    return float(np.max(np.hypot(seen.row - row, seen.column - column)))


def pasted(text: str | bytes, format: str = "") -> CameraSet:
    return read_cameras(Given("pasted", text if isinstance(text, bytes) else text.encode()), format)


SKEWED = PosedCamera(Camera(v=(0.5, 1.0, 0.0)), (640, 480), "skewed")
MIRRORED = PosedCamera(Camera(u=(-1.0, 0.0, 0.0)), (640, 480), "mirrored")
ASKANCE = PosedCamera(Camera(w=(0.2, 0.0, 1.0), projection="parallel"), (640, 480), "askance")
