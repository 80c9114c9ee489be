"""The selection: by a click, in the list, from one item to the next.

Pure. The selection is in the state, but is not an undo step: amend the state to change it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import lru_cache

from lucida.app.state.app_state import AppState
from lucida.app.state.options.objects import MOST_CHOSEN
from lucida.renderer.editing.changing import Item, present
from lucida.renderer.editing.outline import OutlineRow, outline
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError


def chosen(state: AppState) -> tuple[Item, ...]:
    """Return the selected items that exist in the scene; the last one is the active one."""
    items = state.options.objects.chosen
    return _there(state.scene, items) if items else ()


@lru_cache(maxsize=1)
def _there(scene: Scene, items: tuple[Item, ...]) -> tuple[Item, ...]:
    try:
        return present(scene, items)
    except LucidaError:  # a scene made in Python cannot be edited
        return ()


def unlocked(state: AppState) -> tuple[Item, ...]:
    """Return the selected items that are not locked."""
    items = chosen(state)
    return _movable(state.scene, items) if items else ()


@lru_cache(maxsize=1)
def _movable(scene: Scene, items: tuple[Item, ...]) -> tuple[Item, ...]:
    locked = {row.item for row in rows_of(scene) if row.locked}
    return tuple(item for item in items if item not in locked)


def choose(state: AppState, items: Iterable[Item]) -> AppState:
    """Return the state with only these items selected."""
    found = tuple(dict.fromkeys(items))[-MOST_CHOSEN:]
    if found == state.options.objects.chosen:
        return state
    return state.with_options(replace(state.options.objects, chosen=found))


def choose_also(state: AppState, item: Item) -> AppState:
    """Return the state with an item added to the selection, or removed if it was there."""
    before = chosen(state)
    rest = tuple(other for other in before if other != item)
    return choose(state, rest if item in before else (*rest, item))


def picked(state: AppState, number: int | None, more: bool) -> AppState:
    """Return the state after a click on an object of the id image, None for the background.

    Locked objects count as background. more: extend the selection.
    """
    item = item_at(state.scene, number)
    if item is None:
        return state if more else choose(state, ())
    return choose_also(state, item) if more else choose(state, (item,))


def item_at(scene: Scene, number: int | None) -> Item | None:
    """Return the item of an object in the id image; None if it cannot be selected by a click."""
    if number is None:
        return None
    row = next((row for row in rows_of(scene) if number in row.ids), None)
    return row.item if row is not None and not row.locked else None


def walked(state: AppState, step: int) -> AppState:
    """Return the state with the next object or light selected (step 1), or the previous one (-1),
    in the list's order. Hidden and locked items are skipped.
    """
    items = _free(state.scene)
    if not items:
        return choose(state, ())
    now = chosen(state)
    at = items.index(now[-1]) if now and now[-1] in items else (-1 if step > 0 else 0)
    return choose(state, (items[(at + step) % len(items)],))


def everything(state: AppState) -> AppState:
    """Return the state with everything selected that is neither hidden nor locked."""
    return choose(state, _free(state.scene))


def _free(scene: Scene) -> list[Item]:
    """Return the items that are neither hidden nor locked, in the list's order."""
    rows = [row for row in rows_of(scene) if not (row.hidden or row.locked)]
    return [row.item for row in rows if row.item is not None]


@lru_cache(maxsize=1)
def rows_of(scene: Scene) -> tuple[OutlineRow, ...]:
    """Return outline(), cached for the last scene, because it is called in each frame."""
    return outline(scene)
