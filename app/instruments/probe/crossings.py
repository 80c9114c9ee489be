"""All crossings of a ray's line with a scene, in front of and behind the eye, visible or hidden.

A small index of boxes around runs of triangles, which are usually near each other in files, keeps
this interactive for a million triangles. Arithmetic is float64, in the order of
renderer/trace/reference/intersect.py, so the reference tracer finds the same numbers.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.camera.checks import Floats
from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.scene.positions import world_vertices
from lucida.renderer.scene.sampling import are_passed

RUN = 64  # triangles that share a box
ROUNDING = 1e-12  # slack of boxes, relative to the coordinates
SAME = 1e-9  # relative; nearer crossings of one object are one, at a common edge


ALL = slice(None)


class Crossings(NamedTuple):
    """The crossings of one line, sorted by t: arrays (n,).

    t: in units of the direction, of either sign. primitive: numbers of the flat scene; objects: of
    the scene. b1, b2: barycentrics of a triangle's second and third corner.
    """

    t: Floats
    primitive: NDArray[np.int64]
    object: NDArray[np.int64]
    b1: Floats
    b2: Floats


_NONE = np.zeros(0, np.int64)
NOTHING = Crossings(np.zeros(0), _NONE, _NONE, np.zeros(0), np.zeros(0))


class Index:
    """A flat scene prepared for lines. Building it takes about 0.3 s for a million triangles.

    vertices (n, 3): in the world, float64.
    """

    def __init__(self, flat: FlatScene) -> None:
        self.flat = flat
        self.vertices = world_vertices(flat)
        runs = [np.arange(first, first + count, RUN) for first, count in flat.object_faces if count]
        self._starts = np.concatenate(runs) if runs else np.zeros(0, np.int64)
        self._first_run = np.searchsorted(self._starts, flat.object_faces[:, 0])
        self._after_runs = np.searchsorted(self._starts, flat.object_faces.sum(axis=1))
        self._ends = np.append(self._starts[1:], len(flat.faces))
        self._low, self._high = self._boxes()

    def crossings(
        self, origin: ArrayLike, direction: ArrayLike, is_light: bool = False
    ) -> Crossings:
        """Return all crossings of the line origin + t direction, (3,) each, with -inf < t < inf.
        is_light: see are_passed()."""
        p, d = np.asarray(origin, float), np.asarray(direction, float)
        with np.errstate(all="ignore"):
            triangles = self._triangles(p, d, is_light=is_light)
            spheres = self._spheres(p, d)
        t, primitive, b1, b2 = (
            np.concatenate(pair) for pair in zip(triangles, spheres, strict=True)
        )
        owners = np.concatenate([self.flat.face_object, self.flat.sphere_object]).astype(np.int64)
        # Sort by t; the lowest number comes first among equal ones, as everywhere.
        by_t = np.lexsort((primitive, t))
        found = Crossings(t, primitive, owners[primitive], b1, b2)
        return _single(_picked(found, by_t))

    def closest(self, origin: ArrayLike, direction: ArrayLike, t_min: float, t_max: float) -> float:
        """Return the least t within (t_min, t_max) that light does not pass; inf if there is
        none."""
        t = self.crossings(origin, direction, is_light=True).t
        t = t[(t > t_min) & (t < t_max)]
        return float(t[0]) if len(t) else np.inf

    def mesh_hit(
        self, number: int, origin: ArrayLike, direction: ArrayLike, t_min: float, t_max: float
    ) -> tuple[float, int, float, float] | None:
        """Return (t, primitive, b1, b2) of the closest hit with one mesh within (t_min, t_max)."""
        runs = slice(self._first_run[number], self._after_runs[number])
        with np.errstate(all="ignore"):
            t, primitive, b1, b2 = self._triangles(
                np.asarray(origin, float), np.asarray(direction, float), runs
            )
        inside = np.flatnonzero((t > t_min) & (t < t_max))
        if not len(inside):
            return None
        best = inside[np.lexsort((primitive[inside], t[inside]))[0]]
        return float(t[best]), int(primitive[best]), float(b1[best]), float(b2[best])

    def _boxes(self) -> tuple[Floats, Floats]:
        """Return the lowest and highest corner of each run, (runs, 3), with slack for rounding."""
        if not len(self._starts):
            none = np.zeros((0, 3))
            return none, none
        corners = self.vertices[self.flat.faces]
        low = np.minimum.reduceat(corners.min(axis=1), self._starts, axis=0)
        high = np.maximum.reduceat(corners.max(axis=1), self._starts, axis=0)
        slack = ROUNDING * np.maximum(np.abs(low), np.abs(high)).max()
        return low - slack, high + slack

    def _triangles(
        self, p: Floats, d: Floats, runs: slice = ALL, is_light: bool = False
    ) -> tuple[Floats, NDArray[np.int64], Floats, Floats]:
        """Return (t, primitive, b1, b2) of the triangles in these runs that the line hits without
        passing them (openings.py).
        """
        numbers = self._candidates(p, d, runs)
        corners = self.vertices[self.flat.faces[numbers]] - p
        # The axis of the line's largest component becomes z; the other two follow it.
        z = int(np.argmax(np.abs(d)))
        x, y = (z + 1) % 3, (z + 2) % 3
        dx, dy, dz = d[x], d[y], d[z]
        az, bz, cz = corners[..., z].T
        ax, bx, cx = corners[..., x].T - dx / dz * corners[..., z].T
        ay, by, cy = corners[..., y].T - dy / dz * corners[..., z].T
        e0, e1, e2 = cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax
        area = e0 + e1 + e2
        inside = ((e0 >= 0) & (e1 >= 0) & (e2 >= 0)) | ((e0 <= 0) & (e1 <= 0) & (e2 <= 0))
        t = (e0 * az + e1 * bz + e2 * cz) * (1.0 / dz) / area
        hit = inside & (area != 0) & np.isfinite(t)
        weights = np.stack([e0, e1, e2], axis=1)[hit] / area[hit, None]
        hit[hit] = ~are_passed(self.flat, numbers[hit], weights, d, is_light)
        return t[hit], numbers[hit], (e1 / area)[hit], (e2 / area)[hit]

    def _candidates(self, p: Floats, d: Floats, runs: slice) -> NDArray[np.int64]:
        """Return the triangles of the runs whose boxes the line hits."""
        # Skip 0 / 0, in a box's face, because the triangles are inside the slack.
        to_low, to_high = (self._low[runs] - p) / d, (self._high[runs] - p) / d
        enter, leave = np.fmin(to_low, to_high), np.fmax(to_low, to_high)
        first, last = enter.max(axis=1, initial=-np.inf), leave.min(axis=1, initial=np.inf)
        met = first <= last + 1e-9 * np.abs(last)
        starts = self._starts[runs][met]
        counts = self._ends[runs][met] - starts
        # Concatenate start, start + 1, ..., start + count - 1 of each run.
        skipped = np.repeat(starts - np.cumsum(counts) + counts, counts)
        return np.asarray(skipped + np.arange(counts.sum()), np.int64)

    def _spheres(self, p: Floats, d: Floats) -> tuple[Floats, NDArray[np.int64], Floats, Floats]:
        """Return the same for both crossings of each sphere; see hit_sphere() in intersect.py."""
        spheres = self.flat.spheres
        f, radius = p - spheres[:, :3], spheres[:, 3]
        a, b = d @ d, -(f @ d)
        nearest = f + (b / a)[:, None] * d
        left_over = radius * radius - (nearest * nearest).sum(axis=1)
        q = b + np.copysign(np.sqrt(a * left_over), b)
        both = np.stack([((f * f).sum(axis=1) - radius * radius) / q, q / a])
        hit = (left_over >= 0) & (q != 0)
        numbers = len(self.flat.faces) + np.flatnonzero(hit)
        t = both[:, hit].ravel()
        zero = np.zeros(len(t))
        return t, np.tile(numbers, 2), zero, zero


def _single(found: Crossings) -> Crossings:
    """Keep only the first of two triangles of one object that are hit at their common edge."""
    if len(found.t) < 2:
        return found
    keep = np.ones(len(found.t), bool)
    for number in np.unique(found.object):
        at = np.flatnonzero(found.object == number)
        gap = np.diff(found.t[at])
        keep[at[1:][gap <= SAME * np.abs(found.t[at[1:]])]] = False
    return _picked(found, keep)


def _picked(found: Crossings, which: NDArray[Any]) -> Crossings:
    return Crossings(*(part[which] for part in found))
