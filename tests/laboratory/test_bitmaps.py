"""Dithered and quantized images, against plain loops."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.laboratory import bitmaps, kinds
from app.laboratory.stored import store
from renderer.frame import Frame
from renderer.images import gray_picture
from renderer.images.display import from_srgb


def plain_floyd_steinberg(gray: np.ndarray) -> np.ndarray:
    """The textbook's loop, which hands each pixel's error on."""
    values = np.clip(gray.astype(float), 0, 1).tolist()
    height, width = gray.shape
    shares = [[[0.0] * 4 for _ in range(width)] for _ in range(height)]
    bits = np.zeros(gray.shape, bool)
    for i in range(height):
        for j in range(width):
            value = values[i][j]
            for share in shares[i][j]:  # from above left, above, above right, left
                value += share
            bits[i, j] = value >= 0.5
            error = value - bits[i, j]
            for di, dj, part, slot in ((0, 1, 7, 3), (1, -1, 3, 2), (1, 0, 5, 1), (1, 1, 1, 0)):
                if i + di < height and 0 <= j + dj < width:
                    shares[i + di][j + dj][slot] = error * (part / 16)
    return bits


class TestBitmaps:
    @given(
        st.integers(1, 19),
        st.integers(1, 19),
        st.integers(0, 2**32 - 1),
        st.sampled_from([0.5, 1.0, 2.0]),
    )
    def test_error_diffusion_is_the_plain_loop_bit_by_bit(self, height, width, seed, power):
        gray = np.random.default_rng(seed).uniform(0, 1, (height, width)) ** power
        np.testing.assert_array_equal(bitmaps.floyd_steinberg(gray), plain_floyd_steinberg(gray))

    @pytest.mark.parametrize("method", ["ordered", "floyd-steinberg"])
    @pytest.mark.parametrize("value", [0.0, 0.1, 0.25, 0.5, 0.8, 1.0])
    def test_dithers_keep_the_mean_light(self, method, value):
        bits = bitmaps.METHODS[method](np.full((64, 64), value))
        assert bits.mean() == pytest.approx(value, abs=0.01)

    def test_where_a_value_is_exactly_a_threshold(self):
        darkest, dark = from_srgb(np.array([128, 127], np.uint8))
        assert bitmaps.threshold([[darkest, dark]]).tolist() == [[True, False]]
        assert bitmaps.threshold([[0.5, 0.49]], 0.5).tolist() == [[True, False]]
        assert not bitmaps.ordered(np.full((8, 8), 0.5 / 64)).any()
        assert bitmaps.ordered(np.full((8, 8), 0.51 / 64)).sum() == 1
        assert bitmaps.floyd_steinberg([[0.5]]).tolist() == [[True]]

    def test_what_is_brighter_than_white_spreads_no_light(self):
        assert bitmaps.floyd_steinberg([[9.0, 0.4]]).tolist() == [[True, False]]
        assert bitmaps.floyd_steinberg([[-9.0, 0.6]]).tolist() == [[False, True]]

    @pytest.mark.parametrize("shape", [(0, 5), (5, 0), (0, 0)])
    @pytest.mark.parametrize("method", bitmaps.METHODS)
    def test_an_image_without_pixels_has_no_bits(self, method, shape):
        bits = bitmaps.METHODS[method](np.zeros(shape))
        assert (bits.shape, bits.dtype) == (shape, np.bool_)

    def test_bayers_matrix(self):
        assert not bitmaps.BAYER_8.flags.writeable
        np.testing.assert_array_equal(bitmaps.bayer(1), [[0, 2], [3, 1]])
        np.testing.assert_array_equal(
            bitmaps.bayer(2), [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]
        )
        assert sorted(bitmaps.BAYER_8.ravel()) == list(range(64))

    def test_ordered_dither_is_a_threshold_that_depends_on_the_place(self):
        gray = np.random.default_rng(2).uniform(0, 1, (19, 13))
        plain = [
            [gray[i, j] > (bitmaps.BAYER_8[i % 8, j % 8] + 0.5) / 64 for j in range(13)]
            for i in range(19)
        ]
        np.testing.assert_array_equal(bitmaps.ordered(gray), plain)

    def test_the_threshold_is_the_pbm_writers(self, color):
        written = gray_picture(Frame((37, 23), color)) >= 128
        np.testing.assert_array_equal(store(color, kinds.BITMAP).array, written)

    def test_nothing_is_lost_or_made_of_nan(self):
        gray = np.array([[np.nan, 1.0], [0.0, 2.0]])
        assert bitmaps.floyd_steinberg(gray).tolist() == [[False, True], [False, True]]
