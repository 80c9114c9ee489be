"""Rows and columns are counted from 0 or from 1, as the user says; whoever shows them says so."""

from __future__ import annotations

import json
import re

import pytest

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


class TestCompare:
    def compare(self, capsys, backend, *options):
        line = ["compare", "spheres", "--size", "32x18", "--backend", backend]
        main([*line, *options])
        return capsys.readouterr().out

    def test_the_text_and_json_say_from_where(self, capsys, gl_backend):
        zero, one = (
            json.loads(self.compare(capsys, gl_backend, "--json", f"--from={k}")) for k in (0, 1)
        )
        assert (zero["pixels_from"], one["pixels_from"]) == (0, 1)
        assert one["worst"] == [part + 1 for part in zero["worst"]]
        for first, more in ((0, ()), (1, ("--from", "1"))):
            text = self.compare(capsys, gl_backend, *more)
            found = re.search(r"at row (\d+), column (\d+) \(from (\d)\)", text)
            assert [int(part) for part in found.groups()] == [
                part + first for part in (*zero["worst"], 0)
            ]

    @pytest.mark.parametrize("text", ["2", "-1", "one", ""])
    def test_nothing_else_is_taken(self, capsys, text):
        assert main(["compare", "spheres", f"--from={text}"]) == 2
        assert "is not 0 or 1" in capsys.readouterr().err
