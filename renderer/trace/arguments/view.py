"""The camera for a kernel, as plain numbers. renderer/camera/camera.py has the formulas."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size


class KernelView(NamedTuple):
    """A camera's numbers, all float64, so that a kernel's rays equal those of Camera.ray to the
    last bit.

    back: distance * w in perspective, w in parallel projection. t_min, t_max: near and far as
    ray parameters. directions: of all pixels' rays, (height, width, 3), NaN outside the lens; empty
    without a lens, and for packets.
    """

    eye: Vector
    u: Vector
    v: Vector
    back: Vector
    left: float
    right: float
    bottom: float
    top: float
    parallel: bool
    t_min: float
    t_max: float
    directions: NDArray[np.float64]

    @classmethod
    def of(cls, camera: Camera, size: Size | None = None) -> KernelView:
        """Return the numbers of a camera, with the directions if it has a lens and a size is
        given.
        """
        scale = 1.0 if camera.is_parallel else camera.distance
        x, y, z = camera.w
        t_min, t_max = camera.t_range
        return cls(
            camera.eye,
            camera.u,
            camera.v,
            (scale * x, scale * y, scale * z),
            *camera.viewport,
            camera.is_parallel,
            t_min,
            t_max,
            np.empty((0, 0, 3)) if size is None or camera.lens is None else camera.rays(size)[1],
        )
