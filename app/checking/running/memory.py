"""The processes below a process: their memory, and how to end them."""

from __future__ import annotations

import contextlib
import sys

import psutil

_EXACT_FROM = 1 << 28  # bytes; below, shared memory may be counted twice


def memory_of(process: int) -> int:
    """Return the number of bytes held by all processes below a supervisor; 0 if there are none."""
    held = 0
    tree = _below(process)
    if sys.platform == "win32":  # there is no supervisor
        tree.append(psutil.Process(process))
    for one in tree:
        with contextlib.suppress(psutil.Error):
            held += one.memory_info().rss
    if len(tree) == 1 or held < _EXACT_FROM:
        return held
    held = 0
    for one in tree:  # slower, but forks share most of their memory
        with contextlib.suppress(psutil.NoSuchProcess):
            try:
                held += one.memory_full_info().pss
            except (psutil.AccessDenied, AttributeError):  # only available on Linux
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
