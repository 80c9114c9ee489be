"""Actions: what a menu, a key or the command palette does."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import imgui

from lucida.app.state.app_state import AppState
from lucida.app.ui.host import Host

Key = imgui.Key
# The keys of a sign. Plus is typed with Shift on many keyboards.
_KEYS = {
    "+": (Key.equal, int(Key.mod_shift) | int(Key.equal), Key.keypad_add),
    "-": (Key.minus, Key.keypad_subtract),
    "0": (Key._0, Key.keypad0),
    ",": (Key.comma,),
    ".": (Key.period,),
    "/": (Key.slash,),
    "[": (Key.left_bracket,),
    "]": (Key.right_bracket,),
}


@dataclass(frozen=True)
class Action:
    """An action.

    menu: its menu, such as "View" or, for a submenu, "View/Pixels".
    keys: its shortcuts, as displayed: "Ctrl+S", or "Home, H" for two.
    more_keys: further ones, which are not displayed.
    binds: False if the keys are only displayed, and its view reads them.
    is_on: for switches, the state.
    can: True if it is possible now.
    separated: draw a line above it.
    """

    menu: str
    name: str
    run: Callable[[Host], None]
    keys: str = ""
    more_keys: str = ""
    binds: bool = True
    is_on: Callable[[AppState], bool] | None = None
    can: Callable[[Host], bool] | None = None
    separated: bool = False

    @property
    def chords(self) -> tuple[int, ...]:
        """Its shortcuts in ImGui's form."""
        return chords_of(self.keys) + chords_of(self.more_keys) if self.binds else ()


def chords_of(keys: str) -> tuple[int, ...]:
    """Return the chords of shortcuts as displayed, in ImGui's form."""
    chords: list[int] = []
    for shortcut in keys.split(", ") if keys else ():
        *modifiers, name = re.split(r"(?<=\w)\+", shortcut)
        held = sum(int(getattr(Key, f"mod_{modifier.lower()}")) for modifier in modifiers)
        chords += (held | int(key) for key in _KEYS.get(name) or (getattr(Key, _name(name)),))
    return tuple(chords)


def _name(name: str) -> str:
    """Return ImGui's name of a key: page_down, keypad7, _1."""
    name = name.lower().replace("keypad ", "keypad").replace(" ", "_")
    return f"_{name}" if name.isdigit() else name


def changing(change: Callable[[AppState], AppState]) -> Callable[[Host], None]:
    """Return a function that applies a change to the state, as a separate undo step."""
    return lambda window: window.change(change(window.state))
