"""Picking: the camera of a set under the mouse in the outside view. Pure."""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.outside.screen import OutsideScreen

from .model import PoseSet

REACH_PX = 12.0  # from a point of a frustum's edges, in units of symbols
PLACES = np.linspace(0.0, 1.0, 9)[:, None]  # of the points along an edge


def picked(
    poses: PoseSet, size: float, screen: OutsideScreen, place: tuple[float, float]
) -> int | None:
    """Return the number of the camera that has an edge at this place of the screen, in pixels from
    the upper left corner; the one in front if there are several. size: of the frusta, world units.
    """
    edges = size * poses.ways[:, :: poses.parts, None] * PLACES
    spots = screen.homogeneous(poses.origins[:, :: poses.parts, None] + edges)
    with np.errstate(all="ignore"):
        places, _ = screen.on_screen(spots)
        away = np.linalg.norm(places - place, axis=-1)
    t = spots[..., 2]
    near = (away <= REACH_PX * screen.symbol_px) & (t > screen.near)
    front = np.where(near, t, np.inf).min(axis=(1, 2))
    return int(front.argmin()) if near.any() else None
