"""The built-in tasks, along the lecture's parts."""

from __future__ import annotations

from app.checking.conventions import Conventions
from app.checking.kinds import KINDS
from app.checking.tasks import CheckTask


def _conventions(kind: str) -> Conventions:
    return Conventions(
        arguments=tuple((word, word) for word in KINDS[kind].arguments),
        returns=KINDS[kind].returns,
    )


BUILTIN = (
    CheckTask(
        "viewing-ray",
        "viewing-ray",
        "viewing_ray",
        "Any camera",
        "The viewing ray of pixel (i, j) in perspective: its origin and its direction, of any "
        "length. i, j count from 0, row 0 is at the top, the ray goes through the pixel's centre.",
        3.0,
        _conventions("viewing-ray"),
    ),
    CheckTask(
        "viewing-ray-parallel",
        "viewing-ray",
        "viewing_ray",
        "Parallel: the pixel moves the origin",
        "The same in parallel projection (camera.projection is 'parallel'): the pixel moves the "
        "origin, all directions are -w.",
        2.0,
        _conventions("viewing-ray"),
        projections=("parallel",),
    ),
)
