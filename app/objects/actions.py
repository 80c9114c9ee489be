"""The actions of the scene's objects."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from app.cameras.focus import Focus
from app.host.action import CTRL, SHIFT, Action, Key, Window, changing
from app.objects import editing
from app.objects.choosing import chosen, everything
from app.objects.options import Handle, ObjectsOptions
from app.state.app_state import AppState
from renderer.errors import LucidaError
from renderer.scene_editing import objects

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


def _drops(state: AppState) -> AppState:
    other = "open" if state.of(ObjectsOptions).dropped == "add" else "add"
    return state.with_options(objects={"dropped": other})


def _along(state: AppState) -> AppState:
    other = "object" if state.of(ObjectsOptions).along == "world" else "world"
    return state.with_options(objects={"along": other})


def _snaps(state: AppState) -> AppState:
    return state.with_options(objects={"snaps": not state.of(ObjectsOptions).snaps})


def _editing(change: Callable[[AppState, Focus], AppState]) -> Callable[[Window], None]:
    """Return a function that runs an edit as an undo step, or reports why it is impossible."""

    def run(window: Window) -> None:
        try:
            window.change(change(window.state, window.focus))
        except LucidaError as error:
            window.files.message = str(error)

    return run


def _has_chosen(window: Window) -> bool:
    return bool(chosen(window.state))


def _copy(window: Window) -> None:
    imgui.set_clipboard_text(editing.copied(window.state))
    window.files.say("The chosen objects are in the clipboard, as in a scene file.")


def _adding(kind: str) -> Action:
    name = f"Add {kind} light" if kind in objects.LIGHTS else f"Add {kind}"
    return Action(
        "Scene/Add",
        name,
        _editing(lambda state, focus: editing.added(state, kind, focus)),
        separated=kind == objects.LIGHTS[0],
    )


SCENE = (
    *(_adding(kind) for kind in (*objects.SHAPES, *objects.LIGHTS)),
    Action("Scene/Add", "Add model...", lambda w: w.files.add_model_dialog(), separated=True),
    Action(
        MENU,
        "Duplicate",
        _editing(editing.duplicated),
        "Ctrl+D",
        (CTRL | int(Key.d),),
        can=_has_chosen,
        separated=True,
    ),
    Action(
        MENU,
        "Delete",
        _editing(lambda state, focus: editing.deleted(state)),
        "Delete",
        (int(Key.delete),),
        can=_has_chosen,
    ),
    Action(MENU, "Copy objects", _copy, "Ctrl+C", (CTRL | int(Key.c),), can=_has_chosen),
    Action(
        MENU,
        "Select all",
        lambda window: window.amend(everything(window.state)),
        "Ctrl+A",
        (CTRL | int(Key.a),),
        separated=True,
    ),
)

CHOOSING = (
    Action(
        MENU,
        "Select on click",
        changing(_selects),
        "V",
        (int(Key.v),),
        is_on=lambda state: state.of(ObjectsOptions).selects,
    ),
    Action(
        MENU,
        "Add dropped models to the scene",
        changing(_drops),
        is_on=lambda state: state.of(ObjectsOptions).dropped == "add",
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
