"""The transition from one camera to another, as a pure function of time (travel.py has the clock).

Both cameras are described relative to the focus, a world point: the size at which they see the
plane through it (the focus plane, parallel to u and v), which part of it, and from what distance.
Each intermediate state is a true camera of one kind, whatever the basis. The visible part of the
focus plane grows or shrinks geometrically about its one point that stays fixed in the picture. So
does the eye's depth, between two perspectives: with the same field of view and the same basis, the
eye moves straight. From perspective to parallel, the tangent of half the field of view goes
linearly to 0: the eye recedes and the distance grows (a dolly zoom), until parallel rays make no
visible difference.

The basis B = R S (polar decomposition): R turns uniformly about one axis (slerp; Shoemake 1985),
and the stretch S = V exp(L) V^T is interpolated in its logarithm, so that no intermediate basis is
singular. Cameras of opposite handedness cannot turn into one another without a singular basis:
there is no transition, and the caller jumps (`possible`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import SMALLEST, Floats, Vector
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.camera.navigation import depth_of
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

Number = TypeVar("Number", float, Floats)

INVISIBLE_PX = 0.2  # what parallel rays may move in the picture when they take over
_PINHOLE = Lens("brown")  # the same as none
LEAST_DEPTH = 1e-6  # of a focus in front of the eye, in distances to the image plane


@dataclass(frozen=True)
class Pose:
    """A camera as seen from the focus. Lengths in units of u, v and w.

    turn, stretch: B = turn @ expm(stretch), (3, 3).
    at: the focus, in the focus plane, from the foot of the eye.
    center, half: of the visible part of the focus plane.
    k: 1 / depth of the focus; 0 for parallel.
    start: the distance from the focus to where rays begin, towards the eye.
    end: the same for far, or None.
    height: the viewport's own half height (as numbers).
    """

    turn: Floats
    stretch: Floats
    at: Floats
    half: Floats
    center: Floats
    k: float
    start: float
    end: float | None
    depth: float
    near: float | None
    height: float
    distance: float


class Passage:
    """The path from one view to another.

    focus: the world point whose plane keeps its size, or changes it evenly.
    bounds: world points (n, 3) around the scene.
    size: the images' (width, height).
    """

    def __init__(
        self, start: View, end: View, focus: Vector, bounds: ArrayLike, size: tuple[int, int]
    ) -> None:
        self.start, self.end = start, end
        # Views that differ in fitting pass as they are drawn.
        self._fit, self._given = start.fit and end.fit, end.given
        same = start.fit == end.fit
        first, last = (v.camera if same else v.for_size(size) for v in (start, end))
        self._cameras, self._lenses = (first.pinhole, last.pinhole), (first.lens, last.lens)
        self.possible = first.determinant * last.determinant > 0
        self._bounds = np.asarray(bounds, float).reshape(-1, 3)
        self._focus = _common_focus(first, last, np.asarray(focus, float))
        if self._focus is None or not self.possible:
            return
        self._poses = _pose(first, self._focus), _pose(last, self._focus)
        self._least_k = self._invisible_k(size)

    def at(self, part: float, eased: bool = True) -> View:
        """Return the view at 0 (start) to 1 (end) of the time.

        Both ends are exact; all views between are legal. eased: with a slow start and a slow end;
        otherwise at an even pace.
        """
        if part <= 0:
            return self.start
        if part >= 1 or not self.possible:
            return self.end
        s = part * part * (3 - 2 * part) if eased else part
        try:
            camera = self._plain(s) if self._focus is None else self._between(s)
            lens = None if camera.is_parallel else lens_between(*self._lenses, s)
            camera = replace(camera, lens=lens)
        except (LucidaError, OverflowError, FloatingPointError):  # beyond the legal range
            return self.start if part < 0.5 else self.end
        return View(camera, self._fit, None if self._fit else self._given)

    def _between(self, s: float) -> Camera:
        assert self._focus is not None
        one, two = self._poses
        turn = _slerp(one.turn, two.turn, s)
        basis = turn @ _expm(_lerp(one.stretch, two.stretch, s))
        half = np.exp(_lerp(np.log(one.half), np.log(two.half), s))
        way = np.array([_way(*ends, s) for ends in zip(one.half, two.half, strict=True)])
        at, center = one.at + way * (two.at - one.at), one.center + way * (two.center - one.center)
        if one.k and two.k:
            parallel, along = False, _way(one.depth, two.depth, s)
            depth = math.exp(_lerp(math.log(one.depth), math.log(two.depth), s))
        else:
            k = _lerp(one.k * one.half[1], two.k * two.half[1], s) / half[1]
            parallel, along = k <= self._least_k, s
            depth = _lerp(one.depth, two.depth, s) if parallel else 1.0 / k
        start = _lerp(one.start, two.start, along)
        near = depth - start
        if not (parallel or (one.near and two.near)) and self._all_behind(basis, start):
            near = 0.0  # a plane that cuts nothing off
        far = None
        if one.end is not None and two.end is not None:
            far = depth - _lerp(one.end, two.end, along)
        scale, distance = 1.0, math.exp(_lerp(math.log(one.distance), math.log(two.distance), s))
        if not parallel:
            scale = math.exp(_lerp(math.log(one.height), math.log(two.height), s)) / half[1]
            distance = scale * depth
        eye = self._focus - basis @ np.array([at[0], at[1], -depth])
        (left, bottom), (right, top) = ((center + side * half) * scale for side in (-1, 1))
        u, v, w = basis.T.tolist()
        return Camera(
            eye.tolist(),
            u,
            v,
            w,
            distance,
            (left, right, bottom, top),
            "parallel" if parallel else "perspective",
            near if near > max(SMALLEST, 1e-6 * abs(depth)) else None,
            far,
        )

    def _plain(self, s: float) -> Camera:
        """Return the camera in between if no focus is in front of both eyes: the eye moves
        straight.
        """
        one, two = self._cameras
        first, last = _polar(one.basis), _polar(two.basis)
        basis = _slerp(first[0], last[0], s) @ _expm(_lerp(first[1], last[1], s))
        u, v, w = basis.T.tolist()
        distance = math.exp(_lerp(math.log(one.distance), math.log(two.distance), s))
        eye, viewport = (
            _lerp(np.array(start), np.array(end), s).tolist()
            for start, end in ((one.eye, two.eye), (one.viewport, two.viewport))
        )
        near, far = (
            None if start is None or end is None else _lerp(start, end, s)
            for start, end in ((one.near, two.near), (one.far, two.far))
        )
        return replace(
            one,
            eye=eye,
            u=u,
            v=v,
            w=w,
            distance=distance,
            viewport=viewport,
            near=near,
            far=far,
        )

    def _all_behind(self, basis: Floats, start: float) -> bool:
        """Return True if nothing of the scene is in front of the plane in which rays begin. No clip
        plane is needed then.
        """
        heights = (self._bounds - self._focus) @ np.linalg.inv(basis).T[:, 2]
        return float(heights.max(initial=-math.inf)) < start

    def _invisible_k(self, size: tuple[int, int]) -> float:
        """Below this k, parallel rays look the same.

        A point h before the focus plane, seen r pixels from the foot of the eye, moves by r h k.
        """
        least = math.inf
        for pose, camera in zip(self._poses, self._cameras, strict=True):
            shown = camera.fitted(size) if self._fit else camera
            left, right, bottom, top = shown.viewport
            middle = (left + right) / (right - left), (bottom + top) / (top - bottom)
            radius_px = float(np.linalg.norm((np.abs(middle) + 1.0) * size / 2))
            heights = (self._bounds - self._focus) @ np.linalg.inv(camera.basis).T[:, 2]
            height = float(np.abs(heights).max(initial=abs(pose.start)))
            least = min(least, INVISIBLE_PX / (radius_px * height))
        return least


def lens_between(start: Lens | None, end: Lens | None, s: float) -> Lens | None:
    """Return the lens at 0 (start) to 1 (end). Coefficients change evenly between lenses of one
    model, and between a pinhole and a photographic lens; others change at half of the way.
    """
    if start == end:
        return start
    model = (start or end or _PINHOLE).model
    if model == _PINHOLE.model:
        start, end = start or _PINHOLE, end or _PINHOLE
    if start is None or end is None or start.model != end.model:
        return start if s < 0.5 else end
    names = {**start.coefficients, **end.coefficients}
    return Lens(
        model, {name: _lerp(start.coefficient(name), end.coefficient(name), s) for name in names}
    )


def _common_focus(one: Camera, two: Camera, focus: Floats) -> Floats | None:
    """Return a point in front of every perspective eye: the focus, or else the middle of one of the
    image planes; None if there is none.
    """
    middle = [np.asarray(c.eye) - c.distance * np.asarray(c.w) for c in (one, two)]
    for point in (focus, *middle):
        depths = [depth_of(c, point) / c.distance for c in (one, two) if not c.is_parallel]
        if all(depth > LEAST_DEPTH for depth in depths):
            return point
    return None


def _pose(camera: Camera, focus: Floats) -> Pose:
    turn, stretch = _polar(camera.basis)
    x, y, z = (camera.camera_from_world @ [*focus, 1.0])[:3].tolist()
    left, right, bottom, top = camera.viewport
    scale = 1.0 if camera.is_parallel else -z / camera.distance
    half = np.array([right - left, top - bottom]) / 2 * scale
    center = np.array([left + right, bottom + top]) / 2 * scale
    near, far = camera.near, camera.far
    return Pose(
        turn,
        stretch,
        np.array([x, y]),
        half,
        center,
        0.0 if camera.is_parallel else -1.0 / z,
        -z - (near or 0.0),
        None if far is None else -z - far,
        -z,
        near,
        (top - bottom) / 2,
        camera.distance,
    )


def _polar(basis: Floats) -> tuple[Floats, Floats]:
    """Return (R, L) with basis = R expm(L): orthogonal, and symmetric; by singular values."""
    left, values, right = np.linalg.svd(basis)
    return left @ right, right.T @ (np.log(values)[:, None] * right)


def _expm(symmetric: Floats) -> Floats:
    values, vectors = np.linalg.eigh(symmetric)
    return vectors @ (np.exp(values)[:, None] * vectors.T)


def _slerp(start: Floats, end: Floats, s: float) -> Floats:
    """Return the rotation part of the way between two orthogonal matrices of the same
    handedness.
    """
    turn = end @ start.T
    sines = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    sine, cosine = float(np.linalg.norm(sines)) / 2, (float(np.trace(turn)) - 1) / 2
    if sine > 1e-7:
        axis = sines / np.linalg.norm(sines)
    elif cosine > 0:
        return start + s * (end - start)
    else:  # half a turn: R + 1 is 2 axis axis^T; of the two ways, the one about the upper half
        outer = turn + np.eye(3)
        axis = outer[:, int(np.argmax(np.diag(outer)))]
        axis = axis / np.linalg.norm(axis)
        if axis[1] < 0:
            axis = -axis
    angle = s * math.atan2(sine, cosine)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return rotation @ start


def _way(start: float, end: float, s: float) -> float:
    """Return how far a length has come that changes geometrically."""
    logarithm = math.log(end / start)
    return math.expm1(s * logarithm) / math.expm1(logarithm) if logarithm else s


def _lerp(start: Number, end: Number, s: float) -> Number:
    return start + s * (end - start)
