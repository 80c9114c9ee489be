"""The transition from one camera to another, as a pure function of time (travel.py has the clock).

Both cameras are described relative to the focus, a world point. Its position in the camera's
coordinates moves evenly, and so do the viewport and its distance. Each intermediate state is a true
camera. From perspective to parallel, the tangent of half the field of view falls evenly to 0: the
eye recedes and the distance grows (a dolly zoom), until parallel rays make no visible difference.

The basis is B = R S (polar decomposition). R turns uniformly about one axis (slerp; Shoemake 1985),
and the stretch S changes evenly: symmetric positive definite matrices are a convex set, so no
intermediate basis is singular. Cameras of opposite handedness cannot turn into one another without
a singular basis: there is no transition, and the caller jumps (`possible`).
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import SMALLEST, Floats, three
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

Number = TypeVar("Number", float, Floats)

LEAST_SLOPE = 1e-4  # the height of the picture over its distance at which rays become parallel
_PINHOLE = Lens("brown")  # equivalent to no lens


class Pose(NamedTuple):
    """A camera as seen from the focus, in units of u, v and w.

    turn, stretch: B = turn @ stretch, (3, 3).
    at: the focus relative to the eye: right, up, ahead, (3,).
    window: the part of the plane through the focus that is in the picture: left, right, bottom,
    top.
    slope: the window's height over its distance; 0 for parallel rays.
    """

    turn: Floats
    stretch: Floats
    at: Floats
    window: Floats
    slope: float


class Passage:
    """The path from one view to another.

    focus: a world point that moves evenly in the cameras' coordinates.
    size: the images' (width, height).
    """

    def __init__(self, start: View, end: View, focus: ArrayLike, size: tuple[int, int]) -> None:
        self.start, self.end = start, end
        # Views that differ in fitting are interpolated as they are drawn.
        self._fit, self._given = start.fit and end.fit, end.given
        same = start.fit == end.fit
        first, last = (v.camera if same else v.for_size(size) for v in (start, end))
        self._cameras, self._lenses = (first.pinhole, last.pinhole), (first.lens, last.lens)
        self.possible = first.determinant * last.determinant > 0
        self._focus = np.asarray(focus, float)
        if first.is_parallel != last.is_parallel:  # the focus must be in front of the eye
            camera = last if first.is_parallel else first
            if not _pose(camera, self._focus).slope > 0:
                self._focus = np.asarray(camera.eye) - camera.distance * np.asarray(camera.w)
        self._poses = _pose(first, self._focus), _pose(last, self._focus)

    def at(self, part: float, eased: bool = True) -> View:
        """Return the view at 0 (start) to 1 (end) of the time.

        Both ends are exact; all views between are legal. eased: True for a slow start and a slow
        end; otherwise the pace is even.
        """
        if part <= 0:
            return self.start
        if part >= 1 or not self.possible:
            return self.end
        s = part * part * (3 - 2 * part) if eased else part
        try:
            camera = self._between(s)
            lens = None if camera.is_parallel else lens_between(*self._lenses, s)
            camera = replace(camera, lens=lens)
        except (LucidaError, OverflowError, FloatingPointError):  # beyond the legal range
            return self.start if part < 0.5 else self.end
        return View(camera, self._fit, None if self._fit else self._given)

    def _between(self, s: float) -> Camera:
        (one, two), (first, last) = self._poses, self._cameras
        basis = _slerp(one.turn, two.turn, s) @ _lerp(one.stretch, two.stretch, s)
        right, up, depth = _lerp(one.at, two.at, s).tolist()
        parallel = first.is_parallel
        viewports: Floats = np.array([first.viewport, last.viewport])
        viewport, distance = (
            _lerp(viewports[0], viewports[1], s),
            _lerp(first.distance, last.distance, s),
        )
        is_mixed = parallel != last.is_parallel
        if is_mixed:
            viewport, slope = _lerp(one.window, two.window, s), _lerp(one.slope, two.slope, s)
            parallel, height = slope < LEAST_SLOPE, viewport[3] - viewport[2]
            if not parallel:
                depth = height / slope
                heights = viewports[:, 3] - viewports[:, 2]
                scale = _lerp(heights[0], heights[1], s) / height
                viewport, distance = scale * viewport, scale * depth
        near = far = None
        if is_mixed or (first.near is not None and last.near is not None):
            # Points behind the other eye must not enter the picture.
            begins = _lerp(one.at[2] - (first.near or 0.0), two.at[2] - (last.near or 0.0), s)
            near = depth - begins if depth - begins > SMALLEST else None
        if first.far is not None and last.far is not None:
            far = depth - _lerp(one.at[2] - first.far, two.at[2] - last.far, s)
        eye = self._focus - basis @ (right, up, -depth)
        u, v, w = map(three, basis.T)
        left, right, bottom, top = viewport.tolist()
        kind = "parallel" if parallel else "perspective"
        return Camera(three(eye), u, v, w, distance, (left, right, bottom, top), kind, near, far)


def lens_between(start: Lens | None, end: Lens | None, s: float) -> Lens | None:
    """Return the lens at 0 (start) to 1 (end). Coefficients change evenly between lenses of one
    model, and between a pinhole and a photographic lens; others change halfway.
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


def _pose(camera: Camera, focus: Floats) -> Pose:
    turn, stretch = _polar(camera.basis)
    x, y, z = (camera.camera_from_world @ [*focus, 1.0])[:3].tolist()
    window = np.array(camera.viewport) * (1.0 if camera.is_parallel else -z / camera.distance)
    height = 0.0 if camera.is_parallel else camera.viewport[3] - camera.viewport[2]
    ahead = 1.0 if z < 0 else -1.0
    return Pose(turn, stretch, np.array([x, y, -z]), window, ahead * height / camera.distance)


def _polar(basis: Floats) -> tuple[Floats, Floats]:
    """Return the polar decomposition: an orthogonal and a symmetric matrix, by singular values."""
    left, values, right = np.linalg.svd(basis)
    return left @ right, right.T @ (values[:, None] * right)


def _slerp(start: Floats, end: Floats, s: float) -> Floats:
    """Return the rotation at the fraction `s` between two orthogonal matrices of the same
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


def _lerp(start: Number, end: Number, s: float) -> Number:
    return start + s * (end - start)
