"""Images in memory, against NumPy's own order of an array's bytes."""

from __future__ import annotations

import numpy as np
import pytest

from app.laboratory import memory


@pytest.mark.parametrize("order", ["row", "column"])
@pytest.mark.parametrize("one_based", [True, False])
def test_offsets_labels_and_the_formula(color, order, one_based):
    flat = color.tobytes() if order == "row" else color.transpose(1, 0, 2).tobytes()
    rule = memory.place(order, one_based, 37, 23)
    for i, j in ((0, 0), (0, 1), (1, 0), (11, 20), (22, 36)):
        cell = memory.cell(color, i, j, one_based, order)
        values = np.frombuffer(flat, np.float32, 3, cell.offset_bytes)
        assert cell.values == tuple(values.tolist()) == tuple(color[i, j].tolist())
        assert cell.label == f"canvas[{i + one_based}, {j + one_based}]"
        assert 12 * eval(rule, {"i": i + one_based, "j": j + one_based}) == cell.offset_bytes
    assert memory.place("row", True) == "((i - 1) * W + (j - 1))"


def test_a_window_of_the_array(color):
    rows = memory.table(color, 11, 20, 3, 4, True, "row")
    assert [[(cell.i, cell.j) for cell in row] for row in rows] == [
        [(i, j) for j in range(18, 22)] for i in range(10, 13)
    ]
    assert rows[0][1] == memory.cell(color, 10, 19, True, "row")
    assert len(memory.table(color, 0, 0, 99, 99, True, "row")) == 23


def test_pixels_one_after_another_in_memory(color):
    def run(*arguments):
        return memory.run(color, *arguments)

    row, column = run(11, 36, 5, True, "row"), run(22, 20, 5, False, "column")
    assert [(c.i, c.j) for c in row] == [(11, 34), (11, 35), (11, 36), (12, 0), (12, 1)]
    assert [(c.i, c.j) for c in column] == [(20, 20), (21, 20), (22, 20), (0, 21), (1, 21)]
    assert (row[0].label, column[0].label) == ("canvas[12, 35]", "canvas[20, 20]")
    for cells in (row, column):
        assert np.diff([cell.offset_bytes for cell in cells]).tolist() == [12] * 4
    assert [(c.i, c.j) for c in run(0, 0, 2, True, "row")] == [(0, 0), (0, 1)]
    assert len(run(22, 36, 10_000, True, "row")) == 37 * 23
