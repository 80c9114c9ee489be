"""The rays of several pixels, and what they hit, by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.probe import bundles
from app.probe.bundles import bundle, column_of, grid, row_of
from app.probe.model import Probe
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene.model import Scene, SceneObject, Sphere

CAMERA = Camera()  # 3 x 1 pixels: the middle one looks along -z
SIZE = (3, 1)
BALLS = Scene(
    tuple(SceneObject(Sphere((0, 0, z), 1)) for z in (-9, -5)),
)


def test_rows_columns_and_nets_of_pixels():
    assert row_of(3, (4, 9)).tolist() == [[3, 0], [3, 1], [3, 2], [3, 3]]
    assert column_of(2, (4, 3)).tolist() == [[0, 2], [1, 2], [2, 2]]
    assert grid([1, 5], [2, 3]).tolist() == [[1, 2], [1, 3], [5, 2], [5, 3]]


def test_what_several_rays_hit():
    found = bundle(Probe(BALLS), row_of(0, SIZE), CAMERA, SIZE)
    assert found.pixels.tolist() == [[0, 0], [0, 1], [0, 2]]
    assert found.origins.tolist() == [[0, 0, 0]] * 3
    np.testing.assert_allclose(found.directions, [[-1 / 3, 0, -1], [0, 0, -1], [1 / 3, 0, -1]])
    assert found.t == pytest.approx([math.inf, 4, math.inf])
    assert found.primitive.tolist() == [-1, 1, -1]
    one = bundle(Probe(BALLS), np.array([0, 1]), CAMERA, SIZE)
    assert (one.pixels.tolist(), one.primitive.tolist()) == ([[0, 1]], [1])


def test_clip_planes_hold_for_bundles():
    clipped = Camera(near=5.0)
    found = bundle(Probe(Scene(BALLS.objects[1:])), row_of(0, SIZE), clipped, SIZE)
    assert found.t[1] == pytest.approx(6), "the ball's far side"
    assert found.primitive[1] == 0


def test_so_many_rays_are_followed_one_by_one_and_no_more(monkeypatch):
    monkeypatch.setattr(bundles, "MOST_RAYS", 3)
    assert len(bundle(Probe(BALLS), row_of(0, SIZE), CAMERA, SIZE).t) == 3
    with pytest.raises(LucidaError, match="4 are too many to follow one by one; stay within 3"):
        bundle(Probe(BALLS), row_of(0, (4, 1)), CAMERA, (4, 1))


def test_a_tracer_finds_the_hits_of_the_same_rays_within_the_clip_planes():
    class Tracer:
        def closest_hits(self, *given) -> tuple:
            self.given = given
            return np.array([1, 2, 3], np.float32), np.array([4, 5, -1], np.int32)

    tracer, camera = Tracer(), Camera(near=0.5, far=20.0)
    found = bundle(Probe(BALLS), row_of(0, SIZE), camera, SIZE, tracer)
    assert found.t.tolist() == [1, 2, 3]
    assert found.primitive.tolist() == [4, 5, -1]
    origins, directions, *t_range = tracer.given
    assert origins is found.origins and directions is found.directions
    assert tuple(t_range) == camera.t_range
