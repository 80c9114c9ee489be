"""Random cameras to compare a page with the program: skewed, off-axis, parallel, with a lens; and
how much their rays differ.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.views import view_table
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError
from tests.support.browser import Page

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


def random_cameras(
    seed: int, count: int, around: Vector = (0.0, 0.0, 0.0), unit: float = 1.0
) -> list[Camera]:
    """Return cameras that look towards a point from a few units away."""
    generator = np.random.default_rng(seed)
    cameras = []
    while len(cameras) < count:
        number = len(cameras)
        eye = generator.normal(size=3)
        eye = around + eye * (unit * generator.uniform(3.0, 9.0) / np.linalg.norm(eye))
        target = around + generator.normal(size=3) * (0.5 * unit)
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


def ray_error(page: Page, cameras: list[Camera]) -> float:
    """Return the largest difference between a page's rays of some pixels and the program's."""
    size, pixels = [61, 47], [[0, 0], [3, 17], [30, 8], [46, 60]]
    script = """([cameras, pixels, size]) => cameras.map((camera) => {
      lucida.set(camera);
      return pixels.map(([i, j]) => lucida.ray(i, j, size))
        .map(({origin, direction}) => [origin, direction].map((part) => part.map(String)));
    })"""
    tables = [view_table(View(camera)) for camera in cameras]
    told = np.array(page.tab.evaluate(script, [tables, pixels, size]), float)
    rays = [camera.ray(*np.array(pixels).T, tuple(size)) for camera in cameras]
    right = np.array([(ray.origin, ray.direction) for ray in rays]).swapaxes(1, 2)
    assert (np.isnan(told) == np.isnan(right)).all()
    return float(np.nanmax(np.abs(told - right)))
