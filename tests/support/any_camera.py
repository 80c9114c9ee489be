"""Hypothesis's strategies for legal cameras."""

from __future__ import annotations

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import volume

numbers = st.floats(-3, 3)
vectors = st.tuples(numbers, numbers, numbers)


@st.composite
def cameras(draw: st.DrawFn, volume_least: float = 0.02) -> Camera:
    """Draw a camera: skewed, scaled, left-handed, off-axis, with clip planes or without."""
    basis = np.array([draw(vectors) for _ in range(3)])
    lengths = np.linalg.norm(basis, axis=1)
    assume((lengths > 0.1).all())
    assume(abs(volume(*(basis / lengths[:, None]))) > volume_least)
    left, bottom = draw(numbers), draw(numbers)
    return Camera(
        draw(vectors),
        *(tuple(row) for row in basis.tolist()),
        draw(st.floats(0.1, 5)),
        (left, left + draw(st.floats(0.05, 4)), bottom, bottom + draw(st.floats(0.05, 4))),
        draw(st.sampled_from(("perspective", "parallel"))),
        draw(st.none() | st.floats(0.05, 3)),  # over 1e-6 of any depth
        draw(st.none() | st.floats(3.5, 50)),
    )
