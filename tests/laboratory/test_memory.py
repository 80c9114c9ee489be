"""Images in memory, against plain loops."""

from __future__ import annotations

import numpy as np
import pytest

from app.laboratory import memory


class TestMemory:
    @pytest.mark.parametrize("order", ["row", "column"])
    def test_offsets_are_those_of_the_array_in_memory(self, color, order):
        size = color.shape[1], color.shape[0]
        flat = color.tobytes() if order == "row" else color.transpose(1, 0, 2).tobytes()
        for i, j, channel in ((0, 0, 0), (0, 1, 0), (1, 0, 2), (22, 36, 1)):
            offset = memory.offset_bytes(i, j, channel, size, order)
            assert np.frombuffer(flat, np.float32, 1, offset)[0] == color[i, j, channel]
        for number in (0, 1, 23, 37, 37 * 23 - 1):
            pixel = memory.pixel_at(number, size, order)
            assert memory.pixel_number(*pixel, size, order) == number
            assert 0 <= pixel[0] < 23 and 0 <= pixel[1] < 37

    @pytest.mark.parametrize(
        ("one_based", "first"), [(True, "canvas[11, 20]"), (False, "canvas[10, 19]")]
    )
    def test_a_window_of_the_array(self, color, one_based, first):
        table = memory.table(color, 11, 20, 3, 4, one_based)
        assert (table.i, table.j) == (10, 18)
        assert len(table.rows) == 3 and {len(row) for row in table.rows} == {4}
        cell = table.rows[0][1]
        assert cell.label == first
        assert cell.values == tuple(float(x) for x in color[10, 19])
        assert cell.index == 10 * 37 + 19
        assert cell.offset_bytes == (10 * 37 + 19) * 12

    def test_column_after_column(self, color):
        table = memory.table(color, 11, 20, 3, 4, order="column")
        here, beside = table.rows[0][:2]
        assert beside.offset_bytes - here.offset_bytes == 23 * 12
        assert table.rows[1][0].offset_bytes - here.offset_bytes == 12
        assert here.offset_bytes == (18 * 23 + 10) * 12
        assert (here.label, table.one_based) == ("canvas[11, 19]", True)

    def test_pixels_one_after_another_in_memory(self, color):
        row = memory.run(color, 11, 36, 5)
        assert [(cell.i, cell.j) for cell in row] == [
            (11, 34),
            (11, 35),
            (11, 36),
            (12, 0),
            (12, 1),
        ]
        assert row[0].label == "canvas[12, 35]"
        column = memory.run(color, 22, 20, 5, order="column")
        assert [(cell.i, cell.j) for cell in column] == [
            (20, 20), (21, 20), (22, 20), (0, 21), (1, 21)
        ]  # fmt: skip
        for cells in (row, column):
            offsets = [cell.offset_bytes for cell in cells]
            assert np.diff(offsets).tolist() == [12] * 4
        assert [(cell.i, cell.j) for cell in memory.run(color, 0, 0, 2)] == [(0, 0), (0, 1)]
        assert len(memory.run(color, 22, 36, 10_000)) == 37 * 23

    def test_other_arrays(self):
        gray = np.arange(6, dtype=np.uint8).reshape(2, 3)
        table = memory.table(gray, 0, 0, 9, 9, one_based=False)
        assert table.rows[1][2].values == (5.0,)
        assert table.rows[1][2].offset_bytes == 5
        assert [cell.offset_bytes for row in table.rows for cell in row] == [0, 1, 2, 3, 4, 5]

    @pytest.mark.parametrize("order", ["row", "column"])
    @pytest.mark.parametrize("one_based", [True, False])
    def test_the_formula_gives_the_offset(self, order, one_based):
        text = memory.formula((640, 480), order, one_based)
        rule = text.removeprefix("offset = ").removesuffix(" bytes")
        for i, j in ((0, 0), (3, 0), (0, 7), (479, 639)):
            places = {"i": i + one_based, "j": j + one_based}
            assert eval(rule, places) == memory.offset_bytes(i, j, 0, (640, 480), order)
        assert memory.formula((640, 480)) == "offset = ((i - 1) * 640 + (j - 1)) * 12 bytes"
