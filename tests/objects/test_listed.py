"""The list's lines, and how far it is scrolled."""

from __future__ import annotations

import pytest

from app.objects.choosing import choose, rows_of
from app.objects.listed import Listed, Outliner, lines_of, scroll_to
from app.state.app_state import AppState
from renderer.scene import load_scene
from renderer.scene_editing.outline import ModelPart, OutlineRow

PARTS = tuple(ModelPart(k, f"wheel {k}", 12) for k in range(1, 4))
ROWS = (
    OutlineRow(7, "", "ball", "sphere", False, range(1), 0, False, False),
    OutlineRow(8, "", "car", "model", False, range(1, 4), 36, False, False, parts=PARTS),
    OutlineRow(9, "", "point light 0", "point", True, range(0), 0, False, False),
)


def test_a_model_s_parts_are_lines_where_it_is_opened():
    assert [line.row.item for line in lines_of(ROWS, frozenset())] == [7, 8, 9]
    lines = lines_of(ROWS, frozenset({8, 7}))
    assert [line.row.item for line in lines] == [7, 8, 8, 8, 8, 9]
    assert [line.part for line in lines] == [None, None, *PARTS, None]


@pytest.mark.parametrize(
    ("line", "scrolled", "after"),
    [(0, 0, 0), (4, 0, 0), (5, 0, 20), (30, 0, 520), (2, 100, 40), (7, 100, 100)],
)
def test_a_list_is_scrolled_by_as_little_as_a_line_needs(line, scrolled, after):
    assert scroll_to(line, 20.0, scrolled, 100.0) == after


def test_a_switch_is_for_all_that_is_chosen_where_its_line_is():
    state = AppState.for_scene(load_scene("still-life"))
    first, second, third = (row.item for row in rows_of(state.scene)[:3])
    result = Listed.of(Outliner(), choose(state, (first, second)))
    assert result.meant(first) == (first, second)
    assert result.meant(third) == (third,)
