"""The photograph over a picture, on the GPU, against the definition in NumPy."""

import numpy as np
import pytest

from lucida.app.images.photograph.laying import Laying, level
from lucida.app.images.photograph.model import WHOLE
from lucida.app.images.placement import Placement
from lucida.app.images.shown import Picture, whole
from lucida.renderer.raster.resources import Owner, new_texture

SIZE = (13, 7)  # (width, height), odd on purpose
RNG = np.random.default_rng(3)


@pytest.fixture
def laying(gl):
    made = Laying(gl)
    yield made
    made.release()


@pytest.fixture
def upload(gl):
    owner = Owner()

    def upload(values):
        height, width = values.shape[:2]
        texture = owner.own(new_texture(gl, (width, height), values[0, 0].size, values.dtype))
        texture.write(np.ascontiguousarray(values))
        return texture

    yield upload
    owner.release()


def noise(size=SIZE):
    pixels = RNG.integers(0, 256, (size[1], size[0], 4), dtype=np.uint8)
    pixels[..., 3] = 255
    return pixels


def pictured(gl, upload, pixels):
    texture = upload(pixels)
    return Picture(texture, made=object())


def shown(picture):
    width, height = picture.texture.size
    return np.frombuffer(picture.texture.read(), np.uint8).reshape(height, width, 4)


@pytest.mark.parametrize("opacity", [0.25, 0.5, 1.0])
def test_the_mean_is_of_display_values(gl, laying, upload, opacity):
    image, photo = noise(), noise()
    laying.take(photo)
    made = laying.laid("a", pictured(gl, upload, image), whole(SIZE), WHOLE, opacity)
    wanted = (1 - opacity) * image.astype(float) + opacity * photo
    assert np.abs(shown(made)[..., :3] - wanted[..., :3]).max() <= 0.51
    if opacity == 1.0:
        assert np.array_equal(shown(made), photo)


def test_what_is_transparent_shows_the_image(gl, laying, upload):
    image, photo = noise(), noise()
    clear = RNG.random(SIZE[::-1]) < 0.5
    photo[clear] = 0
    laying.take(photo)
    made = laying.laid("a", pictured(gl, upload, image), whole(SIZE), WHOLE)
    assert np.array_equal(shown(made), np.where(clear[..., None], image, photo))


def test_it_covers_its_part_of_the_image(gl, laying, upload):
    image, photo = noise((12, 8)), noise((6, 4))
    laying.take(photo)
    part = (0.25, 0.25, 0.75, 0.75)
    made = laying.laid("a", pictured(gl, upload, image), whole((12, 8)), part)
    wanted = image.copy()
    wanted[2:6, 3:9] = photo
    assert np.abs(shown(made).astype(int) - wanted).max() <= 1


def test_of_a_magnified_image_what_is_seen_is_laid(gl, laying, upload):
    """Twice as large, moved to the left and upwards."""
    photo = noise()
    laying.take(photo)
    placement = Placement(SIZE, (9, 6), 2.0, (-4, -2), (26, 14))
    made = laying.laid("a", pictured(gl, upload, noise((9, 6))), placement, WHOLE)
    assert np.array_equal(shown(made), photo.repeat(2, 0).repeat(2, 1)[2:8, 4:13])


def test_it_is_drawn_again_where_something_has_changed(gl, laying, upload):
    laying.take(noise())
    picture = pictured(gl, upload, noise())

    def laid(opacity=0.5):
        return laying.laid("a", picture, whole(SIZE), WHOLE, opacity)

    before, drawn = shown(laid()), laid().made
    assert laid().made is drawn  # which is another one each time
    assert laid(0.25).made is not drawn
    drawn = laid().made
    laying.take(noise())  # another photograph
    assert laid().made is not drawn and not np.array_equal(shown(laid()), before)
    laying.take(None)
    assert laid() is picture


def test_where_it_is_seen_smaller_the_mean_is_seen(gl, laying, upload):
    photo = np.zeros((16, 16, 4), np.uint8)
    photo[::2, ::2] = 255
    photo[..., 3] = 255
    laying.take(photo)
    placement = Placement((16, 16), (4, 4), 0.25, (0, 0), (4, 4))
    assert level((16, 16), placement, (4, 4), WHOLE) == pytest.approx(2.0)
    made = laying.laid("a", pictured(gl, upload, noise((4, 4))), placement, WHOLE)
    assert np.abs(shown(made)[..., :3].astype(int) - 64).max() <= 2
