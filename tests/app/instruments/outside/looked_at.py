"""Cameras to look at from outside, and cameras that look."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError

SIZE = (64, 48)
LOOKING = Camera.look_at((4.0, 3.0, 6.0), (0.0, 0.0, -1.0), fov_y_deg=40.0, aspect=4 / 3)

numbers = st.floats(-2, 2, allow_nan=False)
vectors = st.tuples(numbers, numbers, numbers)


@st.composite
def cameras(draw: st.DrawFn) -> Camera:
    """Skewed, scaled, left-handed, off-axis ones too; none that is nearly singular."""
    left, bottom = draw(numbers), draw(numbers)
    try:
        camera = Camera(
            eye=draw(vectors),
            u=draw(vectors),
            v=draw(vectors),
            w=draw(vectors),
            distance=draw(st.floats(0.1, 5)),
            viewport=(
                left,
                left + draw(st.floats(0.1, 3)),
                bottom,
                bottom + draw(st.floats(0.1, 3)),
            ),
            projection=draw(st.sampled_from(["perspective", "parallel"])),
        )
    except LucidaError:
        assume(False)
        raise
    lengths = np.linalg.norm(camera.basis, axis=0)
    assume(lengths.min() > 0.1 and abs(camera.determinant) > 0.05 * lengths.prod())
    return camera


def looking_cameras() -> list[Camera]:
    parallel = replace(LOOKING, projection="parallel", viewport=(-5, 5, -4, 4))
    skewed = replace(LOOKING, u=(1.0, 0.3, -0.5), w=(0.5, 0.4, 0.9))
    mirrored = replace(LOOKING, u=tuple(-np.asarray(LOOKING.u)))
    return [LOOKING, parallel, skewed, mirrored]
