"""Points and lines by the thousand in the outside view, as another instrument gives them.

Pure; how they are drawn, and how many of them in a frame, is cloud_layer.py's.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import Segments

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Cloud:
    """lines: in the world; of one colour. points: float32 (n, 3), world units from `origin` (3,),
    in no order: the first of them stand for all. colors: theirs, uint8 (n, 3), sRGB. around:
    corners (8, 3) of what is to be seen of it, in the world."""

    lines: Segments
    origin: Floats
    points: NDArray[np.float32]
    colors: NDArray[np.uint8]
    around: Floats

    @property
    def reach(self) -> float:
        """From the middle to a corner, world units."""
        return float(np.linalg.norm(self.around[-1] - self.around[0])) / 2 or 1e-9


def box_corners(low: Floats, high: Floats) -> Floats:
    """(8, 3), the lowest first, the highest last."""
    return np.array([*product(*zip(low.tolist(), high.tolist(), strict=True))], float)
