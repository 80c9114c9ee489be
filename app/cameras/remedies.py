"""Remedies for a black image: each cause leads to a state with another camera or exposure.

Pure. The causes are those of renderer/compare/why_black.py.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.state.app_state import AppState
from lucida.renderer.compare.why_black import Darkness, Reason, exposure_for
from lucida.renderer.scene.focus import Focus

from .presets import framed

FRAME, CUT_NOTHING, EXPOSE = "Frame the scene", "Without near and far", "Set the exposure"
_REMEDIES = {
    **dict.fromkeys(("behind", "beside", "lens"), FRAME),
    "clip": CUT_NOTHING,
    "exposure": EXPOSE,
}


def remedy_for(reason: Reason) -> str:
    """Return the label of a button that helps; "" if no camera or exposure helps."""
    return _REMEDIES.get(reason.cause, "")


def helped(state: AppState, reason: Reason, darkness: Darkness, focus: Focus) -> AppState:
    """Return the state in which something is visible, as far as is known.

    Raises LucidaError if the camera cannot be moved there.
    """
    camera, remedy = state.camera, remedy_for(reason)
    if remedy == EXPOSE:
        return state.with_options(
            replace(state.options.images, exposure_ev=exposure_for(darkness.brightest))
        )
    if remedy == FRAME:
        return state.with_camera(framed(camera, focus.framed, focus.bounds))
    if remedy == CUT_NOTHING:
        return state.with_camera(replace(camera, near=None, far=None))
    return state
