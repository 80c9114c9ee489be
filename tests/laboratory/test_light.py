"""The light that a pixel stands for, against arithmetic by hand."""

from __future__ import annotations

import numpy as np

from app.laboratory import light
from renderer.images import to_srgb8


class TestLight:
    def test_aligned_projectors_give_the_picture(self, color):
        whole = light.projected(color, light.triangle(0))
        np.testing.assert_array_equal(whole, to_srgb8(color))

    def test_the_wall_is_as_large_as_all_pictures_together(self):
        """Moved up and to the left too: as when all are moved one way and back."""
        white = np.ones((4, 6, 3), np.float32)
        wall = light.projected(white, ((-1, 0), (0, -2), (2, 3)))
        assert wall.shape == (4 + 3, 6 + 5, 3)
        for channel, (top, left) in enumerate(((0, 2), (1, 0), (3, 5))):
            lit = np.zeros((7, 11), bool)
            lit[top : top + 4, left : left + 6] = True
            assert (wall[..., channel] == 255 * lit).all()

    def test_the_triangle_of_projectors(self):
        assert light.triangle(10) == ((-10, 0), (5, -9), (5, 9))

    def test_magnified_pixels(self):
        picture = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
        large = light.magnified(picture, 4)
        assert large.shape == (8, 8, 3)
        np.testing.assert_array_equal(large[::4, ::4], picture)
        np.testing.assert_array_equal(large[3::4, 3::4], picture)

    def test_windows_stay_inside(self):
        image = np.arange(35).reshape(5, 7)
        assert light.window(image, 0, 0, 3, 3)[:2] == (0, 0)
        first, left, part = light.window(image, 4, 6, 3, 3)
        assert (first, left) == (2, 4)
        np.testing.assert_array_equal(part, image[2:5, 4:7])
        assert light.window(image, 2, 3, 50, 50)[2].shape == (5, 7)
        assert light.window(image, 4, 6, 5, 7)[:2] == (0, 0)
        assert light.window(image, 2, 3, 4, 4)[:2] == (0, 1)

    def test_the_test_picture_of_bars(self):
        """Each is two of 16 columns wide; the last quarter of the rows is a ramp."""
        picture = light.bars(9, 16)
        names = ["white", "yellow", "cyan", "green", "magenta", "red", "blue", "black"]
        colors = {"white": (1, 1, 1), "yellow": (1, 1, 0), "cyan": (0, 1, 1), "green": (0, 1, 0)}
        colors |= {"magenta": (1, 0, 1), "red": (1, 0, 0), "blue": (0, 0, 1), "black": (0, 0, 0)}
        wanted = [colors[name] for name in names for _ in range(2)]
        assert picture.shape == (9, 16, 3)
        assert picture[:7].tolist() == [list(map(list, wanted))] * 7
        np.testing.assert_allclose(picture[7:], np.ones((2, 16, 3)) * (np.mgrid[:16] / 15)[:, None])

    def test_the_test_picture_of_a_disc(self):
        """Its radius is 2.5 about the middle: a pixel is white if its centre is inside."""
        rows = ["...##...", "..####..", "..####..", "..####..", "...##..."]
        wanted = np.array([[letter == "#" for letter in row] for row in rows], float)
        for picture in (light.disc(5, 8), light.disc(8, 5).swapaxes(0, 1)):
            assert picture.tolist() == np.stack([wanted] * 3, axis=-1).tolist()
