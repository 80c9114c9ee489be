"""Picking: the camera of a set under the mouse in the outside view. Pure."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.instruments.poses.model import PoseSet, frusta

REACH_PX = 7.0  # from a line, in units of symbols
AS_NEAR_PX = 1.5  # of two frusta whose lines are as near, the one in front


def picked(
    poses: PoseSet, size: float, screen: OutsideScreen, place: tuple[float, float]
) -> int | None:
    """Return the number of the camera with a line at this place of the screen, in pixels from the
    upper left corner. size: of the frusta, world units.
    """
    reach = REACH_PX * screen.symbol_px
    near = _around(poses, size, screen, place, reach)
    if not len(near):
        return None
    points, depth, which = screen.segments(frusta(poses, size, near))
    if not len(points):
        return None
    start, along = points[:, 0], points[:, 1] - points[:, 0]
    length2 = np.maximum((along**2).sum(axis=1), 1e-12)
    part = np.clip(((np.asarray(place) - start) * along).sum(axis=1) / length2, 0.0, 1.0)
    away = np.linalg.norm(start + part[:, None] * along - place, axis=1)
    if away.min() > reach:
        return None
    s = depth[:, 0] + part * (depth[:, 1] - depth[:, 0])
    front = s if screen.camera.is_parallel else -s  # the smaller, the nearer to the eye
    close = np.flatnonzero(away <= away.min() + AS_NEAR_PX * screen.symbol_px)
    return int(near[which[close[np.argmin(front[close])]] // poses.lines])


def _around(
    poses: PoseSet, size: float, screen: OutsideScreen, place: tuple[float, float], reach: float
) -> NDArray[np.int64]:
    """Return the numbers of the cameras whose box on the screen contains the place, and of those
    that reach behind the viewer's eye, which have no box.
    """
    corners = np.concatenate([poses.origins, poses.origins + 1.5 * size * poses.ways], axis=1)
    spots = screen.homogeneous(corners)
    ahead = (spots[..., 2] > screen.near).all(axis=1)
    with np.errstate(all="ignore"):
        at, _ = screen.on_screen(spots)
    low, high = at.min(axis=1) - reach, at.max(axis=1) + reach
    inside = ((low <= place) & (high >= place)).all(axis=1)
    partly = (spots[..., 2] > screen.near).any(axis=1) & ~ahead
    return np.flatnonzero((ahead & inside) | partly)
