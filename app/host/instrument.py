"""What a room gives the window: its views, its actions, words for both.

A room's instrument.py has one value of it, INSTRUMENT. Which rooms there are, and their options,
is app/instruments.py's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from app.host.action import Action
from app.host.view import DockedView


@dataclass(frozen=True)
class Instrument:
    """make: makes its views, given those of the rooms before it; the list goes on growing.

    actions: for menus, keys and the palette, in the order of the menus. synonyms: what people also
    call its actions and views, by names of actions and titles of views.

    For the shortcut sheet, beside the actions' keys. mouse, keyboard: rows of what these do in its
    views. heading: of its actions' keys where these hold in its view only; empty: they stand with
    the others of their menus.
    """

    make: Callable[[Sequence[DockedView]], Sequence[DockedView]]
    actions: tuple[Action, ...] = ()
    mouse: tuple[tuple[str, str], ...] = ()
    keyboard: tuple[tuple[str, str], ...] = ()
    heading: str = ""
    synonyms: Mapping[str, str] = field(default_factory=dict)
