"""The actions of the scene's objects."""

from __future__ import annotations

from app.host.action import SHIFT, Action, Key, changing
from app.objects.options import Handle, ObjectsOptions
from app.state.app_state import AppState

MENU, HANDLES = "Scene", "Scene/Handles"
_HANDLES: tuple[tuple[Handle, str, str, Key], ...] = (
    ("move", "Objects: move", "Shift+G", Key.g),
    ("turn", "Objects: turn", "Shift+T", Key.t),
    ("scale", "Objects: scale", "Shift+L", Key.l),
)


def _toggled_handle(kind: Handle, state: AppState) -> AppState:
    other = "none" if state.of(ObjectsOptions).handle == kind else kind
    return state.with_options(objects={"handle": other})


def _handle(kind: Handle, name: str, keys: str, key: Key) -> Action:
    return Action(
        HANDLES,
        name,
        changing(lambda state: _toggled_handle(kind, state)),
        keys,
        (SHIFT | int(key),),
        is_on=lambda state: state.of(ObjectsOptions).handle == kind,
    )


def _selects(state: AppState) -> AppState:
    return state.with_options(objects={"selects": not state.of(ObjectsOptions).selects})


def _along(state: AppState) -> AppState:
    other = "object" if state.of(ObjectsOptions).along == "world" else "world"
    return state.with_options(objects={"along": other})


def _snaps(state: AppState) -> AppState:
    return state.with_options(objects={"snaps": not state.of(ObjectsOptions).snaps})


CHOOSING = (
    Action(
        MENU,
        "Clicks choose objects",
        changing(_selects),
        "V",
        (int(Key.v),),
        is_on=lambda state: state.of(ObjectsOptions).selects,
    ),
    *(_handle(*entry) for entry in _HANDLES),
    Action(
        HANDLES,
        "Along the object's own axes",
        changing(_along),
        is_on=lambda state: state.of(ObjectsOptions).along == "object",
        separated=True,
    ),
    Action(
        HANDLES,
        "In steps",
        changing(_snaps),
        is_on=lambda state: state.of(ObjectsOptions).snaps,
    ),
)
