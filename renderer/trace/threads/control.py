"""The control array of one kernel launch: pieces of work taken and done, and a request to stop.

This is its layout for Python (atomic.py: for kernels). Needs no numba.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NEXT, DONE = 0, 16  # on separate cache lines, to avoid false sharing
CANCELLED = 1 << 60  # more than any amount of work

Control = NDArray[np.int64]


def new_control() -> Control:
    """Return a control array with nothing taken and nothing done."""
    return np.zeros(32, np.int64)


def cancel(control: Control) -> None:
    """Leave no work to be taken. May be called from any thread, at any time."""
    control[NEXT] = CANCELLED
