"""Random views: twenty of them, and those that were wrong once."""

import pytest

from tools.attack import random_views
from tools.attack.random_views import Task, main


def test_the_attack_s_first_views_agree(capsys):
    assert main(["--views", "20"]) == 0
    assert "20 views" in capsys.readouterr().out


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
