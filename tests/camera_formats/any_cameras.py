"""Random cameras, and whether two see the same."""

from __future__ import annotations

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_formats import CameraSet, PosedCamera, read_cameras
from renderer.camera_formats.given import Given, Options


def any_camera(
    random: np.random.Generator, skewed: bool = False, projection: str = "perspective"
) -> tuple[Camera, Size]:
    """An off-axis camera, and an image of any aspect ratio. skewed: any basis, of either hand."""
    while True:
        basis = random.normal(size=(3, 3))
        if np.linalg.cond(basis) < 50:
            break
    if not skewed:
        basis, _ = np.linalg.qr(basis)
        basis[0] *= np.linalg.det(basis)
    left, bottom = -random.uniform(0.1, 1, 2)
    right, top = random.uniform(0.1, 1, 2)
    camera = Camera(
        (5 * random.normal(size=3)).tolist(),
        *basis.tolist(),
        random.uniform(0.2, 4),
        (left, right, bottom, top),
        projection,
    )
    width, height = random.integers(2, 2000, 2).tolist()
    return camera, (width, height)


def assert_same_pixels(one: Camera, other: Camera, size: Size, most_px: float = 1e-6) -> None:
    """What one camera sees at a pixel, the other sees there, too."""
    rows, columns = np.meshgrid([0.0, size[1] - 1.0], [0.0, size[0] - 1.0])
    ray = one.ray(rows, columns, size)
    for parameter in (0.7, 4.0):
        seen = other.project(ray.origin + parameter * ray.direction, size)
        np.testing.assert_allclose(seen.row, rows, rtol=0, atol=most_px)
        np.testing.assert_allclose(seen.column, columns, rtol=0, atol=most_px)


def pasted(text: str, format: str = "", options: Options | None = None) -> CameraSet:
    return read_cameras(Given("", text.encode()), format, options)


def posed(camera: Camera, size: Size | None, name: str = "") -> PosedCamera:
    return PosedCamera(camera, size, name)
