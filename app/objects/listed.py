"""The list of objects: its state between frames, and its requests.

Pure. outliner.py draws the list, outliner_row.py one line.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from app.objects.choosing import chosen
from app.state.app_state import AppState
from renderer.errors import LucidaError
from renderer.scene_editing.changing import Item
from renderer.scene_editing.outline import ModelPart, OutlineRow


@dataclass(frozen=True)
class Outliner:
    """The list's state between frames.

    words: of the search.
    renamed: the item whose name is being typed, and the name.
    begun: its field was drawn already.
    anchor: the start of a range of rows.
    opened: models whose parts are listed.
    seen: the last selection that the list has scrolled to.
    """

    words: str = ""
    renamed: tuple[Item, str] | None = None
    begun: bool = False
    anchor: Item | None = None
    opened: frozenset[Item] = frozenset()
    seen: Item | None = None


@dataclass(frozen=True)
class ListLine:
    """A line: an object or a light, or one part of the model in the line above."""

    row: OutlineRow
    part: ModelPart | None = None


@dataclass(frozen=True)
class Listed:
    """The list in one frame, and the requests from it.

    state: as given.
    rows: those that it shows.
    changed: the state after edits.
    chosen: the state with another selection, no undo step; None for none.
    problem: the reason why an edit was impossible.
    framed: the item to frame with the camera.
    model: ask for a model's file.
    """

    outliner: Outliner
    state: AppState
    rows: Sequence[OutlineRow] = ()
    items: frozenset[Item] = field(default_factory=frozenset)
    changed: AppState | None = None
    chosen: AppState | None = None
    problem: str = ""
    framed: Item | None = None
    model: bool = False

    @classmethod
    def of(cls, outliner: Outliner, state: AppState) -> Listed:
        """Return the list at the start of a frame."""
        return cls(outliner, state, items=frozenset(chosen(state)))

    def but(self, **changes: Any) -> Listed:
        return replace(self, **changes)

    def keeping(self, **changes: Any) -> Listed:
        """Return this with other values kept for the next frame."""
        return replace(self, outliner=replace(self.outliner, **changes))

    def renaming(self, row: OutlineRow) -> Listed:
        """Return this with a name to be typed."""
        return self.keeping(renamed=(row.item, row.name), begun=False)

    def tried(self, edit: Callable[[], AppState]) -> Listed:
        """Return this with an edit, or with the reason why it is impossible."""
        try:
            return replace(self, changed=edit())
        except LucidaError as error:
            return replace(self, problem=str(error))

    def meant(self, item: Item) -> tuple[Item, ...]:
        """Return the items that a switch in a line acts on: the whole selection, if the line is in
        it.
        """
        return chosen(self.state) if item in self.items else (item,)


def lines_of(rows: Sequence[OutlineRow], opened: frozenset[Item]) -> list[ListLine]:
    """Return the list's lines, all equally high."""
    lines = []
    for row in rows:
        lines.append(ListLine(row))
        if row.item in opened:
            lines += [ListLine(row, part) for part in row.parts]
    return lines


def scroll_to(line: int, height: float, scrolled: float, room: float) -> float:
    """Return the least scrolling that makes a line visible.

    height: of a line; scrolled, room: the present scrolling, and the visible height.
    """
    top = line * height
    return min(max(scrolled, top + height - room), top)
