"""Rows and columns are counted from 0 or from 1, as the user says; whoever shows them says so."""

from __future__ import annotations

import json

from lucida.app.cli import main
from lucida.app.images.pair.actions import COUNTING
from lucida.app.state.options import Options
from lucida.app.window.action_table import ACTIONS
from lucida.renderer.camera.pixels import Indexing

PIXEL = (0, 11)


def test_pixels_are_counted_as_chosen():
    lecture, array = Indexing.LECTURE, Indexing.ARRAY
    assert (lecture.text(PIXEL), array.text(PIXEL)) == ("(1, 12)", "(0, 11)")
    assert (lecture.short(PIXEL), array.short(PIXEL)) == ("1,12", "0,11")
    assert lecture.words(PIXEL) == "row 1, column 12"
    assert (lecture.told, array.told) == ("from 1", "from 0")
    assert (lecture.offset, array.offset) == ("- 0.5", "+ 0.5")
    for indexing in Indexing:
        assert indexing.pixel(*indexing.numbers(PIXEL)) == PIXEL


def test_the_window_has_one_setting_for_all():
    assert Options().indexing is Indexing.LECTURE
    assert Options(one_based=False).indexing is Indexing.ARRAY
    assert [action.name for action in ACTIONS if action.menu == COUNTING] == [
        "Pixels from 1 (lecture)",
        "Pixels from 0 (arrays)",
    ]


def test_compare_says_from_where_it_counts(capsys, gl_backend):
    line = ["compare", "spheres", "--size", "32x18", "--backend", gl_backend]
    main([*line, "--json"])
    row, column = json.loads(capsys.readouterr().out)["worst"]
    main(line)
    assert f"at row {row}, column {column} (from 0), " in capsys.readouterr().out
