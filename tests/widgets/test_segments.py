"""Lines that are given to ImGui in one go."""

from __future__ import annotations

import numpy as np

from app.widgets.segments import ribbons

OPAQUE = 0xFF3366CC


def test_a_line_is_as_wide_as_it_is_asked_to_be_with_soft_edges():
    lines = np.array([[[10, 20], [30, 20]], [[5, 5], [5, 9]], [[0, 0], [3, 4]]], float)
    for (start, end), made in zip(lines, ribbons(lines, OPAQUE, 3.0), strict=True):
        across = np.array([start[1] - end[1], end[0] - start[0]]) / np.linalg.norm(end - start)
        for place, four in ((start, made[:4]), (end, made[4:])):
            off = four["position"] - place
            assert np.allclose(off @ across, [-2.0, -1.0, 1.0, 2.0], atol=1e-5)
            assert np.allclose(off @ (end - start), 0, atol=1e-4)
            # Half of its edge is outside, half inside: it covers what a sharp one would.
            opaque = four["color"] == OPAQUE
            assert opaque.tolist() == [False, True, True, False]
            assert (four["color"][~opaque] == OPAQUE & 0xFFFFFF).all()


def test_a_point_and_nothing_are_no_trouble():
    assert np.isfinite(ribbons([[[1, 1], [1, 1]]], OPAQUE, 2.0)["position"]).all()
    assert ribbons(np.zeros((0, 2, 2)), OPAQUE, 2.0).shape == (0, 8)
