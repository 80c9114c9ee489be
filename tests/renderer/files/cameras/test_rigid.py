"""The part of a camera that a rotation and a position can hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from format_cameras import straight_camera

from lucida.renderer.files.cameras.rigid import rigid


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_rigid_camera_has_the_same_rays(projection):
    random = np.random.default_rng(1)
    for _ in range(300):
        camera = replace(straight_camera(random, projection), near=0.5, far=7.0)
        found = rigid(camera, "it")
        assert np.allclose(found.basis.T @ found.basis, np.eye(3), atol=1e-12)
        assert found.determinant > 0
        one, other = camera.rays((5, 4)), found.rays((5, 4))
        assert np.allclose(one.origin, other.origin, atol=1e-12)
        unit = 1.0 if projection == "perspective" else np.linalg.norm(camera.w)
        assert np.allclose(one.direction, other.direction * unit, atol=1e-12)
        # The clip planes are the same planes.
        ends = np.multiply(camera.t_range, unit)
        assert np.allclose(ends, found.t_range, rtol=1e-12)
