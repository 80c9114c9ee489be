"""Clouds that another instrument adds to the outside view: points and lines by the thousand.

Pure. cloud_layer.py draws them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import Floats

from .diagram import Segments


@dataclass(frozen=True, eq=False)
class Cloud:
    """A cloud of points and lines.

    lines: segments in world space, all of one colour. points: float32 (n, 3), world units from
    `origin` (3,), in random order, so that the first ones represent all. colors: the points'
    colours, uint8 (n, 3), sRGB. around: a few points (k, 3) around the visible part, world space.
    """

    lines: Segments
    origin: Floats
    points: NDArray[np.float32]
    colors: NDArray[np.uint8]
    around: Floats

    @property
    def middle(self) -> Floats:
        """Return the centre of a box around the cloud, (3,)."""
        return (self.around.min(axis=0) + self.around.max(axis=0)) / 2

    @property
    def reach(self) -> float:
        """Return the distance from the middle to the box's corner, world units."""
        return float(np.linalg.norm(np.ptp(self.around, axis=0))) / 2 or 1e-9
