"""Actions: what a menu, a key or the command palette does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import imgui

from app.state.app_state import AppState
from app.ui.host import Host

Key = imgui.Key
CTRL, SHIFT, ALT = int(Key.mod_ctrl), int(Key.mod_shift), int(Key.mod_alt)


@dataclass(frozen=True)
class Action:
    """An action.

    menu: its menu, such as "View" or, for a submenu, "View/Pixels".
    keys, chords: alternative shortcuts, as displayed and in ImGui's form.
    is_on: for switches, the state.
    can: True if it is possible now.
    separated: draw a line above it.
    """

    menu: str
    name: str
    run: Callable[[Host], None]
    keys: str = ""
    chords: tuple[int, ...] = ()
    is_on: Callable[[AppState], bool] | None = None
    can: Callable[[Host], bool] | None = None
    separated: bool = False


def changing(change: Callable[[AppState], AppState]) -> Callable[[Host], None]:
    """Return a function that applies a change to the state, as a separate undo step."""
    return lambda window: window.change(change(window.state))
