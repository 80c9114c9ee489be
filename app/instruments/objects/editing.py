"""Edits of the scene: each takes a state and returns another one.

Pure. renderer/editing/ changes the scene; this module updates the selection. Edits raise
LucidaError if they are impossible; the old state stays unchanged.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from lucida.app.state.app_state import AppState
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import Item
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.model import Scene

from .choosing import choose, chosen, unlocked
from .placing import place_for


def with_scene(state: AppState, scene: Scene, items: Sequence[Item] | None = None) -> AppState:
    """Return the state with an edited scene, and the same view. items: the new selection."""
    changed = replace(state, scene=scene)
    return changed if items is None else choose(changed, items)


def added(state: AppState, kind: str, focus: Focus) -> AppState:
    """Return the state with a new, selected object or light in the picture."""
    if kind == "directional":  # it has no place
        table = objects.new_table(state.scene, kind)
        return with_scene(state, *objects.add(state.scene, table))
    place = place_for(focus, state.camera, kind in objects.LIGHTS)
    power = math.floor(math.log10(place.size))
    size = math.floor(2 * place.size / 10**power) / 2 * 10**power  # round down to 1, 1.5, 2, ...
    at = [round(x, 2 - power) for x in place.at]
    table = objects.new_table(state.scene, kind, at, size)
    return with_scene(state, *objects.add(state.scene, table))


def rounded(length: float) -> float:
    """Round a length to one digit, so that it is easy to read."""
    return float(f"{length:.1g}")


def deleted(state: AppState) -> AppState:
    """Return the state without the selection; locked items stay."""
    items = unlocked(state)
    return with_scene(state, objects.delete(state.scene, items), ()) if items else state


def duplicated(state: AppState, focus: Focus) -> AppState:
    """Add a copy of the selection next to it, and select it."""
    items = chosen(state)
    if not items:
        return state
    by = (rounded(0.1 * focus.reach), 0.0, 0.0)
    return with_scene(state, *objects.duplicate(state.scene, items, by))


def hidden(state: AppState, item: Item, is_hidden: bool) -> AppState:
    """Return the state with an item hidden or shown, or the whole selection if it is in it."""
    items = chosen(state)
    items = items if item in items else (item,)
    return with_scene(state, objects.hide(state.scene, items, is_hidden))
