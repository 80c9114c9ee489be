"""The actions of the photograph: show it, undistort it, close it."""

from __future__ import annotations

from lucida.app.images.photograph.model import can_undistort, closed, undistorting
from lucida.app.ui.action import Action, changing, choosing
from lucida.app.ui.host import Host

MENU = "Image/Photograph"
UNDISTORT = "Undistort the photograph"


def is_open(window: Host) -> bool:
    """Return True if there is a photograph for the images."""
    return bool(window.state.options.photograph.file)


def _undistort(window: Host) -> None:
    window.change(undistorting(window.state, window.renderers.size))


PHOTOGRAPH = (
    choosing(
        MENU,
        "Photograph on the images",
        "photograph.shown",
        True,
        "Alt+P",
        off=False,
        can=is_open,
    ),
    Action(
        MENU,
        UNDISTORT,
        _undistort,
        is_on=lambda state: state.options.photograph.distorted is not None,
        can=lambda window: can_undistort(window.state),
        separated=True,
        tip="What a pinhole would have seen: photograph and camera, no lens.",
    ),
    Action(MENU, "Close the photograph", changing(closed), can=is_open, separated=True),
)
