"""The contribution of an instrument to the window: its views, its actions, words for both.

An instrument's instrument.py has one such value, INSTRUMENT; app/window/instruments.py lists them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from app.ui.action import Action
from app.ui.view import DockedView


@dataclass(frozen=True)
class Instrument:
    """An instrument.

    make: makes its views, given those of the instruments before it; the list grows later.
    actions: for menus, keys and the palette, in the order of the menus.
    synonyms: other names that people use, by the names of actions, pages and views.
    pages: what the palette finds in its view, by name: the options that show it.
    mouse, keyboard: further rows for the shortcut sheet, on its views.
    heading: of its actions' keys on the sheet, if they work in its view only; if empty, they are
    listed with the others of their menus.
    """

    make: Callable[[Sequence[DockedView]], Sequence[DockedView]]
    actions: tuple[Action, ...] = ()
    mouse: tuple[tuple[str, str], ...] = ()
    keyboard: tuple[tuple[str, str], ...] = ()
    heading: str = ""
    synonyms: Mapping[str, str] = field(default_factory=dict)
    pages: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
