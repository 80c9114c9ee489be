"""The camera for a kernel: plain numbers. The formulas are in renderer/camera.py."""

from __future__ import annotations

from typing import NamedTuple

from renderer.camera import Camera, Vector


class KernelView(NamedTuple):
    """A camera's numbers, all float64, so that a kernel's rays equal those of Camera.ray to the
    last bit.

    back: distance * w in perspective, w in parallel projection. t_min, t_max: near and far as
    ray parameters.
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

    @classmethod
    def of(cls, camera: Camera) -> KernelView:
        """Return the numbers of a camera."""
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
        )
