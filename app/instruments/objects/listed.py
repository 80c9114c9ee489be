"""The list of objects: its state between frames, and its requests.

Pure. outliner.py draws the list.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from lucida.app.instruments.objects.choosing import chosen
from lucida.app.state.app_state import AppState
from lucida.renderer.editing.changing import Item
from lucida.renderer.editing.outline import OutlineRow
from lucida.renderer.system.errors import LucidaError


@dataclass(frozen=True)
class Outliner:
    """The list's state between frames.

    words: the text of the search.
    anchor: the start of a range of rows.
    seen: the last selection that the list has scrolled to.
    """

    words: str = ""
    anchor: Item | None = None
    seen: Item | None = None


@dataclass(frozen=True)
class Listed:
    """The list in one frame, and the requests from it.

    rows: the rows that match the search.
    changed: the state after edits.
    chosen: the state with another selection, no undo step; None for none.
    problem: the reason why an edit was impossible.
    model: ask for a model's file.
    """

    outliner: Outliner
    state: AppState
    rows: Sequence[OutlineRow] = ()
    changed: AppState | None = None
    chosen: AppState | None = None
    problem: str = ""
    model: bool = False

    def but(self, **changes: Any) -> Listed:
        return replace(self, **changes)

    def keeping(self, **changes: Any) -> Listed:
        """Return this with other values kept for the next frame."""
        return replace(self, outliner=replace(self.outliner, **changes))

    def tried(self, edit: Callable[[], AppState]) -> Listed:
        """Return this with an edit, or with the reason why it is impossible."""
        try:
            return replace(self, changed=edit())
        except LucidaError as error:
            return replace(self, problem=str(error))

    def acted_on(self, item: Item) -> tuple[Item, ...]:
        """Return the items that a row's checkbox changes: the selection, if the row is in it."""
        items = chosen(self.state)
        return items if item in items else (item,)


def scroll_to(line: int, height: float, scrolled: float, room: float) -> float:
    """Return the least scrolling that makes a line visible.

    height: of a line; scrolled, room: the present scrolling, and the visible height.
    """
    top = line * height
    return min(max(scrolled, top + height - room), top)
