"""Edits of a scene, as functions from a state to another."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from lucida.app.instruments.objects import editing
from lucida.app.instruments.objects.choosing import choose, chosen, rows_of, unlocked
from lucida.app.instruments.objects.outliner import scroll_to
from lucida.app.instruments.objects.placing import place_for
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.navigation import switched_projection
from lucida.renderer.editing.changing import set_field, table_of
from lucida.renderer.editing.moving import bounds_of
from lucida.renderer.files import SCENE_NAMES, load_scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import Scene


@pytest.fixture
def state() -> AppState:
    return AppState.for_scene(load_scene("still-life"))


def items_of(state: AppState) -> list[int]:
    return [row.item for row in rows_of(state.scene) if row.item is not None]


@pytest.mark.parametrize("name", SCENE_NAMES)
@pytest.mark.parametrize("kind", ["sphere", "box", "point"])
def test_an_added_object_is_in_the_picture(name, kind):
    """Its size suits the scene's: from 2 to 50 %."""
    state = AppState.for_scene(load_scene(name))
    focus = scene_focus(state.scene)
    after = editing.added(state, kind, focus)
    low, high = bounds_of(after.scene, chosen(after))
    corners = np.array(list(product(*zip(low, high, strict=True))))
    row, column, parameter = after.camera.project(corners, (1, 1))
    assert (parameter > 0).all()
    assert (np.abs([row, column]) < 0.5).all(), (row, column)
    assert (row.mean() < -0.3) == (kind == "point")  # lights are above
    if focus.framed.size and kind != "point":
        assert 0.02 < np.ptp(corners, axis=0).max() / np.ptp(focus.framed, axis=0).max() < 0.5


def test_an_object_can_be_added_to_an_empty_scene():
    state = AppState.for_scene(Scene(objects=()))
    after = editing.added(state, "sphere", scene_focus(state.scene))
    assert len(after.scene.objects) == 1


def test_a_locked_object_is_not_deleted(state):
    first, second = items_of(state)[:2]
    scene = set_field(state.scene, [first], "locked", True)
    state = choose(editing.with_scene(state, scene), (first, second))
    assert unlocked(state) == (second,)
    after = editing.deleted(state)
    assert first in items_of(after)
    assert second not in items_of(after)
    only = choose(state, (first,))
    assert editing.deleted(only) is only


def test_deleting_or_duplicating_nothing_changes_nothing(state):
    assert editing.deleted(state) is state
    assert editing.duplicated(state, scene_focus(state.scene)) is state


def test_a_copy_stands_to_the_right_and_is_selected(state):
    item = items_of(state)[0]
    after = editing.duplicated(choose(state, (item,)), scene_focus(state.scene))
    (copy,) = chosen(after)
    assert copy != item
    by = (bounds_of(after.scene, [copy]) - bounds_of(after.scene, [item]))[0]
    assert by[0] > 0
    assert np.allclose(by[1:], 0)


def test_hiding_a_row_hides_the_selection_if_the_row_is_in_it(state):
    first, second, third = items_of(state)[:3]
    both = choose(state, (first, second))
    for item, hidden in ((first, {first, second}), (third, {third})):
        after = editing.hidden(both, item, True)
        assert {row.item for row in rows_of(after.scene) if row.hidden} == hidden


@pytest.mark.parametrize(
    ("line", "scrolled", "after"),
    [(0, 0, 0), (4, 0, 0), (5, 0, 20), (30, 0, 520), (2, 100, 40), (7, 100, 100)],
)
def test_a_list_is_scrolled_by_as_little_as_a_line_needs(line, scrolled, after):
    assert scroll_to(line, 20.0, scrolled, 100.0) == after


@pytest.mark.parametrize("is_light", [False, True])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_new_object_has_its_place_in_the_picture_and_a_suitable_size(is_light, projection):
    state = AppState.for_scene(load_scene("still-life"))
    focus, camera = scene_focus(state.scene), state.camera
    if projection == "parallel":
        camera = switched_projection(camera, focus.center)
    middle = float(camera.project(focus.center, (1, 1)).parameter)
    found = place_for(focus, camera, is_light)
    pixel = camera.project(found.at, (1, 1))
    assert (pixel.row, pixel.column) == pytest.approx(
        (-0.35, 0.2) if is_light else (0, 0), abs=1e-9
    )
    t = middle if is_light else 0.6 * middle
    assert pixel.parameter == pytest.approx(t)
    bottom, top = camera.viewport[2:]
    high = 0.3 * (top - bottom) * np.linalg.norm(camera.v) * (1 if camera.is_parallel else t)
    assert found.size == pytest.approx(high)
    wide = replace(camera, viewport=tuple(50 * side for side in camera.viewport))
    diagonal = np.linalg.norm(np.ptp(focus.framed, axis=0))
    assert place_for(focus, wide, is_light).size == pytest.approx(0.16 * diagonal)


def test_a_light_without_a_place_can_be_added(state):
    after = editing.added(state, "directional", scene_focus(state.scene))
    assert after.scene.objects == state.scene.objects
    assert len(after.scene.lights) == len(state.scene.lights) + 1
    assert table_of(after.scene, *chosen(after))["type"] == "directional"
    assert after.scene.lights[-1].color == (0.8, 0.8, 0.8)
