"""The image laboratory's core, against plain loops and arithmetic by hand."""

from __future__ import annotations

import io

import numpy as np
import OpenEXR
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from app.laboratory import bitmaps, disk, kinds, light, memory
from app.laboratory.stored import clipped, levels, shown, store
from renderer.errors import LucidaError
from renderer.frame import Frame
from renderer.images import gray_picture, to_srgb8
from renderer.images.display import from_srgb, luminance
from renderer.scene.reading import size_text


@pytest.fixture
def color() -> np.ndarray:
    """37 x 23 pixels of light, 0 to 3, smooth and rough, with pure colours at the corners."""
    random = np.random.default_rng(4)
    image = np.linspace(0, 3, 37 * 23).reshape(23, 37, 1) * random.uniform(0.3, 1, (23, 37, 3))
    image[0, 0], image[0, -1], image[-1, 0] = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    return image.astype(np.float32)


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

    def test_error_diffusion_of_a_larger_image(self):
        i, j = np.mgrid[0:120, 0:200]
        gray = 0.5 + 0.5 * np.sin(i / 17) * np.cos(j / 23)
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


class TestStorage:
    def test_the_lectures_megapixel(self):
        texts = [size_text(kind.storage_bytes(kinds.LECTURE_SIZE)) for kind in kinds.KINDS]
        assert texts == ["128 KiB", "1 MiB", "3 MiB", "6 MiB", "12 MiB"]
        assert [kind.bits for kind in kinds.KINDS] == [1, 8, 24, 48, 96]

    def test_rows_of_bits_begin_at_a_byte(self):
        assert kinds.BITMAP.storage_bytes((11, 5)) == 2 * 5

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


class TestLight:
    def test_aligned_projectors_give_the_picture(self, color):
        whole = light.projected(color, light.triangle(0))
        np.testing.assert_array_equal(whole, to_srgb8(color))

    def test_light_adds_where_pictures_overlap(self):
        white = np.ones((4, 6, 3), np.float32)
        wall = light.projected(white, ((0, 0), (0, 2), (1, 2)))
        assert wall.shape == (5, 8, 3)
        assert wall[0, 0].tolist() == [255, 0, 0]
        assert wall[0, 3].tolist() == [255, 255, 0]  # red and green: yellow
        assert wall[2, 3].tolist() == [255, 255, 255]
        assert wall[2, 7].tolist() == [0, 255, 255]
        assert wall[4, 3].tolist() == [0, 0, 255]
        assert wall[0, 7].tolist() == [0, 255, 0]
        assert wall[4, 0].tolist() == [0, 0, 0]

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

    def test_subpixels_are_three_stripes(self):
        picture = np.array([[[10, 20, 30], [40, 50, 60]]], np.uint8)
        image = light.subpixels(picture, 6)
        assert image.shape == (6, 12, 3)
        for row in image:
            assert row[:, 0].tolist() == [10, 10, 0, 0, 0, 0, 40, 40, 0, 0, 0, 0]
            assert row[:, 1].tolist() == [0, 0, 20, 20, 0, 0, 0, 0, 50, 50, 0, 0]
            assert row[:, 2].tolist() == [0, 0, 0, 0, 30, 30, 0, 0, 0, 0, 60, 60]
        gapped = light.subpixels(picture, 9, gap=1)
        assert gapped[0, :9, 0].tolist() == [10, 10, 0, 0, 0, 0, 0, 0, 0]
        assert gapped[0, :9, 2].tolist() == [0, 0, 0, 0, 0, 0, 30, 30, 0]
        assert not gapped[8].any()

    @pytest.mark.parametrize("side", [6, 7, 8, 10, 11, 13, 36, 45])
    @pytest.mark.parametrize("gap", [1, 2])
    def test_every_stripe_ends_in_its_gap_whether_3_divides_the_side_or_not(self, side, gap):
        image = light.subpixels(np.full((1, 1, 3), 255, np.uint8), side, gap)
        whole = light.subpixels(np.full((1, 1, 3), 255, np.uint8), side)
        for channel in range(3):
            stripe = np.flatnonzero(whole[0, :, channel])
            lit = np.flatnonzero(image[0, :, channel])
            assert lit.tolist() == stripe[:-gap].tolist()
            assert (image[: side - gap, lit, channel] == 255).all()
        assert not image[side - gap :].any()

    @pytest.mark.parametrize("side", [3, 4, 5, 7, 8])
    def test_every_column_of_a_pixel_shines_in_one_colour(self, side):
        image = light.subpixels(np.full((2, 2, 3), 255, np.uint8), side)
        assert (image.sum(axis=2) == 255).all()

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
        """Of radius 2.5 about the middle: white where the pixel's centre is inside."""
        rows = ["...##...", "..####..", "..####..", "..####..", "...##..."]
        wanted = np.array([[letter == "#" for letter in row] for row in rows], float)
        for picture in (light.disc(5, 8), light.disc(8, 5).swapaxes(0, 1)):
            assert picture.tolist() == np.stack([wanted] * 3, axis=-1).tolist()


class TestMemory:
    @pytest.mark.parametrize("order", ["row", "column"])
    def test_offsets_are_those_of_the_array_in_memory(self, color, order):
        size = color.shape[1], color.shape[0]
        flat = color.tobytes() if order == "row" else color.transpose(1, 0, 2).tobytes()
        for i, j, channel in ((0, 0, 0), (0, 1, 0), (1, 0, 2), (22, 36, 1)):
            offset = memory.offset_bytes(i, j, channel, size, order)
            assert np.frombuffer(flat, np.float32, 1, offset)[0] == color[i, j, channel]
        for number in (0, 1, 23, 37, 37 * 23 - 1):
            pixel = memory.pixel_at(number, size, order)
            assert memory.pixel_number(*pixel, size, order) == number
            assert 0 <= pixel[0] < 23 and 0 <= pixel[1] < 37

    @pytest.mark.parametrize(
        ("one_based", "first"), [(True, "canvas[11, 20]"), (False, "canvas[10, 19]")]
    )
    def test_a_window_of_the_array(self, color, one_based, first):
        table = memory.table(color, 11, 20, 3, 4, one_based)
        assert (table.i, table.j) == (10, 18)
        assert len(table.rows) == 3 and {len(row) for row in table.rows} == {4}
        cell = table.rows[0][1]
        assert cell.label == first
        assert cell.values == tuple(float(x) for x in color[10, 19])
        assert cell.index == 10 * 37 + 19
        assert cell.offset_bytes == (10 * 37 + 19) * 12

    def test_column_after_column(self, color):
        table = memory.table(color, 11, 20, 3, 4, order="column")
        here, beside = table.rows[0][:2]
        assert beside.offset_bytes - here.offset_bytes == 23 * 12
        assert table.rows[1][0].offset_bytes - here.offset_bytes == 12
        assert here.offset_bytes == (18 * 23 + 10) * 12
        assert (here.label, table.one_based) == ("canvas[11, 19]", True)

    def test_pixels_one_after_another_in_memory(self, color):
        row = memory.run(color, 11, 36, 5)
        assert [(cell.i, cell.j) for cell in row] == [
            (11, 34),
            (11, 35),
            (11, 36),
            (12, 0),
            (12, 1),
        ]
        assert row[0].label == "canvas[12, 35]"
        column = memory.run(color, 22, 20, 5, order="column")
        assert [(cell.i, cell.j) for cell in column] == [
            (20, 20), (21, 20), (22, 20), (0, 21), (1, 21)
        ]  # fmt: skip
        for cells in (row, column):
            offsets = [cell.offset_bytes for cell in cells]
            assert np.diff(offsets).tolist() == [12] * 4
        assert [(cell.i, cell.j) for cell in memory.run(color, 0, 0, 2)] == [(0, 0), (0, 1)]
        assert len(memory.run(color, 22, 36, 10_000)) == 37 * 23

    def test_other_arrays(self):
        gray = np.arange(6, dtype=np.uint8).reshape(2, 3)
        table = memory.table(gray, 0, 0, 9, 9, one_based=False)
        assert table.rows[1][2].values == (5.0,)
        assert table.rows[1][2].offset_bytes == 5
        assert [cell.offset_bytes for row in table.rows for cell in row] == [0, 1, 2, 3, 4, 5]

    @pytest.mark.parametrize("order", ["row", "column"])
    @pytest.mark.parametrize("one_based", [True, False])
    def test_the_formula_gives_the_offset(self, order, one_based):
        text = memory.formula((640, 480), order, one_based)
        rule = text.removeprefix("offset = ").removesuffix(" bytes")
        for i, j in ((0, 0), (3, 0), (0, 7), (479, 639)):
            places = {"i": i + one_based, "j": j + one_based}
            assert eval(rule, places) == memory.offset_bytes(i, j, 0, (640, 480), order)
        assert memory.formula((640, 480)) == "offset = ((i - 1) * 640 + (j - 1)) * 12 bytes"


class TestDisk:
    def test_sizes_are_those_of_the_files(self, color, tmp_path):
        entries = disk.sizes(color, method="ordered")
        assert [entry.format for entry in entries] == list(disk.FORMATS)
        for entry in entries:
            path = tmp_path / f"{entry.format.kind.name}{entry.format.ending}"
            written = disk.export(path, color, entry.format.kind, method="ordered")
            assert path.stat().st_size == entry.file_bytes == written
        sizes = {(e.format.kind.name, e.format.ending): e.file_bytes for e in entries}
        header = len(b"P4\n37 23\n")
        assert sizes["bitmap", ".pbm"] == header + 5 * 23
        assert sizes["gray", ".pgm"] == len(b"P5\n37 23\n255\n") + 37 * 23
        assert sizes["color", ".ppm"] == len(b"P6\n37 23\n255\n") + 3 * 37 * 23
        assert sizes["float", ".pfm"] == len(b"PF\n37 23\n-1.0\n") + 12 * 37 * 23

    def test_files_hold_what_is_stored(self, color):
        for format in disk.FORMATS:
            kept = store(color, format.kind, method="floyd-steinberg").array
            content = io.BytesIO(disk.encoded(kept, format))
            if format.ending == ".pfm":
                values = np.frombuffer(content.getvalue()[-12 * 37 * 23 :], "<f4")
                np.testing.assert_array_equal(values.reshape(kept.shape)[::-1], kept)
            elif format.ending == ".exr":
                with OpenEXR.File(content) as file:
                    pixels = file.channels()["RGB"].pixels
                assert pixels.dtype == kept.dtype
                np.testing.assert_array_equal(pixels, kept)
            else:
                np.testing.assert_array_equal(np.asarray(Image.open(content)), kept)

    def test_a_format_that_cannot_hold_the_kind(self, color, tmp_path):
        with pytest.raises(LucidaError, match=r"\.ppm cannot hold"):
            disk.export(tmp_path / "x.ppm", color, kinds.FLOAT)
        with pytest.raises(LucidaError, match="cannot hold bool"):
            disk.encoded(store(color, kinds.BITMAP).array, disk.FORMATS[4])
        assert not list(tmp_path.iterdir())

    def test_cancelling(self, color):
        assert disk.sizes(color, cancelled=lambda: True) == ()
