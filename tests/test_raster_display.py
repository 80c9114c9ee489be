"""The display transform on the GPU, against the one on the CPU."""

import gc

import numpy as np
import pytest

from renderer.camera import Camera
from renderer.images import to_srgb8
from renderer.raster import Display
from renderer.raster.display import MOST_PICTURES
from renderer.scene.model import Scene, SceneObject, Sphere


@pytest.fixture
def gl(rasterizer):
    with rasterizer.current() as context:
        yield context


@pytest.fixture
def display(gl):
    display = Display(gl)
    yield display
    display.release()


def shown(texture):
    width, height = texture.size
    return np.frombuffer(texture.read(), np.uint8).reshape(height, width, 4)


@pytest.mark.parametrize("exposure_ev", [0.0, 1.5, -3.0])
def test_agrees_with_numpy(display, exposure_ev):
    levels = np.concatenate(
        [[0, 1e-6, 0.0031308, 0.5, 1, 1.0001, 7, 1e4], np.linspace(0, 1.2, 400)]
    )
    color = (
        np.stack([levels, levels[::-1], levels**2], axis=-1).astype(np.float32).reshape(8, 51, 3)
    )
    picture = shown(display.draw(display.upload(color), exposure_ev))
    difference = picture[..., :3].astype(int) - to_srgb8(color, exposure_ev)
    assert np.abs(difference).max() <= 1  # where a float's last place decides the rounding
    assert (difference != 0).mean() < 0.01
    assert (picture[..., 3] == 255).all()


def test_extreme_exposures_do_no_harm(display):
    color = np.full((1, 1, 3), 0.5, np.float32)
    assert shown(display.draw(display.upload(color), 5000.0))[0, 0].tolist() == [255] * 4
    assert shown(display.draw(display.upload(color), -5000.0))[0, 0].tolist() == [0, 0, 0, 255]


def test_rows_stay_where_they_are(rasterizer, gl, display):
    rasterizer.set_scene(Scene((SceneObject(Sphere((0, 0.4, -1), 0.1)),), ambient=(1, 1, 1)))
    picture = shown(display.draw(rasterizer.draw(Camera(), (9, 9)).color))
    assert picture[0, 4, 0] > 100
    assert picture[8, 4, 0] == 0


def test_two_pictures_at_once(display, gl):
    one = gl.texture((2, 2), 3, np.zeros((2, 2, 3), np.float32), dtype="f4")
    two = gl.texture((2, 2), 3, np.ones((2, 2, 3), np.float32), dtype="f4")
    black, white = display.draw(one), display.draw(two)
    assert shown(black)[0, 0, 0] == 0
    assert shown(white)[0, 0, 0] == 255
    assert display.draw(one) is black
    one.release()
    two.release()


def test_sizes_change_and_nothing_is_left(display, gl):
    gl.gc_mode = "context_gc"
    for k in range(30):
        picture = display.draw(display.upload(np.ones((k + 1, 31 - k, 3), np.float32)))
        assert picture.size == (31 - k, k + 1)
        assert shown(picture).min() == 255
    sources = [gl.texture((3, 3), 3, dtype="f4") for _ in range(3 * MOST_PICTURES)]
    for source in sources:
        display.draw(source)
        source.release()
    gc.collect()
    left = [name for thing in gl.objects if (name := type(thing).__name__) != "InvalidObject"]
    gl.gc_mode = None
    assert left == []
    assert len(display._pictures) <= MOST_PICTURES
