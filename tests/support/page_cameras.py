"""Random cameras to compare a page with the program: skewed, off-axis, parallel, with a lens."""

from __future__ import annotations

import numpy as np

from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.lenses import Lens

LENSES = (
    Lens("brown", {"k1": -0.12, "k2": 0.03}),
    Lens("brown", {"k1": 0.08, "p1": 0.01, "p2": -0.02, "s1": 0.01, "k4": 0.05}),
    Lens("fisheye", {"k1": 0.03, "k2": -0.004}),
    Lens("thin_prism_fisheye", {"k1": 0.02, "p1": 0.003, "sx1": 0.004}),
    Lens("fov", {"omega": 0.9}),
    Lens("equidistant"),
    Lens("stereographic"),
    Lens("equisolid"),
    Lens("orthographic"),
    Lens("equirectangular"),
    Lens("cylindrical"),
)


def random_cameras(seed: int, count: int) -> list[Camera]:
    """Return cameras that look towards the origin from a few units away."""
    generator = np.random.default_rng(seed)
    cameras: list[Camera] = []
    while len(cameras) < count:
        number = len(cameras)
        eye = generator.normal(size=3)
        eye *= generator.uniform(3.0, 9.0) / np.linalg.norm(eye)
        target = generator.normal(size=3) * 0.5
        try:
            camera = Camera.look_at(eye.tolist(), target.tolist(), distance=1.5, aspect=1.3)
            basis = camera.basis + (number % 3 == 1) * generator.normal(size=(3, 3)) * 0.15
            center = generator.normal(size=2) * 0.2 * (number % 3 == 2)
            half = generator.uniform(0.3, 1.2, 2)
            cameras.append(
                Camera(
                    camera.eye,
                    *(tuple(vector) for vector in basis.T.tolist()),
                    distance=float(generator.uniform(0.5, 2.0)),
                    viewport=tuple(
                        float(value)
                        for k in range(2)
                        for value in (center[k] - half[k], center[k] + half[k])
                    ),
                    projection="parallel" if number % 5 == 1 else "perspective",
                    lens=LENSES[number % len(LENSES)] if number % 5 == 2 else None,
                )
            )
        except LucidaError:
            continue
    return cameras
