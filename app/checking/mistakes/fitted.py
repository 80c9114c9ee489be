"""The camera that the student wrote: the one whose rays are those that were returned.

Nearly everything that people write for a camera's rays is affine in the pixel: in perspective,
direction = A + i B + j C with one origin; in parallel projection, origin = A + i B + j C with one
direction. A, B and C follow from the rays, and a camera from them: u is C divided by the step of a
column, v is -B divided by that of a row, and w follows from the rest. Any such rays belong to some
camera, including skewed, left-handed and mirrored ones.

Directions may have been normalised, so only their lines and senses count. n x (A + i B + j C) = 0
for every direction n is linear in A, B, C. They span its null space, found by the singular value
decomposition, with rows and columns from -1 to 1 for good conditioning. Four pixels, no three on a
line, determine it, just as four points determine a plane's projective map.

Tolerance. Answers may be computed in float32. With M the largest intermediate result (the eye, a
point of the viewport), each is off by a few 2^-24 M. The tolerance is 2^-18 M, which is 64 times
2^-24 M: far less than any pixel's step, and far more than twenty operations lose. For a direction,
divide by its length to get an angle. Rays match a camera if all lie within the tolerance of its
rays.
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
RANK = 1e-6  # of the largest singular value: if a second one is smaller, the fit is not unique


@dataclass(frozen=True, eq=False)
class AffineRays:
    """Rays affine in the pixel, counted from 0 at the top left.

    At (i, j), at + i * row + j * column is the direction up to a common factor or, for parallel
    rays, the origin.

    fixed: the common origin, or the common direction, of length 1.
    starts_there: True if all rays start at that origin; False if they only pass through it.
    keeps_lengths: True if the directions themselves are affine, hence not normalised.
    scale: the largest intermediate result.
    error: the distance of the rays from these, as an angle or relative to `scale`.
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
        """Return the camera with these rays, and the required viewport and distance; None if its
        basis is singular.
        """
        try:
            eye, u, v, w = (_vector(part) for part in self.frame(asked, size))
            projection = "parallel" if self.is_parallel else "perspective"
            return Camera(eye, u, v, w, asked.distance, asked.viewport, projection)
        except LucidaError:
            return None

    def frame(self, asked: Camera, size: Size) -> tuple[Floats, Floats, Floats, Floats]:
        """Return its eye, u, v, w. In perspective, u, v, w are known up to a common factor."""
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
    """Fit affine rays to the rays of the pixels (i, j) of one image.

    Return None if the rays are not affine, or if the pixels do not determine the fit.

    i, j: (N,), 0-based, from the top left.
    origins, directions: (N, 3).
    scale: the largest intermediate result, if larger than the returned numbers.
    """
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
    """Pixels with rows and columns scaled to -1 to 1."""

    def __init__(self, rows: Floats, columns: Floats) -> None:
        self.middle = np.array([rows.max() + rows.min(), columns.max() + columns.min()]) / 2
        self.half = np.maximum(np.array([np.ptp(rows), np.ptp(columns)]) / 2, 0.5)
        self.rows = (rows - self.middle[0]) / self.half[0]
        self.columns = (columns - self.middle[1]) / self.half[1]
        self.terms = np.column_stack([np.ones(len(rows)), self.rows, self.columns])

    def of_pixels(self, found: Floats) -> Floats:
        """Convert A, B, C to rows and columns counted from 0; (3, 3), one per row."""
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
    # (1 - n n^T) (A + i B + j C) = 0: like n x (...) = 0, but residuals have the errors' size.
    across = np.eye(3) - along[:, :, None] * along[:, None, :]
    system = (grid.terms[:, None, :, None] * across[:, :, None, :]).reshape(-1, 9)
    # R of the QR has the same singular values and vectors; U would be large for many pixels.
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
    # The factor that restores the given lengths, if it is the same for all.
    factors = lengths / made_lengths
    keeps_lengths = float(np.ptp(factors) / np.median(factors)) <= 4 * float(allowed.max())
    at, row, column = grid.of_pixels(found * float(np.median(factors)))
    error = max(float(errors.max()), miss / largest)
    return AffineRays(False, at, row, column, eye, starts_there, keeps_lengths, largest, error)


def _common_point(starts: Floats, along: Floats) -> tuple[Floats, float, bool] | None:
    """Return the point where all rays start, or else the point that all their lines pass through;
    the largest distance from it; and True if the rays start there. Return None if there is no such
    point.
    """
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
