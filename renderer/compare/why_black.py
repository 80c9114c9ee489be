"""The reason that an image shows nothing, or is black."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.display import from_srgb
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.boxes import corners_of
from lucida.renderer.scene.flat import FlatScene

DARK = 1.5 / 255  # a display value; darker images look black
DARK_LIGHT = float(from_srgb(DARK))
NO_LIGHT = 1e-6  # linear: invisible at any usual exposure


class Reason(NamedTuple):
    """The reason that nothing is visible. cause: a word for programs, which select a remedy by it.
    text: the same in a few words for people.
    """

    cause: str
    text: str


class Darkness(NamedTuple):
    """The darkness of an image.

    brightest: linear light, the maximum over all channels of all pixels that hit something. reason:
    the reason that it is 0, or that nothing is hit; None if there is light.
    """

    brightest: float
    reason: Reason | None

    def shown(self, exposure_ev: float, is_linear: bool = False) -> Reason | None:
        """Return the reason that the colours are black with this exposure; None if they are not.

        is_linear: shown without the sRGB curve.
        """
        if self.reason is not None:
            return self.reason
        if self.brightest * 2.0**exposure_ev >= (DARK if is_linear else DARK_LIGHT):
            return None
        text = f"the exposure is {exposure_ev:+.3g} EV; the brightest pixel is {self.brightest:.2g}"
        return Reason("exposure", text)


def hits_nothing(*frames: Frame) -> bool:
    """Return True if no pixel of any of the frames, which must have the channel id, hits
    anything.
    """
    return all(not (frame.channel("id") >= 0).any() for frame in frames)


def darkness(flat: FlatScene, camera: Camera, frame: Frame) -> Darkness:
    """Return the darkness of an image and its reason. frame: with the channels color and id.

    Additional causes to those of why_nothing_is_hit() are no "light" and, in Darkness.shown(), the
    "exposure".
    """
    if hits_nothing(frame):
        return Darkness(0.0, why_nothing_is_hit(flat, camera))
    hit = frame.channel("id") >= 0
    brightest = float(np.nanmax(frame.channel("color")[hit], initial=0.0))
    if brightest > NO_LIGHT:
        return Darkness(brightest, None)
    shining = bool(len(flat.lights)) and bool(flat.lights[:, 1, :3].any())
    text = "no light reaches the visible surfaces" if shining else "the scene has no light"
    return Darkness(brightest, Reason("light", text))


def exposure_for(brightest: float) -> float:
    """Return the largest whole number of stops at which the brightest pixel is at most 1."""
    return float(np.floor(-np.log2(brightest)))


def why_nothing_is_hit(flat: FlatScene, camera: Camera) -> Reason:
    """Return the reason that nothing is hit in any image of this camera.

    The causes: nothing is visible ("empty"); everything is "behind" the eye, outside the "lens",
    "beside" the view volume, or cut by near and far ("clip"). They are tested at points of each
    object's box: its corners, its middle, and the point nearest to the eye.
    """
    visible = (flat.object_faces[:, 1] > 0) | (flat.object_sphere >= 0)
    if not visible.any():
        hidden = "all objects are hidden" if len(visible) else "the scene has no objects"
        return Reason("empty", hidden)
    row, column, t = camera.project(_points(flat, camera, visible), (1, 1))
    ahead = t > 0
    if not ahead.any():
        return Reason("behind", "everything is behind the eye")
    seen = ahead & np.isfinite(row)
    if not seen.any():
        return Reason("lens", "everything is outside the lens")
    row, column = row[seen], column[seen]
    sides = {
        "left": column < -0.5,
        "right": column > 0.5,
        "below": row > 0.5,
        "above": row < -0.5,
    }
    where = " and ".join(side for side, is_there in sides.items() if is_there.all())
    if where:
        return Reason("beside", f"everything is outside the picture: {where}")
    near, far = camera.t_range
    if (ahead & ~((t > near) & (t < far))).any():
        planes = [f"{n} = {d:g}" for n, d in (("near", camera.near), ("far", camera.far)) if d]
        return Reason("clip", f"all objects in view are cut by {' and '.join(planes)}")
    return Reason("beside", "no viewing ray hits an object")


def middle_of(flat: FlatScene) -> tuple[float, float, float]:
    """Return the centre of the scene's bounds, as a point to look at."""
    x, y, z = flat.bounds.astype(float).mean(axis=0).tolist()
    return x, y, z


def _points(flat: FlatScene, camera: Camera, visible: np.ndarray) -> np.ndarray:
    """Return ten points of the box of each visible object in the world, (n, 10, 3)."""
    bounds, matrix = flat.object_bounds[visible].astype(float), flat.world_from_object[visible]
    eye = np.linalg.inv(matrix) @ np.append(camera.eye, 1.0)
    nearest = np.clip(eye[:, :3], bounds[:, 0], bounds[:, 1])
    points = np.concatenate(
        [corners_of(bounds), bounds.mean(axis=1)[:, None], nearest[:, None]], axis=1
    )
    world: np.ndarray = points @ np.swapaxes(matrix[:, :3, :3], 1, 2) + matrix[:, None, :3, 3]
    return world
