"""The outside view's actions: switches, handles, and directions to look from.

The view's own menu and the menu Instruments have the same entries.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.instruments.outside.looking import AXIS_NAMES
from lucida.app.instruments.outside.tools import MENU
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.app_state import AppState
from lucida.app.state.options.outside import STAGES
from lucida.app.ui.action import Action, changing, choosing
from lucida.app.ui.host import Host
from lucida.renderer.camera.navigation import switched_projection
from lucida.renderer.system.errors import LucidaError

BUNDLE = (4, 5)  # rows and columns of the bundle when it is switched on


def _toggle_formula(state: AppState) -> AppState:
    formula = None if _has_formula(state) else float(len(STAGES))
    return state.with_options(replace(state.options.outside, formula=formula))


def _has_formula(state: AppState) -> bool:
    return state.options.outside.formula is not None


def _switch_projection(host: Host) -> None:
    view = host.view(OutsideView)
    assert view.scope is not None
    try:
        view.look(host, switched_projection(view.scope.camera, host.focus.center))
    except LucidaError:  # beyond the numbers: the camera stays
        return


def _is_parallel(state: AppState) -> bool:
    camera = state.options.outside.camera
    return camera is not None and camera.is_parallel


def _is_drawn(host: Host) -> bool:
    return host.view(OutsideView).scope is not None


def _show(name: str, tip: str) -> Action:
    return choosing(MENU, f"Show {name}", f"outside.{name}", True, off=False, tip=tip)


def _handles(name: str, kind: str, tip: str, keys: str = "") -> Action:
    return choosing(
        MENU, f"Handles: {name}", "outside.gizmo", kind, keys, "none", tip=tip,
        separated=kind == "move",
        can=lambda host: kind != "up" or host.state.options.outside.target is not None,
    )  # fmt: skip


def _axis(axis: str, name: str) -> Action:
    return Action(
        MENU,
        f"Look {name}",
        lambda host: host.view(OutsideView).look_along(host, axis),
        can=_is_drawn,
        separated=axis == "x",
    )


OUTSIDE = (
    _show("basis", "the basis vectors u, v, w at the eye, at their true lengths"),
    _show("image", "the live image on the image plane"),
    _show("grid", "the pixel grid on the image plane"),
    _show("volume", "the view volume: what the camera can see"),
    _show("ray", "the viewing ray of the marked pixel, or the one under the mouse"),
    Action(
        MENU,
        "Show formula",
        changing(_toggle_formula),
        is_on=_has_formula,
        tip="the marked pixel's ray, term by term: -dw, uu, vv",
    ),
    choosing(
        MENU, "Show bundle", "outside.bundle", BUNDLE, "B", (0, 0),
        tip="viewing rays spread over the image",
    ),
    _handles("move eye", "move", "handles that move the eye of the camera", "G"),
    _handles("turn basis", "turn", "handles that turn the basis of the camera", "T"),
    _handles("move plane", "distance", "a handle that moves the image plane: the distance d"),
    _handles("turn up", "up", "handles that turn the vector up, which makes the basis"),
    Action(
        MENU,
        "Fit all",
        lambda host: host.view(OutsideView).look(host, None),
        "Shift+H",
        is_on=lambda state: state.options.outside.camera is None,
        separated=True,
    ),
    Action(
        MENU,
        "Look from the camera",
        lambda host: host.view(OutsideView).look(host, host.renderers.camera(host.state)),
        "Shift+C",
    ),
    Action(
        MENU, "Parallel outside camera", _switch_projection, is_on=_is_parallel, can=_is_drawn
    ),
    *(_axis(axis, name) for axis, name in AXIS_NAMES.items()),
)  # fmt: skip
