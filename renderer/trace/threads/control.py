"""The control array of one kernel launch: what has been taken, what is done, whether to stop.

Owns the array's layout as Python sees it (atomic.py: as kernels do). Needs no numba.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NEXT, DONE = 0, 16  # on separate cache lines, or the threads slow one another down
CANCELLED = 1 << 60  # more than any amount of work

Control = NDArray[np.int64]


def new_control() -> Control:
    """Nothing taken, nothing done."""
    return np.zeros(32, np.int64)


def cancel(control: Control) -> None:
    """Leaves no work to be taken; may be called from any thread, at any time."""
    control[NEXT] = CANCELLED
