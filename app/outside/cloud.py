"""Points and lines by the thousand in the outside view, as another instrument gives them.

Pure; how they are drawn, and how many of them in a frame, is cloud_layer.py's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Segments

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Cloud:
    """lines: in the world; of one colour. points: float32 (n, 3), world units from `origin` (3,),
    in no order: the first of them stand for all. colors: theirs, uint8 (n, 3), sRGB. around: a few
    points (k, 3) round what is to be seen of it, in the world."""

    lines: Segments
    origin: Floats
    points: NDArray[np.float32]
    colors: NDArray[np.uint8]
    around: Floats

    @property
    def middle(self) -> Floats:
        """Of a box round it, (3,)."""
        return (self.around.min(axis=0) + self.around.max(axis=0)) / 2

    @property
    def reach(self) -> float:
        """From the middle to the box's corner, world units."""
        return float(np.linalg.norm(np.ptp(self.around, axis=0))) / 2 or 1e-9
