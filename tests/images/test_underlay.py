"""The underlay of ImGui's windows: painted where it belongs, in its order."""

import numpy as np
import pytest

from app.images.placement import Placement
from app.images.shown import Picture, ShownImage
from app.images.underlay import Underlay
from app.widgets.surface import Target
from renderer.raster.display import Look
from renderer.raster.resources import new_surface, new_texture

SIZE = (16, 12)
RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def target(gl):
    framebuffer = gl.framebuffer([new_surface(gl, SIZE)])
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
    texture = new_surface(gl, (columns, rows))
    texture.write(np.dstack([pixels, np.full((rows, columns), 255, np.uint8)]).tobytes())
    return Picture(texture, gl.framebuffer([texture]), made=None)


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


# As ImGui draws pictures: multiplied by a colour that varies over the rectangle.
AS_IMGUI = (
    """#version 330 core
uniform float full;
out vec2 place;
out vec4 tint;
void main() {
    place = vec2(ivec2(0x16, 0x34) >> gl_VertexID & 1);
    tint = vec4(full);
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
""",
    """#version 330 core
uniform sampler2D picture;
in vec2 place;
in vec4 tint;
out vec4 color;
void main() {
    color = tint * texture(picture, place);
}
""",
)


@pytest.mark.parametrize("own_size", [False, True])
def test_pictures_for_imgui_come_out_right_on_the_windows_surface(gl, own_size):
    size = (192, 160)
    placement = Placement(size, size, 1.0, (0, 0), size)
    values = np.random.default_rng(2).random((size[1], size[0], 3), dtype=np.float32)
    source = new_texture(gl, size, 3, np.float32)
    source.write(values.tobytes())
    shown = ShownImage(gl)
    shown.set_channels({"color": source})
    shown.picture("pane", Look(), placement, under=True)  # in the underlay, the frame before
    picture = shown.picture("pane", Look(), placement, own_size=own_size)
    target = gl.framebuffer([new_surface(gl, size)])
    vertex, fragment = AS_IMGUI
    program = gl.program(vertex_shader=vertex, fragment_shader=fragment)
    program["full"] = 1.0
    target.use()
    picture.texture.use(0)
    gl.vertex_array(program, []).render(vertices=6)
    drawn, expected = (
        np.frombuffer(each.read(), np.uint8) for each in (target, picture.framebuffer)
    )
    np.testing.assert_array_equal(drawn, expected)
    assert expected.std() > 50
    shown.release()
