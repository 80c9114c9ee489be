"""The rays of a row or a column of pixels, and what they hit, by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.probe import bundles
from app.probe.bundles import bundle
from app.probe.model import Probe
from renderer.camera import Camera
from renderer.scene.model import Scene, SceneObject, Sphere

BALLS = Probe(Scene(tuple(SceneObject(Sphere((0, 0, z), 1)) for z in (-9, -5))))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize(("which", "place"), [("row", 5), ("column", 7)])
def test_rays_are_those_of_the_pixels(projection, which, place, monkeypatch):
    """By row and column: 9 x 17 pixels, of which every second is shown."""
    monkeypatch.setattr(bundles, "MOST_SHOWN", 5 if which == "row" else 9)
    camera = Camera(viewport=(-0.3, 0.5, -0.2, 0.4), projection=projection)
    found = bundle(BALLS, which, place, camera, (9, 17))
    rays = camera.rays((9, 17))
    at = np.s_[place, ::2] if which == "row" else np.s_[::2, place]
    np.testing.assert_array_equal(found.origins, rays.origin[at])
    np.testing.assert_array_equal(found.directions, rays.direction[at])


def test_the_closest_hit_within_the_clip_planes():
    """Look along -z with the middle one of 3 x 1 pixels."""
    assert bundle(BALLS, "row", 0, Camera(), (3, 1)).t == pytest.approx([math.inf, 4, math.inf])
    clipped = bundle(BALLS, "row", 0, Camera(near=5.0), (3, 1))
    assert clipped.t[1] == pytest.approx(6), "the nearer ball's far side"
    assert len(bundle(BALLS, "column", 0, Camera(), (1, 1000)).t) == 48
