"""The extent of a scene, for a camera and for the precision of other programs."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.scene_export.what import LeftOut

FAR = 1e4  # in units of the scene's size: farther from the origin, float32's rounding is visible


def farthest(bounds: NDArray[np.float64], camera: Camera) -> float:
    """Return the distance from the eye to the farthest corner of the bounds (2, 3), in world units;
    0 if all are one point.
    """
    corners = np.array(list(itertools.product(*bounds.T)))
    return float(np.linalg.norm(corners - np.asarray(camera.eye), axis=1).max())


def note_far(bounds: NDArray[np.float64], left: LeftOut) -> None:
    """Note if the scene is too far from the origin for renderers whose world space is float32."""
    away, extent = float(np.abs(bounds).max()), float((bounds[1] - bounds[0]).max())
    if away > FAR * extent > 0:
        step = float(np.spacing(np.float32(away)))
        left.add("place", f"points {away:.3g} units from the origin are {step:.2g} apart there")
