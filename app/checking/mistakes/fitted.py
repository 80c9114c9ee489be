"""The camera that was written: the one whose rays are those that came back.

Nearly all that people write for a camera's rays is affine in the pixel: in perspective
direction = A + i B + j C and one origin, in parallel projection origin = A + i B + j C and one
direction. A, B and C follow from the rays, and a camera from them: u is C, over the step of a
column; v is -B, over that of a row; w what is left. Any such rays are a camera's, skewed,
left-handed and mirrored ones too.

Directions may have been normalised: of each only its line and its sense count. n x (A + i B + j C)
= 0 for every direction n is linear in A, B, C; they are its null space, by the singular value
decomposition, with rows and columns from -1 to 1 so that it is well conditioned. Four pixels, no
three in a line, determine it, as four points do a plane's projective map.

Tolerance. Answers may be computed in float32: with M the largest number on the way (the eye, a
point of the viewport), each is off by a few 2^-24 M. 2^-18 M, 64 of these, is far from what any
pixel's step is, and far from what twenty operations lose. A direction's error as an angle is that
over its length. Rays that all lie within it of a camera's rays are that camera's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from renderer.camera import Camera, Size, Vector
from renderer.errors import LucidaError

Floats = NDArray[np.float64]

FLOAT32 = 2.0**-18
SMALLEST = 1e-12
RANK = 1e-6  # of the largest singular value: where a second one is smaller, rays determine nothing


@dataclass(frozen=True, eq=False)
class AffineRays:
    """Rays affine in the pixel, from 0 at the top left: at (i, j) = at + i * row + j * column, of
    the directions up to one factor or, of parallel rays, of the origins.

    fixed: the one origin, or the one direction, of length 1. starts_there: whether all rays start
    at that origin, or only lead through it. keeps_lengths: whether the directions themselves are
    affine, and so not of one length each. error: how far the rays are from these, as an angle or
    relative to the largest number, `scale`.
    """

    is_parallel: bool
    at: Floats
    row: Floats
    column: Floats
    fixed: Floats
    starts_there: bool
    keeps_lengths: bool
    scale: float
    error: float

    def camera(self, asked: Camera, size: Size) -> Camera | None:
        """The camera with these rays and the viewport and the distance of the one that was asked
        for; None where its basis is none."""
        try:
            eye, u, v, w = (_vector(part) for part in self.frame(asked, size))
            projection = "parallel" if self.is_parallel else "perspective"
            return Camera(eye, u, v, w, asked.distance, asked.viewport, projection)
        except LucidaError:
            return None

    def frame(self, asked: Camera, size: Size) -> tuple[Floats, Floats, Floats, Floats]:
        """Its eye, u, v, w; those of a direction up to one factor."""
        left, right, bottom, top = asked.viewport
        step_x, step_y = (right - left) / size[0], (top - bottom) / size[1]
        u, v = self.column / step_x, -self.row / step_y
        middle = self.at - (left + step_x / 2) * u - (top - step_y / 2) * v
        if self.is_parallel:
            return middle, u, v, -self.fixed
        return self.fixed, u, v, -middle / asked.distance


def affine_rays(
    i: ArrayLike, j: ArrayLike, origins: ArrayLike, directions: ArrayLike, scale: float = 0.0
) -> AffineRays | None:
    """What the rays of the pixels (i, j) of one image are affine to; None where they are not, or
    where the pixels do not determine it. i, j: (N,), 0-based, from the top left. origins,
    directions: (N, 3). scale: the largest number on the way to the rays, if it is larger than
    those that came back."""
    rows, columns = np.ravel(np.asarray(i, float)), np.ravel(np.asarray(j, float))
    starts = np.asarray(origins, float).reshape(-1, 3)
    lengths = np.linalg.norm(np.asarray(directions, float).reshape(-1, 3), axis=1)
    if len(rows) < 3 or not np.isfinite(starts).all() or not np.isfinite(lengths).all():
        return None
    if lengths.min() < SMALLEST:
        return None
    along = np.asarray(directions, float).reshape(-1, 3) / lengths[:, None]
    largest = max(float(np.abs(starts).max()), scale, SMALLEST)
    mean = along.mean(axis=0)
    mean /= max(float(np.linalg.norm(mean)), SMALLEST)
    spread = float(np.linalg.norm(along - mean, axis=1).max())
    if spread <= FLOAT32 * max(1.0, scale / float(lengths.min())):
        return _parallel(rows, columns, starts, mean, largest, spread)
    return _perspective(rows, columns, starts, along, lengths, largest)


def _vector(array: Floats) -> Vector:
    x, y, z = array.tolist()
    return x, y, z


class _Grid:
    """Pixels with rows and columns from -1 to 1."""

    def __init__(self, rows: Floats, columns: Floats) -> None:
        self.middle = np.array([rows.max() + rows.min(), columns.max() + columns.min()]) / 2
        self.half = np.maximum(np.array([np.ptp(rows), np.ptp(columns)]) / 2, 0.5)
        self.rows = (rows - self.middle[0]) / self.half[0]
        self.columns = (columns - self.middle[1]) / self.half[1]
        self.terms = np.column_stack([np.ones(len(rows)), self.rows, self.columns])

    def of_pixels(self, found: Floats) -> Floats:
        """A, B, C of these numbers as those of rows and columns from 0; (3, 3), one a row."""
        row, column = found[1] / self.half[0], found[2] / self.half[1]
        at = found[0] - self.middle[0] * row - self.middle[1] * column
        return np.array([at, row, column])


def _parallel(
    rows: Floats, columns: Floats, starts: Floats, along: Floats, largest: float, spread: float
) -> AffineRays | None:
    grid = _Grid(rows, columns)
    if np.linalg.matrix_rank(grid.terms, RANK) < 3:
        return None
    found = np.linalg.lstsq(grid.terms, starts, rcond=None)[0]
    error = float(np.abs(grid.terms @ found - starts).max()) / largest
    if error > 2 * FLOAT32:
        return None
    at, row, column = grid.of_pixels(found)
    return AffineRays(True, at, row, column, along, True, True, largest, max(error, spread))


def _perspective(
    rows: Floats, columns: Floats, starts: Floats, along: Floats, lengths: Floats, largest: float
) -> AffineRays | None:
    grid = _Grid(rows, columns)
    # (1 - n n^T) (A + i B + j C) = 0: as n x (...), but of nine numbers each as large as its error.
    across = np.eye(3) - along[:, :, None] * along[:, None, :]
    system = (grid.terms[:, None, :, None] * across[:, :, None, :]).reshape(-1, 9)
    # Of the triangle of its QR, which has the same: many pixels would make the left side large.
    _, sizes, vectors = np.linalg.svd(np.linalg.qr(system, mode="r"), full_matrices=True)
    if len(sizes) < 9 or sizes[7] < RANK * sizes[0]:
        return None
    found = vectors[8].reshape(3, 3)
    made = grid.terms @ found
    sense = np.sum(made * along, axis=1)
    if np.median(sense) < 0:
        found, made, sense = -found, -made, -sense
    made_lengths = np.linalg.norm(made, axis=1)
    if made_lengths.min() < SMALLEST or sense.min() <= 0:
        return None
    allowed = 2 * FLOAT32 * np.maximum(1.0, largest / lengths)
    errors = np.linalg.norm(made / made_lengths[:, None] - along, axis=1)
    through = _common_point(starts, along)
    if (errors > allowed).any() or through is None:
        return None
    eye, miss, starts_there = through
    if miss > 2 * FLOAT32 * max(largest, float(np.abs(eye).max())):
        return None
    # The factor that gives back the lengths that came, where it is one factor.
    factors = lengths / made_lengths
    keeps_lengths = float(np.ptp(factors) / np.median(factors)) <= 4 * float(allowed.max())
    at, row, column = grid.of_pixels(found * float(np.median(factors)))
    error = max(float(errors.max()), miss / largest)
    return AffineRays(False, at, row, column, eye, starts_there, keeps_lengths, largest, error)


def _common_point(starts: Floats, along: Floats) -> tuple[Floats, float, bool] | None:
    """The point that all rays start at, or that all their lines lead through; how far they miss
    it; and which of the two it is."""
    mean = starts.mean(axis=0)
    largest = float(np.abs(starts).max())
    apart = float(np.abs(starts - mean).max())
    if apart <= 2 * FLOAT32 * max(largest, SMALLEST):
        return np.median(starts, axis=0), apart, True
    across = np.eye(3) - along[:, :, None] * along[:, None, :]
    total = across.sum(axis=0)
    if np.linalg.cond(total) > 1 / RANK:
        return None
    point = np.linalg.solve(total, np.einsum("nij,nj->i", across, starts))
    miss = np.einsum("nij,nj->ni", across, point - starts)
    return point, float(np.abs(miss).max()), False
