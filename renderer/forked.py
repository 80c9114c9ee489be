"""Processes that were forked from one in which threads or drivers are at work.

A fork has copies of all data, and of no thread but one: what others had in hand stays locked for
ever. Nothing mends that, so it is told.
"""

from __future__ import annotations

import os

from renderer.errors import LucidaError

REMEDY = "start processes by spawn: multiprocessing.get_context('spawn')"


def check_not_forked(owner_pid: int, field: str, what: str) -> None:
    """Raises LucidaError in a process forked from `owner_pid`. what: e.g. "was made"."""
    if os.getpid() != owner_pid:
        problem = f"{what} before this process was forked, and its threads stayed behind"
        raise LucidaError(field, problem, REMEDY)
