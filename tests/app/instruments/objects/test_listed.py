"""The list: how far it is scrolled, and what a checkbox in it is for."""

from __future__ import annotations

import pytest

from lucida.app.instruments.objects.choosing import choose, rows_of
from lucida.app.instruments.objects.listed import Listed, Outliner, scroll_to
from lucida.app.state.app_state import AppState
from lucida.renderer.files import load_scene


@pytest.mark.parametrize(
    ("line", "scrolled", "after"),
    [(0, 0, 0), (4, 0, 0), (5, 0, 20), (30, 0, 520), (2, 100, 40), (7, 100, 100)],
)
def test_a_list_is_scrolled_by_as_little_as_a_line_needs(line, scrolled, after):
    assert scroll_to(line, 20.0, scrolled, 100.0) == after


def test_a_checkbox_is_for_the_selection_if_its_row_is_in_it():
    state = AppState.for_scene(load_scene("still-life"))
    first, second, third = (row.item for row in rows_of(state.scene)[:3])
    result = Listed(Outliner(), choose(state, (first, second)))
    assert result.acted_on(first) == (first, second)
    assert result.acted_on(third) == (third,)
