"""The selection: by clicks, in the list, from one to the next."""

from __future__ import annotations

import pytest
from option_changes import with_options
from scenes import crowd

from lucida.app.instruments.objects.choosing import (
    choose,
    choose_also,
    chosen,
    item_at,
    picked,
    rows_of,
    walked,
)
from lucida.app.instruments.objects.editing import with_scene
from lucida.app.state.app_state import AppState, History
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import set_field
from lucida.renderer.files import load_scene
from lucida.renderer.scene.model import Mesh


@pytest.fixture
def state() -> AppState:
    return AppState.for_scene(load_scene("still-life"))


def items_of(state: AppState) -> list[int]:
    return [row.item for row in rows_of(state.scene) if row.item is not None]


def test_a_click_selects_only_the_object_under_it(state):
    row = rows_of(state.scene)[1]
    after = picked(state, row.ids[0], more=False)
    assert chosen(after) == (row.item,)
    first = rows_of(state.scene)[0]
    assert chosen(picked(after, first.ids[0], more=False)) == (first.item,)


def test_shift_adds_and_removes(state):
    first, second = items_of(state)[:2]
    both = choose_also(choose(state, (first,)), second)
    assert chosen(both) == (first, second)
    assert chosen(choose_also(both, first)) == (second,)
    assert picked(both, None, more=True) is both  # the background


def test_a_locked_object_cannot_be_clicked(state):
    row = rows_of(state.scene)[0]
    locked = with_scene(state, set_field(state.scene, [row.item], "locked", True))
    assert chosen(picked(locked, row.ids[0], more=False)) == ()


@pytest.mark.parametrize("field", ["locked", "hidden"])
def test_the_selection_skips_locked_and_hidden_objects(state, field):
    first, second = items_of(state)[:2]
    changed = with_scene(state, set_field(state.scene, [first], field, True))
    assert chosen(walked(changed, 1)) == (second,)


def test_the_selection_goes_round_the_list_both_ways(state):
    items, visited = items_of(state), []
    assert chosen(state) == ()
    assert chosen(walked(state, -1)) == (items[-1],)
    for _ in range(len(items) + 1):
        state = walked(state, 1)
        visited += chosen(state)
    assert visited == [*items, items[0]]
    assert chosen(walked(state, -1)) == (items[-1],)
    assert chosen(walked(choose(state, items[:2]), 1)) == (items[2],)


def test_a_deleted_object_is_deselected_until_undo(state):
    items = items_of(state)
    both = choose(state, items[:2])
    history = History(both).change(with_scene(both, objects.delete(both.scene, [items[0]])))
    assert chosen(history.present) == (items[1],)
    assert chosen(history.undo().present) == tuple(items[:2])


def test_a_scene_made_in_python_has_no_selection():
    scene = crowd()
    assert any(isinstance(entry.shape, Mesh) for entry in scene.objects)
    state = with_options(AppState.for_scene(scene), objects={"chosen": (0, 1)})
    assert chosen(state) == ()
    assert item_at(scene, 0) is None
    assert chosen(walked(state, 1)) == ()
    assert {row.item for row in rows_of(scene)} == {None}
