"""The questions to students' code, and the processes that it left."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import psutil

from app.checking.calls import Call

CAMERA = {
    "eye": [0.0, 0.0, 5.0],
    "u": [1.0, 0.0, 0.0],
    "v": [0.0, 1.0, 0.0],
    "w": [0.0, 0.0, 1.0],
    "distance": 1.0,
    "left": -1.0,
    "right": 1.0,
    "bottom": -0.75,
    "top": 0.75,
    "projection": "perspective",
}


def called(function: str, vectorised: bool = False, /, **arguments) -> Call:
    return Call(function, tuple(arguments.items()), vectorised)


@contextmanager
def adopting() -> Iterator[Callable[[], list[psutil.Process]]]:
    """Adopt orphans, on Linux. Yield what returns the processes that live, and have been started
    since."""
    before = psutil.Process().children(recursive=True)
    _adopt(True)
    yield lambda: [
        one
        for one in psutil.Process().children(recursive=True)
        if one not in before and one.status() != psutil.STATUS_ZOMBIE
    ]
    _adopt(False)


def _adopt(orphans: bool) -> None:
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(36, int(orphans), 0, 0, 0)  # PR_SET_CHILD_SUBREAPER
