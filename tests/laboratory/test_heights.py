"""The image as a height field."""

from __future__ import annotations

import numpy as np

from app.laboratory.heights import DEEP, TALL, height_field


def test_it_is_as_high_as_the_image_is_bright():
    """The front row: a dark, a gray and a white third."""
    color = np.repeat(np.array([0.0, 0.5, 1.0], np.float32), 20)[None, :, None]
    color = np.broadcast_to(color + 0.001, (30, 60, 3))
    picture = height_field(color, (300, 200), 0.0)
    front = (200 - int(TALL * 200) - int(DEEP * 200)) // 2 + int(TALL * 200) + int(DEEP * 200) - 1
    seen = [int((picture[:, column].sum(axis=1) > 0).sum()) for column in (120, 200)]
    tops = [int(np.flatnonzero(picture[:, column].sum(axis=1))[0]) for column in (20, 120, 200)]
    assert tops[0] > tops[1] > tops[2]
    assert seen[0] < seen[1]
    assert not picture[front + 1 :].any()
    assert height_field(color, (8, 8), 0.0).shape == (8, 8, 3)
