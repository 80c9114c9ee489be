"""Several samples a pixel, as both renderers take them."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.frame import Frame
from lucida.renderer.images.samples import check_samples, offsets, supersampled
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, Scene, SceneObject
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer

SIZE = (12, 9)
CAMERA = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=30, aspect=4 / 3)


class Recorder:
    """Draws images whose colour is the camera's shift, in pixels."""

    def __init__(self):
        self.asked: list[tuple[str, ...]] = []

    def __call__(self, camera, size, channels, progress):
        self.asked.append(channels)
        left, right, bottom, top = camera.viewport
        columns = (left - CAMERA.viewport[0]) / (right - left) * size[0]
        rows = (CAMERA.viewport[3] - top) / (top - bottom) * size[1]
        color = np.full((size[1], size[0], 3), (rows, columns, 1), np.float32)
        depth = np.full((size[1], size[0]), len(self.asked), np.float32)
        if progress is not None:
            progress(0.5)
            progress(1.0)
        has_color, has_depth = "color" in channels, "depth" in channels
        return Frame(size, color if has_color else None, depth if has_depth else None, time_s=1)


@pytest.mark.parametrize("samples", [0, -1, 2, 3, 8, 65, 81, 100, 4.0, "4", None, True])
def test_only_squares_up_to_64(samples):
    if samples is True:
        assert check_samples(samples) == 1
        return
    with pytest.raises(LucidaError, match=r"samples: .* is not a square from 1 to 64; give 1, 4"):
        check_samples(samples)


@pytest.mark.parametrize("k", range(1, 9))
def test_the_grid_is_regular_and_centred(k):
    places = np.array(offsets(check_samples(np.int64(k * k)))).reshape(k, k, 2)
    want = (np.arange(k) + 0.5) / k - 0.5
    np.testing.assert_allclose(places[..., 0], np.broadcast_to(want[:, None], (k, k)), atol=1e-15)
    np.testing.assert_allclose(places[..., 1], np.broadcast_to(want, (k, k)), atol=1e-15)
    assert ((0.0, 0.0) in offsets(k * k)) == (k % 2 == 1)


@pytest.mark.parametrize("samples", [1, 4, 9, 16])
def test_the_colour_is_the_mean_and_the_rest_the_centres(samples):
    draw, seen = Recorder(), []
    frame = supersampled(draw, CAMERA, SIZE, ("color", "depth"), samples, seen.append)
    np.testing.assert_allclose(
        frame.color, np.broadcast_to([0, 0, 1], frame.color.shape), atol=1e-6
    )
    assert (frame.depth == 1).all()
    assert draw.asked.count(("depth",)) == (samples in (4, 16))
    assert sum("color" in channels for channels in draw.asked) == samples
    assert frame.time_s == len(draw.asked)
    assert seen == sorted(seen)
    assert seen[-1] == 1


def test_without_colour_one_image_is_enough():
    draw = Recorder()
    frame = supersampled(draw, CAMERA, SIZE, ("depth",), 64)
    assert draw.asked == [("depth",)]
    assert frame.color is None


def test_a_half_covered_pixel_is_half_bright():
    vertices = np.array([[-5, -5, 0], [0.125, -5, 0], [0.125, 5, 0], [-5, 5, 0]])
    quad = Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]))
    scene = Scene((SceneObject(quad, Material((1, 1, 1))),), ambient=(1, 1, 1))
    camera = Camera((0, 0, 1), viewport=(-1, 1, -0.5, 0.5), projection="parallel")
    with Tracer(scene) as tracer:
        one = tracer.render(camera, (8, 4))
        many = tracer.render(camera, (8, 4), samples=16)
    assert (many.color[0, :, 0] == [1, 1, 1, 1, 0.5, 0, 0, 0]).all()
    assert np.array_equal(many.depth, one.depth)
    assert np.array_equal(many.id, one.id)
