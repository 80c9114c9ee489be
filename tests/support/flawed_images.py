"""Images with known flaws, and what a comparison finds in them."""

from dataclasses import replace

import numpy as np

from lucida import Camera, Frame
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, SceneObject

SIZE = (32, 24)
CAMERA = Camera(viewport=(-0.5, 0.5, -0.375, 0.375))  # one pixel is 1/32 of a unit at t = 1


def wall(z, left=-10.0, right=10.0, tilt=0.0, **material):
    """A rectangle across the view at depth -z; tilt adds to its depth per unit of x."""
    corners = [(x, y, z + tilt * x) for x, y in ((left, -9), (right, -9), (right, 9), (left, 9))]
    return SceneObject(Mesh(corners, [[0, 1, 2], [0, 2, 3]]), Material(**material))


def image(t, object_id, primitive, size=SIZE):
    """A frame of one flat colour where everything is hit at t."""
    shape = size[::-1]
    return Frame(
        size=size,
        color=np.full((*shape, 3), 0.5, np.float32),
        depth=np.broadcast_to(np.float32(t), shape).copy(),
        normal=np.broadcast_to(np.float32([0, 0, 1]), (*shape, 3)).copy(),
        id=np.full(shape, object_id, np.int32),
        primitive=np.full(shape, primitive, np.int32),
    )


def changed(frame, where, **values):
    """A copy of the frame with other values at pixels `where`."""
    arrays = {}
    for name, value in values.items():
        arrays[name] = frame.channel(name).copy()
        arrays[name][where] = value
    return replace(frame, **arrays)


def counts(comparison):
    return {name: n for name, n in comparison.explained.items() if n} | (
        {"unexplained": comparison.unexplained} if comparison.unexplained else {}
    )
