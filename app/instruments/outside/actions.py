"""The outside view's actions: switches, handles and viewpoints.

The view's own menu and the Instruments menu have the same entries.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.app.state.app_state import AppState
from lucida.app.state.options.outside import STAGES
from lucida.app.ui.action import Action, changing, choosing

from .tools import MENU
from .view import OutsideView

BUNDLE = (4, 5)  # rows and columns of the bundle when it is switched on


def _toggle_formula(state: AppState) -> AppState:
    formula = None if _has_formula(state) else float(len(STAGES))
    return state.with_options(replace(state.options.outside, formula=formula))


def _has_formula(state: AppState) -> bool:
    return state.options.outside.formula is not None


def _show(name: str, tip: str) -> Action:
    return choosing(MENU, f"Show {name}", f"outside.{name}", True, off=False, tip=tip)


def _handles(name: str, kind: str, tip: str, keys: str) -> Action:
    return choosing(
        MENU, f"Handles: {name}", "outside.gizmo", kind, keys, "none", tip=tip,
        separated=kind == "move",
    )  # fmt: skip


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
)  # fmt: skip
