"""The processes below a process: how much memory they hold, and how they end."""

from __future__ import annotations

import contextlib
import sys

import psutil

_EXACT_FROM = 1 << 28  # bytes: below that, what processes share may count twice


def memory_of(process: int) -> int:
    """Return the bytes that all processes below a supervisor hold; 0 if there are none."""
    held = 0
    tree = _below(process)
    if sys.platform == "win32":  # which has no supervisor
        tree.append(psutil.Process(process))
    for one in tree:
        with contextlib.suppress(psutil.Error):
            held += one.memory_info().rss
    if len(tree) == 1 or held < _EXACT_FROM:
        return held
    held = 0
    for one in tree:  # takes longer: copies share most of what they hold
        with contextlib.suppress(psutil.NoSuchProcess):
            try:
                held += one.memory_full_info().pss
            except (psutil.AccessDenied, AttributeError):  # only Linux tells
                held += one.memory_info().rss
    return held


def kill_tree(process: int) -> None:
    """Kill a process and all processes below it."""
    with contextlib.suppress(psutil.Error):
        tree = [*_below(process), psutil.Process(process)]
        for one in tree:
            with contextlib.suppress(psutil.Error):
                one.kill()


def _below(process: int) -> list[psutil.Process]:
    try:
        return psutil.Process(process).children(recursive=True)
    except psutil.Error:
        return []
