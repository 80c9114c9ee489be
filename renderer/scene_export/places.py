"""Where a scene lies, for a camera and for other programs' numbers."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.scene_export.what import LeftOut

FAR = 1e4  # times the scene's size: farther from the world's origin, float32 is to be seen


def farthest(bounds: NDArray[np.float64], camera: Camera) -> float:
    """How far the farthest corner of the bounds (2, 3) lies from the eye, in world units; 0 where
    both are one point."""
    corners = np.array(list(itertools.product(*bounds.T)))
    return float(np.linalg.norm(corners - np.asarray(camera.eye), axis=1).max())


def note_far(bounds: NDArray[np.float64], left: LeftOut) -> None:
    """For renderers whose world is float32."""
    away, extent = float(np.abs(bounds).max()), float((bounds[1] - bounds[0]).max())
    if away > FAR * extent > 0:
        step = float(np.spacing(np.float32(away)))
        left.add("place", f"points {away:.3g} units from the origin are {step:.2g} apart there")
