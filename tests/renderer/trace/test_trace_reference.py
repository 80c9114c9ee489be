"""Random scenes seen by random cameras: every channel against the float64 reference."""

import numpy as np
import pytest
from trace_reference import cast, closest, kernel_rays, random_camera, random_scene, shaded, tree_of

from lucida.renderer.scene.flat import flatten
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.arguments.view import KernelView

ALL = ("color", "depth", "normal", "id", "primitive")
SIZE = (37, 29)


@pytest.mark.parametrize("seed", range(12))
def test_images_match_the_reference(seed):
    random = np.random.default_rng(seed)
    scene, camera = random_scene(random), random_camera(random, near_far=seed % 3 == 0)
    flat = flatten(scene)
    rays = camera.rays(SIZE)
    hits = closest(flat, *(part.reshape(-1, 3) for part in rays), camera.t_range)
    color, normal = shaded(scene, flat, camera, SIZE, hits)
    with Tracer(scene, threads=2, method="reference") as tracer:
        frame = tracer.render(camera, SIZE, ALL)

    sure = ~hits.doubtful.reshape(SIZE[::-1])
    assert sure.mean() > 0.99
    assert (frame.primitive == hits.primitive.reshape(sure.shape))[sure].all()
    owner = np.concatenate([flat.face_object, flat.sphere_object, [-1]])
    assert (frame.id == owner[hits.primitive].reshape(sure.shape))[sure].all()
    np.testing.assert_allclose(frame.depth[sure], hits.t.reshape(sure.shape)[sure], rtol=1e-6)
    np.testing.assert_allclose(frame.normal[sure], normal[sure], atol=1e-5)
    # A checker's border, or a normal that just faces the viewer, may fall either way.
    wrong = (np.abs(frame.color - color) > 1e-4).any(axis=-1) & sure
    assert wrong.sum() <= 1
    assert np.isfinite(frame.color).all()


def test_rays_are_the_cameras_to_the_last_bit():
    random = np.random.default_rng(5)
    for _ in range(10):
        camera = random_camera(random)
        want = camera.rays(SIZE)
        origin, direction = kernel_rays(KernelView.of(camera), *SIZE)
        assert np.array_equal(origin, want.origin)
        assert np.array_equal(direction, want.direction)


def test_hits_lie_within_the_range_that_counts():
    random = np.random.default_rng(6)
    flat = flatten(random_scene(random))
    origins, directions = random.normal(size=(2, 4000, 3)) * 3
    for t_range in ((0.0, np.inf), (0.2, 1.5)):
        t, primitive, _, _ = cast(tree_of(flat), origins, directions, *t_range)
        hit = primitive >= 0
        assert 0.1 < hit.mean() < 0.9
        assert ((t > t_range[0]) & (t < t_range[1]))[hit].all()
        assert np.isinf(t[~hit]).all()
