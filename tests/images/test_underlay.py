"""What stands under ImGui's windows: painted where it belongs, in its order."""

import numpy as np
import pytest

from app.images.shown import Picture
from app.images.underlay import Underlay
from app.widgets.surface import Target
from renderer.raster.resources import new_texture

SIZE = (16, 12)
RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def target(gl):
    framebuffer = gl.framebuffer([new_texture(gl, SIZE, 4, "uint8")])
    framebuffer.use()
    framebuffer.clear()
    return Target(framebuffer, SIZE)


def test_a_ground_fills_its_box_and_no_more(gl):
    underlay, drawn = Underlay(), target(gl)
    underlay.fill((2, 1, 7, 4), RED)
    underlay.fill((12, 10, 99, 99), BLUE)  # reaches out of the window
    underlay.fill((-9, -9, 0, 0), BLUE)
    underlay.fill((20, 2, 24, 4), BLUE)
    underlay.paint(drawn)
    expected = np.zeros((SIZE[1], SIZE[0], 3), np.uint8)
    expected[1:4, 2:7] = 255, 0, 0
    expected[10:, 12:] = 0, 0, 255
    np.testing.assert_array_equal(drawn.read(), expected)
    underlay.begin_frame()
    drawn.framebuffer.clear()
    underlay.paint(drawn)
    assert not drawn.read().any()


def picture(gl, pixels):
    """pixels: uint8 (rows, columns, 3), the first row the lowest."""
    rows, columns, _ = pixels.shape
    texture = new_texture(gl, (columns, rows), 4, "uint8")
    texture.write(np.dstack([pixels, np.full((rows, columns), 255, np.uint8)]).tobytes())
    return Picture(texture, gl.framebuffer([texture]))


@pytest.mark.parametrize("factor", [2, 3])
def test_an_enlarged_picture_is_made_of_squares(gl, factor):
    rng = np.random.default_rng(1)
    pixels = rng.integers(0, 256, (3, 4, 3), dtype=np.uint8)
    underlay, drawn = Underlay(), target(gl)
    underlay.put(picture(gl, pixels), (1, 2, 1 + 4 * factor, 2 + 3 * factor))
    underlay.paint(drawn)
    expected = np.zeros((SIZE[1], SIZE[0], 3), np.uint8)
    squares = pixels[::-1].repeat(factor, axis=0).repeat(factor, axis=1)
    expected[2 : 2 + 3 * factor, 1 : 1 + 4 * factor] = squares
    np.testing.assert_array_equal(drawn.read(), expected)
    # Another frame, after which all of the target is drawn to again.
    underlay.begin_frame()
    underlay.fill((0, 0, *SIZE), BLUE)
    underlay.paint(drawn)
    assert (drawn.read() == (0, 0, 255)).all()
    underlay.release()


def test_a_picture_that_reaches_out_of_the_window_is_cut(gl):
    pixels = np.arange(2 * 2 * 3, dtype=np.uint8).reshape(2, 2, 3) * 20
    underlay, drawn = Underlay(), target(gl)
    underlay.put(picture(gl, pixels), (-8, -6, 24, 18))
    underlay.paint(drawn)
    shown = pixels[::-1].repeat(12, axis=0).repeat(16, axis=1)
    np.testing.assert_array_equal(drawn.read(), shown[6:18, 8:24])
    underlay.release()
