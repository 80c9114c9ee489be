"""Actions: what a menu, a key or the command palette does, and what an action may ask of the
window.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from imgui_bundle import imgui

from app.state.app_state import AppState
from app.ui.stage import Stage
from app.ui.toasts import Toasts
from app.ui.view import AView, Host

Key = imgui.Key
CTRL, SHIFT, ALT = int(Key.mod_ctrl), int(Key.mod_shift), int(Key.mod_alt)


class Around(Protocol):
    """The parts of the window around the views, for actions."""

    @property
    def stage(self) -> Stage: ...
    @property
    def toasts(self) -> Toasts: ...
    def toggle_palette(self) -> None: ...
    def toggle_help(self) -> None: ...
    def toggle_full_screen(self) -> None: ...
    def picture(self, view: bool = False, copy: bool = False) -> None: ...
    def picture_as(self, view: bool = False) -> None: ...
    def export_as(self, host: Host) -> None: ...


class Window(Host, Protocol):
    """The window for actions, which may ask more than views. shell: the parts around the views."""

    @property
    def present(self) -> AppState:
        """The current state, without a movement to it."""

    def focus_object(self) -> None: ...
    def undo(self) -> None: ...
    def redo(self) -> None: ...
    def can_undo(self) -> bool: ...
    def can_redo(self) -> bool: ...
    @property
    def shell(self) -> Around: ...
    def view(self, kind: type[AView]) -> AView:
        """Return the window's view of a class."""

    def ask_pixel(self) -> None: ...
    def close_boxes(self) -> bool: ...
    def retry(self) -> None: ...
    def quit(self) -> None: ...
    def save_scene(self) -> None: ...
    def save_scene_as(self) -> None: ...
    def save_scene_with_view(self) -> None: ...


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
    run: Callable[[Window], None]
    keys: str = ""
    chords: tuple[int, ...] = ()
    is_on: Callable[[AppState], bool] | None = None
    can: Callable[[Window], bool] | None = None
    separated: bool = False


def changing(change: Callable[[AppState], AppState]) -> Callable[[Window], None]:
    """Return a function that applies a change to the state, as a separate undo step."""
    return lambda window: window.change(change(window.state))
