"""Images as files and numbers keep them, against arithmetic by hand."""

from __future__ import annotations

import numpy as np
import pytest

from app.laboratory import bitmaps, kinds
from app.laboratory.stored import clipped, levels, shown, store
from renderer.images import to_srgb8
from renderer.images.display import luminance
from renderer.scene.reading import size_text


class TestStorage:
    def test_the_lectures_megapixel(self):
        texts = [size_text(kind.storage_bytes(kinds.LECTURE_SIZE)) for kind in kinds.KINDS]
        assert texts == ["128 KiB", "1 MiB", "3 MiB", "6 MiB", "12 MiB"]
        assert [kind.bits for kind in kinds.KINDS] == [1, 8, 24, 48, 96]

    def test_gray_is_the_luminance_encoded(self, color):
        y = 0.2126 * color[..., 0] + 0.7152 * color[..., 1] + 0.0722 * color[..., 2]
        gray = store(color, kinds.GRAY).array.astype(int)
        assert abs(gray - to_srgb8(y).astype(int)).max() <= 1
        assert gray[0, 0] < gray[0, -1] and gray[-1, 0] < gray[0, 0]  # green, red, blue

    @pytest.mark.parametrize("kind", kinds.KINDS, ids=lambda kind: kind.name)
    def test_what_is_stored_has_the_kinds_bits(self, color, kind):
        stored = store(color, kind)
        bits = 1 if stored.array.dtype == bool else 8 * stored.array.dtype.itemsize
        assert bits * stored.array.size == kind.bits * 37 * 23
        assert stored.size == (37, 23)
        assert stored.storage_bytes == kind.storage_bytes((37, 23)) > 0

    def test_half_saturates_instead_of_overflowing(self):
        wild = np.array([[[1e9, np.inf, np.nan], [-1e9, -np.inf, 0.5]]], np.float32)
        assert store(wild, kinds.HALF).array.tolist() == [
            [[65504.0, 65504.0, 0.0], [-65504.0, -65504.0, 0.5]]
        ]

    @pytest.mark.parametrize("method", bitmaps.METHODS)
    def test_bits_of_light_that_no_display_shows(self, method):
        """White beyond 1, black below 0 and where there is no number; and nothing is spread."""
        wild = np.repeat(np.array([[np.inf, np.nan, -np.inf, 0.0, 1e30, -5.0]])[..., None], 3, 2)
        stored = store(wild, kinds.BITMAP, 9.0, method)
        assert stored.array.tolist() == [[True, False, False, False, True, False]]

    def test_bits_of_a_picture_that_was_exposed(self):
        """At two stops, what has a quarter of the threshold's light is white."""
        light = bitmaps.THRESHOLD * np.array([[[0.26] * 3, [0.24] * 3]])
        assert store(light, kinds.BITMAP, 2.0).array.tolist() == [[True, False]]
        assert store(4 * light, kinds.BITMAP).array.tolist() == [[True, False]]
        half = to_srgb8(0.5)
        assert shown(store(4 * light, kinds.BITMAP), -1.0).tolist() == [[[half] * 3, [0] * 3]]
        assert shown(store(4 * light, kinds.BITMAP)).tolist() == [[[255] * 3, [0] * 3]]

    def test_what_is_lost_where_a_channel_is_above_1(self):
        color = [[[1.0, 1.0, 1.0], [0.0, 0.4, 1.01]], [[0.6, 0.0, 0.0], [0.5, 0.5, 0.5]]]
        assert clipped(color).tolist() == [[False, True], [False, False]]
        assert clipped(color, 1.0).tolist() == [[True, True], [True, False]]
        assert clipped([[[0.4, 0.0, 0.0]]], 1.0).tolist() == [[False]]


class TestExposureAfterStorage:
    def test_float_keeps_what_8_bits_lose(self, color):
        bytes_kept = store(color, kinds.COLOR)
        float_kept = store(color, kinds.FLOAT)
        np.testing.assert_array_equal(shown(bytes_kept), shown(float_kept))
        np.testing.assert_array_equal(shown(float_kept, -2.0), to_srgb8(color, -2.0))
        # What was clipped stays one value: 1 darkened by two stops.
        lost = clipped(color)
        assert lost.any() and not lost.all()
        white = shown(bytes_kept, -2.0)[(color > 1).all(axis=2)]
        assert len(white) and (white == to_srgb8(0.25)).all()
        assert levels(shown(float_kept, -2.0)) > levels(shown(bytes_kept, -2.0))

    def test_8_bits_band_when_they_are_brightened(self):
        ramp = np.repeat(np.linspace(0, 0.02, 4096, dtype=np.float32)[None, :, None], 3, axis=2)
        kept = [shown(store(ramp, kind), 5.0) for kind in (kinds.COLOR, kinds.HALF, kinds.FLOAT)]
        of_bytes, of_half, of_float = map(levels, kept)
        assert of_bytes <= 40  # 0.02 is 39 of 255
        assert of_half == of_float > 150

    def test_the_exposure_it_was_taken_at(self, color):
        for kind in kinds.KINDS[1:]:
            taken = shown(store(color, kind, -1.5))
            expected = to_srgb8(
                np.repeat(luminance(color)[..., None], 3, axis=2) if kind is kinds.GRAY else color,
                -1.5,
            )
            assert abs(taken.astype(int) - expected).max() <= 1
        assert not clipped(color, -2.0).any()
