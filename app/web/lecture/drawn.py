"""Prepare for modules/drawn.js the camera of a step and the world's place on the paper."""

from __future__ import annotations

from typing import Any

import numpy as np

from lucida.renderer.camera.camera import Camera

# Unit vectors along u, v and w on paper, x to the right and y down: looking ahead is to the right.
AXES = np.array([[0.42, 0.30], [0.0, -1.0], [-1.0, 0.0]])
BEYOND = 1.6  # the length of drawn rays, relative to the way to the image plane


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
