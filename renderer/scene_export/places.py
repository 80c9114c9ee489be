"""Where a scene lies for a camera, and which of its places a target can hold."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera


def farthest(bounds: NDArray[np.float64], camera: Camera) -> float:
    """How far the farthest corner of the bounds (2, 3) lies from the eye, in world units; 0 where
    both are one point."""
    corners = np.array(list(itertools.product(*bounds.T)))
    return float(np.linalg.norm(corners - np.asarray(camera.eye), axis=1).max())
