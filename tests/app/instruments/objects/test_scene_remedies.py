"""Edits of the scene that help against a black image."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import crowd

from lucida import Tracer
from lucida.app.instruments.objects.choosing import rows_of
from lucida.app.instruments.objects.editing import with_scene
from lucida.app.instruments.objects.remedies import ADD_LIGHT, SHOW_ALL, remedied, scene_remedy
from lucida.app.state.app_state import AppState
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import set_field, set_scene_field
from lucida.renderer.files import load_scene


def dark(lights_behind: bool) -> AppState:
    """Return a scene without light, or with one behind all that is visible."""
    state = AppState.for_scene(load_scene("still-life"))
    lights = [row.item for row in rows_of(state.scene) if row.is_light]
    scene = set_scene_field(objects.delete(state.scene, lights), "ambient", [0, 0, 0])
    scene = set_scene_field(scene, "background", [0, 0, 0])
    if lights_behind:
        table = objects.new_table(scene, "directional")
        scene, added = objects.add(scene, table)
        scene = set_field(scene, added, "direction", list(state.camera.w))
    return with_scene(state, scene)


@pytest.mark.parametrize("behind", [False, True])
def test_a_light_makes_it_bright(behind):
    state = dark(behind)
    size = (48, 32)

    def brightest(now: AppState) -> float:
        tracer = Tracer(now.scene)
        return float(np.max(tracer.render(now.view.for_size(size), size).color))

    assert scene_remedy(state, "light") == ADD_LIGHT
    after = remedied(state, ADD_LIGHT)
    assert brightest(after) > brightest(state) + 0.2
    assert after.view == state.view


def test_what_is_hidden_is_shown():
    state = AppState.for_scene(load_scene("still-life"))
    items = [row.item for row in rows_of(state.scene)]
    hidden = with_scene(state, objects.hide(state.scene, items, True))
    assert scene_remedy(hidden, "empty") == SHOW_ALL
    after = remedied(hidden, SHOW_ALL)
    assert {row.hidden for row in rows_of(after.scene) if not row.is_light} == {False}
    assert {row.hidden for row in rows_of(after.scene) if row.is_light} == {True}


def test_nothing_is_offered_that_cannot_be():
    state = AppState.for_scene(load_scene("still-life"))
    assert scene_remedy(state, "empty") == ""  # nothing is hidden
    assert scene_remedy(state, "exposure") == ""
    assert scene_remedy(replace(state, scene=crowd()), "light") == ""
