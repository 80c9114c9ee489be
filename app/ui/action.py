"""Actions that menus and keys run."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from imgui_bundle import imgui

from lucida.app.state.app_state import AppState
from lucida.app.state.options import Options

from . import theme
from .host import Host

Key = imgui.Key
# The keys that type each character. Plus needs Shift on many keyboards.
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
    more_keys: further shortcuts, which are not displayed.
    binds: False if the keys are only displayed because a view reads them itself.
    is_on: returns the state of a switch.
    can: returns True if the action is possible now.
    separated: True to draw a line above it.
    tip: the tooltip of its entry in a menu, or a line below it.
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
    tip: str = ""

    @property
    def chords(self) -> tuple[int, ...]:
        """Its shortcuts in ImGui's form."""
        return chords_of(self.keys) + chords_of(self.more_keys) if self.binds else ()


def chords_of(keys: str) -> tuple[int, ...]:
    """Convert displayed shortcuts to ImGui's key chords."""
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


def choosing(
    menu: str,
    name: str,
    option: str,
    value: object,
    keys: str = "",
    off: object = None,
    **more: Any,
) -> Action:
    """Return the action that sets an option to a value.

    option: its path, such as "shadows" or "images.channel". off: the value to set if the option
    already has `value`; None to leave it. more: further fields of the action.
    """
    part, _, field = option.rpartition(".")

    def current(options: Options) -> object:
        return getattr(getattr(options, part) if part else options, field)

    def is_on(state: AppState) -> bool:
        return current(state.options) == value

    def change(state: AppState) -> AppState:
        new = {field: off if off is not None and is_on(state) else value}
        return state.with_options(state.options.with_changes({part: new} if part else new))

    current(Options())  # report a wrong name at the start, not on first use
    return Action(menu, name, changing(change), keys, is_on=is_on, **more)


def draw_entry(action: Action, host: Host, first: bool = False, below: bool = False) -> None:
    """Draw an action as an entry of the current menu.

    first: True to omit the line above it. below: True to draw its tip as a line below it.
    """
    if action.separated and not first:
        imgui.separator()
    on = action.is_on(host.state) if action.is_on else False
    can = action.can(host) if action.can else True
    if imgui.menu_item(action.name, action.keys, on, can)[0]:
        action.run(host)
    if action.tip and below:
        imgui.text_colored(theme.DIM, f"    {action.tip}")
    elif action.tip:
        imgui.set_item_tooltip(action.tip)
