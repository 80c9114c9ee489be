"""The outside view's actions: its switches, its handles, from where it looks.

Owns their names and keys. What is switched is outside/switches.py's.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.instruments.outside.extent import around, framed, outside_camera, way_of
from lucida.app.instruments.outside.figure_view import Ground, export_figure
from lucida.app.instruments.outside.switches import (
    AXIS_NAMES,
    HANDLES,
    SWITCHES,
    Switch,
    handles,
    is_on,
    toggled,
    with_gizmo,
)
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.app_state import AppState
from lucida.app.state.options.outside import OutsideOptions
from lucida.app.ui.action import Action, changing
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.navigation import switched_projection
from lucida.renderer.system.errors import LucidaError

MENU, PICTURE = "View/Outside view", "File/Picture"
ASPECT = 1.4  # of a view along an axis: another one sees no less
KEYS = {"bundle": "B", "move": "G", "turn": "T"}


def _with(state: AppState, options: OutsideOptions) -> AppState:
    return state.with_options(options)


def _looking(window: Host) -> Camera:
    """Return the outside camera."""
    state, scope = window.state, window.view(OutsideView).scope
    if scope is not None:
        return scope.camera
    home = state.scene.view.for_size(window.renderers.size)
    points = around(window.focus.framed, home, window.renderers.camera(state))
    home = state.scene.view.camera
    return state.options.outside.camera or outside_camera(points, home, ASPECT)


def _look(window: Host, camera: Camera | None) -> None:
    """Look through a camera; None: through one that sees everything."""
    window.travel(window.state.with_options(replace(window.state.options.outside, camera=camera)))


def _sees_all(state: AppState) -> bool:
    return state.options.outside.camera is None


def _along(window: Host, axis: str) -> None:
    state = window.state
    points = around(window.focus.framed, window.renderers.camera(state))
    _look(window, framed(points, way_of(axis), ASPECT, _looking(window).projection))


def _switch_projection(window: Host) -> None:
    try:
        _look(window, switched_projection(_looking(window), window.focus.center))
    except LucidaError:  # beyond the numbers: the camera stays
        return


def _is_parallel(state: AppState) -> bool:
    camera = state.options.outside.camera
    return camera is not None and camera.is_parallel


def _shown(switch: Switch) -> Action:
    return Action(
        MENU,
        f"Show {switch.name}",
        changing(lambda state: _with(state, toggled(state.options.outside, switch.field))),
        KEYS.get(switch.field, ""),
        is_on=lambda state: is_on(state.options.outside, switch.field),
    )


def _handles(kind: str, name: str) -> Action:
    return Action(
        MENU,
        f"Handles: {name}",
        changing(lambda state: _with(state, with_gizmo(state.options.outside, kind))),
        KEYS.get(kind, ""),
        is_on=lambda state: state.options.outside.gizmo == kind,
        can=lambda window: kind in {k for k, *_ in handles(window.state.options.outside)},
        separated=kind == "move",
    )


def _axis(axis: str, name: str) -> Action:
    return Action(MENU, f"Look {name}", lambda window: _along(window, axis), separated=axis == "x")


OUTSIDE = (
    *(_shown(switch) for switch in SWITCHES),
    *(_handles(kind, name) for kind, name, _ in HANDLES),
    Action(
        MENU,
        "Fit all",
        lambda window: _look(window, None),
        "Shift+H",
        is_on=_sees_all,
        separated=True,
    ),
    Action(
        MENU,
        "Look from the camera",
        lambda window: _look(window, window.renderers.camera(window.state)),
        "Shift+C",
    ),
    Action(
        MENU,
        "Parallel outside camera",
        _switch_projection,
        is_on=_is_parallel,
    ),
    *(_axis(axis, name) for axis, name in AXIS_NAMES.items()),
)


def _figure(name: str, ground: Ground) -> Action:
    return Action(PICTURE, name, lambda window: export_figure(window, ground))


DIAGRAM = (
    Action(
        PICTURE,
        "Export figure as SVG...",
        lambda window: export_figure(window, "window"),
        "Ctrl+Shift+E",
        separated=True,
    ),
    _figure("Export figure as SVG on white...", "white"),
    _figure("Export figure as SVG without a ground...", "transparent"),
)
