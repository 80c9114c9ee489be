"""Three beams of the lecture form a closed triangle in one image, and none in another."""

from __future__ import annotations

import numpy as np
from both_lectures import both_lectures
from numpy.typing import NDArray

from lucida import Rasterizer, Tracer

SIZE = (160, 160)
BUILDS = [b for b in both_lectures().builds if b.title == "What parallel projection does"]
ENDS = ((-0.5, 0.0, 0.0), (6.0, 6.0, 6.5))  # of the first beam and of the last one


def parts(inside: NDArray[np.bool_]) -> int:
    """Return the number of connected parts of a picture, by flooding one after another."""
    left, count = inside.copy(), 0
    while left.any():
        stack, count = [tuple(np.argwhere(left)[0].tolist())], count + 1
        while stack:
            i, j = stack.pop()
            if 0 <= i < left.shape[0] and 0 <= j < left.shape[1] and left[i, j]:
                left[i, j] = False
                stack += [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
    return count


def test_the_ends_meet_in_the_image_of_both_renderers_and_not_in_the_world(gl_backend: str) -> None:
    assert np.linalg.norm(np.subtract(*ENDS)) > 9
    closed, turned = BUILDS[-2:]
    with Rasterizer(closed.scene, backend=gl_backend) as raster, Tracer(closed.scene) as tracer:
        for build, holes in ((closed, 1), (turned, 0)):
            camera = build.view.for_size(SIZE)
            for renderer in (raster, tracer):
                seen = renderer.render(camera, SIZE, channels=("id",)).id >= 0
                assert parts(seen) == 1 and parts(~seen) == 1 + holes
