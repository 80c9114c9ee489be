"""A check for processes that were forked from one with running threads or drivers.

A fork copies all data, but only one thread: locks held by other threads stay locked forever. There
is no cure, so it is reported as an error.
"""

from __future__ import annotations

import os

from renderer.errors import LucidaError

REMEDY = "start processes by spawn: multiprocessing.get_context('spawn')"


def check_not_forked(owner_pid: int, field: str, what: str) -> None:
    """Raise LucidaError in a process forked from `owner_pid`. what: e.g. "was made"."""
    if os.getpid() != owner_pid:
        problem = f"{what} before this process was forked, and its threads stayed behind"
        raise LucidaError(field, problem, REMEDY)
