"""The fuzz of random views: that it finds faults, and makes each again; and a few of its views."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from renderer.scene.flat import flatten
from tests.attack import random_views
from tests.attack.random_views import VIEWS_OF_A_SCENE, Task, main, scene_of, view_of


def test_some_views_agree(capsys):
    assert main(["--views", "40"]) == 0
    assert "40 views" in capsys.readouterr().out


def test_a_view_is_made_again_from_its_number():
    task, number = Task(3, 0, 1), 5 * VIEWS_OF_A_SCENE + 7
    first, second = (flatten(scene_of(task, number)) for _ in range(2))
    np.testing.assert_array_equal(first.vertices, second.vertices)
    np.testing.assert_array_equal(first.spheres, second.spheres)
    assert view_of(task, number, first) == view_of(task, number, second)
    assert view_of(task, number, first) != view_of(task, number + 1, first)
    far = flatten(scene_of(Task(3, 0, 1, offset=1e4), number))
    assert np.abs(far.bounds).max() > 5e3


@pytest.mark.parametrize("fault", ["pixels", "crash"])
def test_a_fault_costs_a_line_and_the_exit_status(fault, monkeypatch, capsys):
    right = random_views.compared

    def wrong(flat, rasterizer, tracer, camera, size):
        if fault == "crash":
            raise RuntimeError("it broke")
        return replace(right(flat, rasterizer, tracer, camera, size), unexplained=3)

    monkeypatch.setattr(random_views, "compared", wrong)
    assert main(["--views", "2", "--first", "12", "--seed", "5"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(",")[:2] for line in lines[:2]] == [
        ["seed 5", f" view {number}"] for number in (12, 13)
    ]
    assert ("it broke" if fault == "crash" else "3 of ") in lines[0]
    assert "2 views fail" in lines[2]


@pytest.mark.parametrize(
    ("seed", "number", "offset"),
    [
        (20261122, 449, 0.0),  # a flattened object's thin cells: t of packets in float32
        (20261122, 9015, 0.0),
        (5, 436, 1e6),
        (20261122, 251, 0.0),  # a triangle whose volume is hundreds of times smaller than its terms
        (20261122, 7779, 0.0),  # such cells from the rasterizer's points
        (20261122, 4223, 0.0),  # and from a sliver's weights
        (20261122, 8915, 0.0),  # the place along a sliver that a light is close to
        (31415, 4902, 0.0),  # which of two slivers is nearer
        (8675309, 3675, 0.0),
        (99991, 3207, 0.0),  # the place of an edge from before the eye to behind it
        (20261122, 5907, 0.0),  # a vast triangle through the plane of a parallel view's eye
        (161803, 1139, 0.0),  # a vast triangle of which clipping leaves nothing
    ],
)
def test_views_that_were_wrong_once(seed, number, offset):
    total = random_views.run(Task(seed, number, number + 1, offset))
    assert not total.lines and total.seeing == 1
