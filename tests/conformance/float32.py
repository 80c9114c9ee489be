"""The error of pixels that a program computes in float32, as Blender and Mitsuba do.

First-order bounds in the classic manner: every operation and every stored number rounds by at most
UNIT of its value, so that a chain of n of them is off by at most n UNIT of the values that it adds
up, where nothing cancels. What cancels is in the bounds: a point and an eye that are far away and
close together, a viewport far from the axis.
Source: Higham, "Accuracy and Stability of Numerical Algorithms", 3.1.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats.rigid import rigid

UNIT = 2.0**-24  # of a float32: half of what lies between 1 and the next number

Roundings = Mapping[str, int]  # on the longest way, by the step


def point_bounds(
    camera: Camera, size: Size, points: Floats, in_space: Roundings, in_picture: Roundings
) -> Floats:
    """Return the bound for each point's pixel, in x and y; (n, 2).

    in_space: what is done to the point, the eye and the axes. in_picture: what is done in the plane
    of the picture, to its edges among others. In perspective the camera is one that `rigid` holds.
    """
    camera = camera if camera.is_parallel else rigid(camera, "the bound")
    left, right, bottom, top = camera.viewport
    edges = np.array([abs(left) + abs(right), abs(bottom) + abs(top)])
    inverse = np.linalg.inv(camera.basis)
    x, y, z = inverse @ (points - np.asarray(camera.eye)).T
    across = np.abs(np.column_stack([x, y]))
    # What is added up to a place in the camera's space; a change of it by 1 changes x, y, z by so
    # much at most.
    stored = np.linalg.norm(points, axis=1) + np.linalg.norm(camera.eye)
    change_x, change_y, change_z = np.linalg.norm(inverse, axis=1)
    moved = stored[:, None] * (change_x, change_y)
    if camera.is_parallel:  # formats move the eye into the viewport's middle
        lengths = np.linalg.norm([camera.u, camera.v], axis=1)
        moved += (edges @ lengths) * np.array([change_x, change_y])
    else:
        ahead = -z[:, None] / camera.distance
        across = across / ahead
        moved = (moved + across * stored[:, None] * change_z / camera.distance) / ahead
    pixels = np.array(size) / (right - left, top - bottom)
    space, picture = (sum(roundings.values()) for roundings in (in_space, in_picture))
    return UNIT * pixels * (space * moved + picture * (across + edges))
