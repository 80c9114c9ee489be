"""Remedies for a black image: the cause in, a state with another camera or exposure out.

Pure. The causes are those of renderer/nothing_hit.py and renderer/black.py.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.cameras.presets import framed
from app.state.app_state import AppState
from renderer.black import Darkness, exposure_for
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.focus import Focus
from renderer.navigation import with_shift
from renderer.nothing_hit import Reason

LOOK, FRAME, CUT_NOTHING = "Look there", "Frame the scene", "Without near and far"
CENTER, EXPOSE = "Centre the viewport", "Set the exposure"
_REMEDIES = {
    **dict.fromkeys(("behind", "beside", "lens"), LOOK),
    **dict.fromkeys(("small", "missed", "inside"), FRAME),
    "clip": CUT_NOTHING,
    "viewport": CENTER,
    "exposure": EXPOSE,
}


def remedy_for(reason: Reason) -> str:
    """Return the label of a button that helps; "" if no camera and no exposure does."""
    return _REMEDIES.get(reason.cause, "")


def helped(state: AppState, reason: Reason, darkness: Darkness, focus: Focus) -> AppState:
    """Return the state in which something is visible, as far as is known.

    Raises LucidaError if the camera cannot be moved there.
    """
    camera, remedy = state.camera, remedy_for(reason)
    if remedy == EXPOSE:
        return state.with_options(images={"exposure_ev": exposure_for(darkness.brightest)})
    if remedy == LOOK:
        return state.with_camera(looking_at(camera, focus))
    if remedy == FRAME:
        return state.with_camera(framed(camera, focus.framed, focus.bounds))
    if remedy == CUT_NOTHING:
        return state.with_camera(replace(camera, near=None, far=None))
    if remedy == CENTER:
        return state.with_camera(_centred(camera))
    return state


def looking_at(camera: Camera, focus: Focus) -> Camera:
    """Return the camera turned about its eye, as a whole, towards the objects to frame.

    It is moved as well if rays are parallel, or if the eye is in the middle of the target. Raises
    LucidaError.
    """
    if camera.is_parallel or not len(focus.framed):
        return framed(camera, focus.framed, focus.bounds)
    low, high = focus.framed.min(axis=0), focus.framed.max(axis=0)
    toward = (low + high) / 2 - np.asarray(camera.eye)
    if not np.linalg.norm(toward) > np.linalg.norm(high - low) / 2:
        return framed(camera, focus.framed, focus.bounds)
    back = np.asarray(camera.w)
    turn = _standing(-toward, camera.v) @ _standing(back, camera.v).T
    u, v, w = ((turn @ axis).tolist() for axis in (camera.u, camera.v, camera.w))
    return _centred(replace(camera, u=u, v=v, w=w))


def _centred(camera: Camera) -> Camera:
    return with_shift(with_shift(camera, 0, 0.0), 1, 0.0)


def _standing(back: np.ndarray, up: tuple[float, float, float]) -> np.ndarray:
    """Return an orthonormal basis with a direction backwards, and its up as close to `up` as
    possible.
    """
    for upward in (up, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)):
        try:
            return Camera.look_at(back, (0.0, 0.0, 0.0), upward).basis
        except LucidaError:
            continue
    raise LucidaError("eye", "is where one should look", "move it")
