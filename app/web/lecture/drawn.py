"""Prepare for modules/drawn.js the camera of a step and the world's place on the paper."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.instruments.outside.extent import end_parameter
from app.instruments.outside.frustum import rectangle
from renderer.camera.camera import Camera

# Unit vectors along u, v and w on paper, x to the right and y down: looking ahead is to the right.
AXES = np.array([[0.42, 0.30], [0.0, -1.0], [-1.0, 0.0]])
BEYOND = 1.6  # of the way to the image plane: how far rays are drawn


def depth_of(camera: Camera, framed: NDArray[np.float64]) -> float:
    """Return how deep the view volume is drawn, in units of w: to far, or the end of the scene."""
    far = camera.t_range[1]
    end = far if np.isfinite(far) else end_parameter(camera, framed)
    return end if camera.is_parallel else end * camera.distance


def volume(camera: Camera, depth: float) -> list[list[float]]:
    """Return the corners of a camera's view volume: four in front, then four behind.

    depth: in units of w, where the camera has no end.
    """
    near_t, far_t = camera.t_range
    if not np.isfinite(far_t):
        far_t = depth if camera.is_parallel else depth / camera.distance
    return [corner.tolist() for t in (near_t, far_t) for corner in rectangle(camera, t)]


def upright_paper(camera: Camera) -> dict[str, Any]:
    """Return paper() with axes at right angles, on which a slanted w is slanted."""
    u, v = (np.asarray(one, float) for one in (camera.u, camera.v))
    right = u / np.linalg.norm(u)
    back = np.cross(u, v)
    back /= np.linalg.norm(back)
    axes = np.array([right, np.cross(back, right), back])
    return paper(camera) | {"onto": (axes.T @ AXES).tolist(), "parallel": True}


def paper(camera: Camera) -> dict[str, Any]:
    """Return the camera as JSON.

    onto: from the world to paper, (3, 2). corners: of the viewport. reach: of a ray.
    """
    basis = np.array([camera.u, camera.v, camera.w], float)
    lengths = np.linalg.norm(basis, axis=1)
    units = basis / lengths[:, None]
    onto = np.linalg.inv(units) @ AXES
    eye = np.asarray(camera.eye, float)
    left, right, bottom, top = camera.viewport
    at = [(left, top), (right, top), (right, bottom), (left, bottom)]
    plane = [eye + x * basis[0] + y * basis[1] - camera.distance * basis[2] for x, y in at]
    return {
        "eye": eye.tolist(),
        "basis": basis.tolist(),
        "onto": onto.tolist(),
        "corners": [corner.tolist() for corner in plane],
        "parallel": camera.is_parallel,
        "reach": BEYOND * float(camera.distance * lengths[2]),
    }
