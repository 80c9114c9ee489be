"""What is chosen: by a click, in the list, from one to the next.

Pure. What is chosen is in the state, but is no step of undo: whoever changes it amends the state.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from app.objects.options import MOST_CHOSEN, ObjectsOptions
from app.state.app_state import AppState
from renderer.errors import LucidaError
from renderer.scene.model import Scene
from renderer.scene_editing.changing import Item, present
from renderer.scene_editing.outline import OutlineRow, outline


def chosen(state: AppState) -> tuple[Item, ...]:
    """The chosen items that the scene has; the last one is the one in hand."""
    items = state.of(ObjectsOptions).chosen
    return _there(state.scene, items) if items else ()


@lru_cache(maxsize=1)
def _there(scene: Scene, items: tuple[Item, ...]) -> tuple[Item, ...]:
    try:
        return present(scene, items)
    except LucidaError:  # made in Python: it cannot be edited
        return ()


def unlocked(state: AppState) -> tuple[Item, ...]:
    """What is chosen, without what is locked."""
    items = chosen(state)
    return _movable(state.scene, items) if items else ()


@lru_cache(maxsize=1)
def _movable(scene: Scene, items: tuple[Item, ...]) -> tuple[Item, ...]:
    locked = {row.item for row in rows_of(scene) if row.locked}
    return tuple(item for item in items if item not in locked)


def choose(state: AppState, items: Iterable[Item]) -> AppState:
    """The state with these chosen, and no others."""
    found = tuple(dict.fromkeys(items))[-MOST_CHOSEN:]
    if found == state.of(ObjectsOptions).chosen:
        return state
    return state.with_options(objects={"chosen": found})


def choose_also(state: AppState, item: Item) -> AppState:
    """The state with one more chosen, or one less where it was."""
    before = chosen(state)
    rest = tuple(other for other in before if other != item)
    return choose(state, rest if item in before else (*rest, item))


def picked(state: AppState, number: int | None, more: bool) -> AppState:
    """The state after a click on an object of the id image, None for the background; what is locked
    is as if it were background. more: with those that are chosen already."""
    item = item_at(state.scene, number)
    if item is None:
        return state if more else choose(state, ())
    return choose_also(state, item) if more else choose(state, (item,))


def item_at(scene: Scene, number: int | None) -> Item | None:
    """What a click on an object of the id image means; None for what cannot be chosen by one."""
    if number is None:
        return None
    row = next((row for row in rows_of(scene) if number in row.ids), None)
    return row.item if row is not None and not row.locked else None


def walked(state: AppState, step: int) -> AppState:
    """The state with the next object or light chosen (step 1), or the one before (-1), in the
    list's order; hidden and locked ones are passed over."""
    items = _free(state.scene)
    if not items:
        return choose(state, ())
    now = chosen(state)
    at = items.index(now[-1]) if now and now[-1] in items else (-1 if step > 0 else 0)
    return choose(state, (items[(at + step) % len(items)],))


def everything(state: AppState) -> AppState:
    """The state with all chosen that is neither hidden nor locked."""
    return choose(state, _free(state.scene))


def _free(scene: Scene) -> list[Item]:
    """What is neither hidden nor locked, in the list's order."""
    rows = [row for row in rows_of(scene) if not (row.hidden or row.locked)]
    return [row.item for row in rows if row.item is not None]


@lru_cache(maxsize=1)
def rows_of(scene: Scene) -> tuple[OutlineRow, ...]:
    """outline(), kept for the last scene: asked in each frame, as are those above."""
    return outline(scene)
