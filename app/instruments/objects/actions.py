"""The actions of the scene's objects."""

from __future__ import annotations

from collections.abc import Callable

from lucida.app.state.app_state import AppState
from lucida.app.ui.action import Action, choosing
from lucida.app.ui.host import Host
from lucida.renderer.editing import objects
from lucida.renderer.system.errors import LucidaError

from . import editing
from .choosing import chosen, everything, walked

MENU = "Scene"


def _toggle(name: str, field: str, on: object, off: object, keys: str) -> Action:
    """Return the action that switches an option of objects between two values."""
    return choosing(MENU, name, f"objects.{field}", on, keys, off)


def edit(window: Host, change: Callable[[AppState], AppState]) -> None:
    """Edit the scene as an undo step, or report why it is impossible."""
    try:
        window.change(change(window.state))
    except LucidaError as error:
        window.files.message = str(error)


def _has_chosen(window: Host) -> bool:
    return bool(chosen(window.state))


def _walking(step: int) -> Callable[[Host], None]:
    return lambda window: window.amend(walked(window.state, step))


def _adding(kind: str) -> Action:
    name = f"Add {kind} light" if kind in objects.LIGHTS else f"Add {kind}"
    return Action(
        "Scene/Add",
        name,
        lambda w: edit(w, lambda state: editing.added(state, kind, w.focus)),
        separated=kind == objects.LIGHTS[0],
    )


ADDING = (
    *(_adding(kind) for kind in (*objects.SHAPES, *objects.LIGHTS)),
    Action("Scene/Add", "Add model...", lambda w: w.files.add_model_dialog(), separated=True),
)
SCENE = (
    *ADDING,
    Action(
        MENU,
        "Duplicate",
        lambda w: edit(w, lambda state: editing.duplicated(state, w.focus)),
        "Ctrl+D",
        can=_has_chosen,
        separated=True,
    ),
    Action(
        MENU,
        "Delete",
        lambda w: edit(w, editing.deleted),
        "Delete",
        can=_has_chosen,
    ),
    Action(
        MENU,
        "Select all",
        lambda window: window.amend(everything(window.state)),
        "Ctrl+A",
        separated=True,
    ),
    Action(MENU, "Select next object", _walking(1), "."),
    Action(MENU, "Select previous object", _walking(-1), ","),
)

CHOOSING = (
    _toggle("Select on click", "selects", True, False, "V"),
    _toggle("Handles to move", "handle", "move", "none", "Shift+G"),
)
