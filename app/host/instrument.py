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

    actions: for menus, keys and the palette, in the order of the menus. mouse: what the mouse does,
    rows of the shortcut sheet. synonyms: what people also call its actions and views, by names
    of actions and titles of views.
    """

    make: Callable[[Sequence[DockedView]], Sequence[DockedView]]
    actions: tuple[Action, ...] = ()
    mouse: tuple[tuple[str, str], ...] = ()
    synonyms: Mapping[str, str] = field(default_factory=dict)
