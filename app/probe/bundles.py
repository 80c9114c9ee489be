"""Viewing rays of a row or a column of pixels, and their hits, to be drawn in space."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from app.probe.model import Probe, winner_of
from renderer.camera import Camera, Floats, Size

MOST_SHOWN = 48


class Bundle(NamedTuple):
    """Viewing rays of several pixels: origins (n, 3), directions (n, 3), and the ray parameter of
    each closest hit (n,), inf if nothing is hit.
    """

    origins: Floats
    directions: Floats
    t: Floats


def bundle(probe: Probe, which: str, place: int, camera: Camera, size: Size) -> Bundle:
    """Return MOST_SHOWN rays at most, evenly spaced, of a row or a column.

    which: "row" or "column". place: its number.
    """
    count = size[0] if which == "row" else size[1]
    few = np.unique(np.linspace(0, count - 1, MOST_SHOWN).astype(int))
    ray = camera.ray(place, few, size) if which == "row" else camera.ray(few, place, size)
    origins, directions = (np.array(part) for part in ray)
    t = np.full(len(few), np.inf)
    for number in range(len(few)):
        found = probe.index.crossings(origins[number], directions[number])
        if (first := winner_of(found, camera.t_range)) >= 0:
            t[number] = found.t[first]
    return Bundle(origins, directions, t)
