"""What stands under ImGui's windows: painted where it belongs, in its order."""

import numpy as np

from app.images.underlay import Underlay
from app.widgets.surface import Target

SIZE = (16, 12)
RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def target(gl):
    framebuffer = gl.framebuffer([gl.renderbuffer(SIZE, 4)])
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
