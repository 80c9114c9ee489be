"""A check whether float32 separates the borders of checker cells from the errors of packets' hits.

view.py calls it. refine.py then computes the hits in float64.

A pattern is scaled with its object, so the cells on a plate a thousand times as wide as thick are
just as thin. A hit with an error of a few units in float32's last place is then in another cell,
although the error is invisible in the image.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.images.shared_numbers import CELL_NUDGE, CHECKERED
from lucida.renderer.scene.boxes import world_boxes
from lucida.renderer.scene.flat import SPECULAR_CHECKERED, FlatScene

# A face on a cell's border is looked up CELL_NUDGE below it, so hits must be more accurate.
_KNOWN = CELL_NUDGE / 2


class Cells(NamedTuple):
    """The checkered objects: middle and half extent of their boxes in the world, (n, 3) each, and
    the most cells in a unit of length, (n,). float64."""

    middle: NDArray[np.float64]
    half: NDArray[np.float64]
    steepest: NDArray[np.float64]


_NOTHING = Cells(np.empty((0, 3)), np.empty((0, 3)), np.empty(0))


def cells_of(flat: FlatScene) -> Cells:
    """Return the objects of a scene whose material has a checker."""
    which = flat.materials[:, SPECULAR_CHECKERED, 3] == CHECKERED
    if not which.any():
        return _NOTHING
    low, high = world_boxes(flat.world_from_object[which], flat.object_bounds[which])
    steepest = np.linalg.norm(flat.cells[which, :, :3], axis=2).max(axis=1, initial=0)
    return Cells((low + high) / 2, (high - low) / 2, steepest)


def are_blurred(
    cells: Cells,
    eye: NDArray[np.float64],
    to_t: NDArray[np.float64],
    back: NDArray[np.float64] | None,
    rounding: float,
) -> bool:
    """Return True if any object's cells are too thin for hits with an error of `rounding` in t.

    The rounding is relative to the object's largest t. to_t: maps a point relative to the eye to t.
    back: the step of one t in parallel projection; None in perspective, where it is the ray's
    direction.
    """
    if not len(cells.steepest):
        return False
    from_eye = cells.middle - eye
    if back is None:
        reach = np.linalg.norm(from_eye, axis=1) + np.linalg.norm(cells.half, axis=1)
    else:
        reach = np.abs(from_eye @ to_t) + cells.half @ np.abs(to_t)
        reach *= np.linalg.norm(back)
    return bool((rounding * reach * cells.steepest > _KNOWN).any())
