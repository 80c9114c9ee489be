"""The actions of the photograph: show it, lay it over or behind the images, set its opacity, close
it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from app.images.photograph.model import can_undistort, closed, undistorting
from app.images.photograph.panel import UNDISTORT
from app.state.app_state import AppState
from app.state.options.photograph import Lay
from app.ui.action import Action, changing
from app.ui.host import Host

MENU = "Image/Photograph"
STEP = 0.1


def is_open(window: Host) -> bool:
    """Return True if there is a photograph for the images."""
    return bool(window.state.options.photograph.file)


def _switched(state: AppState) -> AppState:
    shown = not state.options.photograph.shown
    return state.with_options(replace(state.options.photograph, shown=shown))


def _laid(lay: Lay) -> Callable[[AppState], AppState]:
    return lambda state: state.with_options(replace(state.options.photograph, lay=lay, shown=True))


def _stronger(step: float) -> Callable[[AppState], AppState]:
    def change(state: AppState) -> AppState:
        opacity = round(state.options.photograph.opacity + step, 6)
        return state.with_options(replace(state.options.photograph, opacity=opacity))

    return change


def _undistort(window: Host) -> None:
    window.change(undistorting(window.state, window.renderers.size))


def _lay(name: str, lay: Lay) -> Action:
    return Action(
        MENU,
        name,
        changing(_laid(lay)),
        is_on=lambda state: state.options.photograph.lay == lay,
        can=is_open,
        separated=lay == "over",
    )


PHOTOGRAPH = (
    Action(
        MENU,
        "Photograph on the images",
        changing(_switched),
        "Alt+P",
        is_on=lambda state: state.options.photograph.shown,
        can=is_open,
    ),
    _lay("Photograph over the images", "over"),
    _lay("Photograph where nothing is hit", "behind"),
    Action(MENU, "Photograph more opaque", changing(_stronger(STEP)), can=is_open),
    Action(MENU, "Photograph less opaque", changing(_stronger(-STEP)), can=is_open),
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
