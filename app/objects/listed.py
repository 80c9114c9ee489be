"""What the list of objects keeps from frame to frame, and what has been done in it.

Pure. The list is drawn by outliner.py, a line of it by outliner_row.py.
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
    """What the list keeps. words: of the search. renamed: the item whose name is being typed, and
    the name; begun: whether its field was drawn already. anchor: where a range of rows begins.
    opened: models whose parts are listed. seen: the last chosen that the list has moved to."""

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
    """state: as the list was given it; rows: what it shows of it. changed: the state after edits;
    chosen: with another choice, no step of undo; None for none. problem: why an edit was not
    possible. framed: the item that the camera is to go to. model: whether a model's file is to be
    chosen."""

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
        """items: what is chosen."""
        return cls(outliner, state, items=frozenset(chosen(state)))

    def but(self, **changes: Any) -> Listed:
        return replace(self, **changes)

    def keeping(self, **changes: Any) -> Listed:
        """With something else kept for the next frame."""
        return replace(self, outliner=replace(self.outliner, **changes))

    def renaming(self, row: OutlineRow) -> Listed:
        """With a name to be typed."""
        return self.keeping(renamed=(row.item, row.name), begun=False)

    def tried(self, edit: Callable[[], AppState]) -> Listed:
        """With an edit, or why it is not possible."""
        try:
            return replace(self, changed=edit())
        except LucidaError as error:
            return replace(self, problem=str(error))

    def meant(self, item: Item) -> tuple[Item, ...]:
        """What a switch in an item's line is for: all that is chosen, if that is."""
        return chosen(self.state) if item in self.items else (item,)


def lines_of(rows: Sequence[OutlineRow], opened: frozenset[Item]) -> list[ListLine]:
    """The list's lines, all equally high."""
    lines = []
    for row in rows:
        lines.append(ListLine(row))
        if row.item in opened:
            lines += [ListLine(row, part) for part in row.parts]
    return lines


def scroll_to(line: int, height: float, scrolled: float, room: float) -> float:
    """How far a list is to be scrolled so that a line is seen, by as little as can be. height: of a
    line; scrolled, room: how far it is now, and what is seen of it."""
    top = line * height
    return min(max(scrolled, top + height - room), top)
