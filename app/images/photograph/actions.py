"""The actions of the photograph: show it, undistort it, close it."""

from __future__ import annotations

from dataclasses import replace

from lucida.app.images.photograph.model import can_undistort, closed, undistorting
from lucida.app.images.photograph.panel import UNDISTORT
from lucida.app.state.app_state import AppState
from lucida.app.ui.action import Action, changing
from lucida.app.ui.host import Host

MENU = "Image/Photograph"


def is_open(window: Host) -> bool:
    """Return True if there is a photograph for the images."""
    return bool(window.state.options.photograph.file)


def _switched(state: AppState) -> AppState:
    shown = not state.options.photograph.shown
    return state.with_options(replace(state.options.photograph, shown=shown))


def _undistort(window: Host) -> None:
    window.change(undistorting(window.state, window.renderers.size))


PHOTOGRAPH = (
    Action(
        MENU,
        "Photograph on the images",
        changing(_switched),
        "Alt+P",
        is_on=lambda state: state.options.photograph.shown,
        can=is_open,
    ),
    Action(
        MENU,
        UNDISTORT,
        _undistort,
        is_on=lambda state: state.options.photograph.distorted is not None,
        can=lambda window: can_undistort(window.state),
        separated=True,
    ),
    Action(MENU, "Close the photograph", changing(closed), can=is_open, separated=True),
)
