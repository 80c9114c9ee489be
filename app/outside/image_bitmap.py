"""The live image on its image plane for a vector drawing: pixels in cells of the page.

If the outside camera is a perspective one, no single affine map places the image. A grid of cells
does, each of them affine to a fraction of a pixel. Whatever is in front of the plane is cut out of
the image. Pure.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.outside.occlusion import Hidden
from renderer.raster.overlay import BACK_LIGHT, Plane

Floats = NDArray[np.float64]
Size = tuple[int, int]

COUNTS = (1, 2, 3, 4, 6, 8, 12, 16, 24)  # cells of a side
EXACT_PX = 0.2  # by which a cell may be wrong
OVERLAP_PX = 0.4  # of neighbouring cells: no gaps where their edges are smoothed
MOST_PIXELS = 1 << 20  # of the image; a larger one is made smaller
FARTHEST = 8.0  # times the page: a cell that reaches farther is left out


@dataclass(frozen=True, eq=False)
class Patch:
    """A part of the image. matrix: (a, b, c, d, e, f) as SVG has it, from the image's pixels to
    the page. corners (4, 2): on the page, with the overlap."""

    matrix: tuple[float, float, float, float, float, float]
    corners: Floats


@dataclass(frozen=True, eq=False)
class Standing:
    """rgba (height, width, 4): the image, transparent where something is in front of it. opacity:
    of the whole image.
    """

    rgba: NDArray[np.uint8]
    cells: tuple[Patch, ...]
    opacity: float


def standing(
    picture: NDArray[np.uint8], plane: Plane, size: Size, hidden: Hidden, opacity: float
) -> Standing | None:
    """Return the picture (height, width, 3) on the plane, or None if nothing of it is on the
    page.

    size: of the page. hidden: by the scene, of the page.
    """
    picture = _reduced(picture)
    place = _Place(plane, size)
    cells = _cells(place, picture.shape[:2], size)
    if not cells:
        return None
    light = 1.0 if plane.is_front else BACK_LIGHT
    rgba = np.empty((*picture.shape[:2], 4), np.uint8)
    rgba[..., :3] = np.round(light * picture.astype(np.float32))
    rgba[..., 3] = np.where(_covered(place, plane, picture.shape[:2], hidden), 0, 255)
    return Standing(rgba, cells, opacity)


def plane_t(plane: Plane, size: Size, parallel: bool) -> NDArray[np.float32]:
    """Return the plane's ray parameter at the centres of the page's pixels, (height, width);
    infinity outside the image.
    """
    width, height = size
    x, y = np.arange(width) + 0.5 - width / 2, np.arange(height) + 0.5 - height / 2
    screen = np.stack([*np.meshgrid(x, y), np.ones((height, width))], axis=-1)
    at, s = screen @ plane.from_screen.T, screen @ plane.depth
    with np.errstate(all="ignore"):
        places = at[..., :2] / at[..., 2:]
        t = s if parallel else 1 / s
    inside = (s > 0) & (places >= 0).all(axis=-1) & (places <= 1).all(axis=-1)
    return np.where(inside, t, np.inf).astype(np.float32)


class _Place:
    """From the picture to the page: X and Y, 0 to 1 rightwards and downwards over the picture."""

    def __init__(self, plane: Plane, size: Size) -> None:
        self._matrix = np.linalg.inv(plane.from_screen)
        self.middle = np.asarray(size, float) / 2

    def at(self, x: Floats, y: Floats) -> Floats:
        """Return page positions (..., 2); NaN where the plane is behind the outside camera."""
        spots = np.stack([x, y, np.ones_like(x)], axis=-1) @ self._matrix.T
        with np.errstate(all="ignore"):
            places = spots[..., :2] / spots[..., 2:] + self.middle
        return np.where(spots[..., 2:] > 0, places, np.nan)


def _cells(place: _Place, shape: tuple[int, ...], size: Size) -> tuple[Patch, ...]:
    """Return the fewest cells that are exact, without those off the page."""
    found: list[Patch] = []
    for count in COUNTS:
        found, worst = [], 0.0
        edges = np.linspace(0.0, 1.0, count + 1)
        middles = (edges[1:] + edges[:-1]) / 2
        corners = place.at(*np.meshgrid(edges, edges))
        centers = place.at(*np.meshgrid(middles, middles))
        for i in range(count):
            for j in range(count):
                ring = corners[[i, i, i + 1, i + 1], [j, j + 1, j + 1, j]]
                if not _on_page(ring, size):
                    continue
                middle = ring.mean(axis=0)
                right = (ring[1] + ring[2] - ring[0] - ring[3]) / 2
                down = (ring[2] + ring[3] - ring[0] - ring[1]) / 2
                twist = np.abs(ring[0] + ring[2] - ring[1] - ring[3]).max() / 4
                worst = max(worst, twist, float(np.abs(middle - centers[i, j]).max()))
                first = middle - right * (j + 0.5) - down * (i + 0.5)
                a, b = (right * count / shape[1]).tolist()
                c, d = (down * count / shape[0]).tolist()
                e, f = first.tolist()
                found.append(Patch((a, b, c, d, e, f), _widened(ring)))
        if worst < EXACT_PX:
            break
    return tuple(found)


def _on_page(ring: Floats, size: Size) -> bool:
    if not np.isfinite(ring).all() or (np.abs(ring) > FARTHEST * max(size)).any():
        return False
    return bool((ring.max(axis=0) > 0).all() and (ring.min(axis=0) < size).all())


def _widened(ring: Floats) -> Floats:
    """Return the corners moved away from their middle by the overlap."""
    away = ring - ring.mean(axis=0)
    lengths = np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
    return ring + away * (1.5 * OVERLAP_PX / lengths)


def _covered(
    place: _Place, plane: Plane, shape: tuple[int, ...], hidden: Hidden
) -> NDArray[np.bool_]:
    """Return which pixels of the picture have something in front of them, (height, width)."""
    y, x = ((np.arange(side) + 0.5) / side for side in shape)
    places = place.at(*np.meshgrid(x, y)).reshape(-1, 2)
    screen = np.column_stack([np.nan_to_num(places - place.middle), np.ones(len(places))])
    return hidden.partly(places, screen @ plane.depth).reshape(shape)


def _reduced(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Reduce the image by whole factors, each pixel the mean of its pixels, until a file can hold
    it.
    """
    height, width = picture.shape[:2]
    factor = 1
    while (height // factor) * (width // factor) > MOST_PIXELS:
        factor += 1
    if factor == 1 or min(height, width) < factor:
        return picture
    height, width = height // factor, width // factor
    blocks = picture[: height * factor, : width * factor].reshape(
        height, factor, width, factor, picture.shape[2]
    )
    return np.round(blocks.mean(axis=(1, 3))).astype(np.uint8)
