"""How far a program's pixels may be off that computes in float32, as Blender and Mitsuba do.

First-order bounds in the classic manner: every operation and every stored number rounds by at most
UNIT of its value, so that a chain of n of them is off by at most n UNIT of the values that it adds
up, where nothing cancels. What cancels is in the bounds: a point and an eye that are far away and
close together, a viewport beside the axis.
Source: Higham, "Accuracy and Stability of Numerical Algorithms", 3.1.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats.rigid import rigid

UNIT = 2.0**-24  # of a float32: half of what lies between 1 and the next number

# Roundings on the longest way from what is stored to a pixel, by the step.
Roundings = Mapping[str, int]


def point_bounds(camera: Camera, size: Size, points: Floats, roundings: Roundings) -> Floats:
    """Of each point's pixel, in x and y; (n, 2). camera: one that `rigid` holds."""
    straight = rigid(camera, "the bound")
    offset = points - np.asarray(straight.eye)
    x, y, back = (offset @ straight.basis).T
    # What is added up to a coordinate in the camera's space.
    stored = np.linalg.norm(points, axis=1) + np.linalg.norm(straight.eye)
    left, right, bottom, top = straight.viewport
    edges = np.array([abs(left) + abs(right), abs(bottom) + abs(top)])
    across = np.abs(np.stack([x, y], axis=-1))
    moved = np.repeat(stored[:, None], 2, axis=1)
    if not straight.is_parallel:
        scale = straight.distance / -back[:, None]
        across = across * scale
        moved = moved * scale * (1 + across / straight.distance)
    pixels = np.array(size) / (right - left, top - bottom)
    return sum(roundings.values()) * UNIT * pixels * (moved + across + edges)
