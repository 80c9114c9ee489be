"""Photographs from files: upright, at the requested size, or refused in one line."""

import numpy as np
import pytest
from PIL import Image

from lucida.app.images.photograph import reading
from lucida.app.images.photograph.reading import (
    ORIENTATION,
    decoded,
    found_photograph,
    is_photograph,
)
from lucida.renderer.system.errors import LucidaError, describe

WHOLE = (1000, 1000)
PIXELS = np.random.default_rng(2).integers(0, 256, (6, 8, 3), dtype=np.uint8)


def saved(tmp_path, pixels, name="photo.png", **keywords):
    path = tmp_path / name
    Image.fromarray(pixels).save(path, **keywords)
    return path


def test_pixels_are_the_file_s(tmp_path):
    photograph = decoded(saved(tmp_path, PIXELS), WHOLE)
    assert photograph.size == (8, 6)
    assert np.array_equal(photograph.pixels[..., :3], PIXELS)
    assert (photograph.pixels[..., 3] == 255).all()


@pytest.mark.parametrize("name", ["a.JPG", "b.jpeg", "c.PNG", "d.webp", "e.tif", "f.tiff"])
def test_each_format_is_known_and_read(tmp_path, name):
    path = saved(tmp_path, np.full((4, 4, 3), 90, np.uint8), name)
    assert is_photograph(str(path))
    assert found_photograph(str(path)) == str(path)
    assert np.abs(decoded(path, WHOLE).pixels[..., :3].astype(int) - 90).max() <= 3


@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_photograph_stands_upright_in_every_orientation(tmp_path, orientation):
    """Compare with the EXIF specification's places of the file's row 0 and column 0."""
    exif = Image.Exif()
    exif[ORIENTATION] = orientation
    upright = {
        1: PIXELS,
        2: PIXELS[:, ::-1],
        3: PIXELS[::-1, ::-1],
        4: PIXELS[::-1],
        5: PIXELS.transpose(1, 0, 2),
        6: PIXELS[::-1].transpose(1, 0, 2),
        7: PIXELS[::-1, ::-1].transpose(1, 0, 2),
        8: PIXELS[:, ::-1].transpose(1, 0, 2),
    }[orientation]
    path = saved(tmp_path, PIXELS, exif=exif)
    photograph = decoded(path, WHOLE)
    assert photograph.size == upright.shape[1::-1]
    assert np.array_equal(photograph.pixels[..., :3], upright)
    half = (photograph.size[0] // 2, photograph.size[1])  # of the upright photograph
    assert decoded(path, half).pixels.shape[1::-1] == half


def test_a_reduced_photograph_has_the_mean_of_the_pixels_that_each_covers(tmp_path):
    pixels = np.zeros((4, 4, 3), np.uint8)
    pixels[:2, :2] = ((0, 40, 80), (100, 140, 180)), ((0, 40, 80), (100, 140, 180))
    photograph = decoded(saved(tmp_path, pixels), (2, 3))
    assert photograph.pixels.shape == (3, 2, 4) and photograph.size == (4, 4)
    photograph = decoded(saved(tmp_path, pixels), (2, 2))
    assert photograph.pixels[0, 0].tolist() == [50, 90, 130, 255]
    assert photograph.pixels[1, 1].tolist() == [0, 0, 0, 255]


def test_a_large_jpeg_is_not_decoded_in_full(tmp_path, monkeypatch):
    monkeypatch.setattr(reading, "LARGEST_PIXELS", 64 * 64)
    pixels = np.full((512, 512, 3), 128, np.uint8)
    assert decoded(saved(tmp_path, pixels, "a.jpg"), (64, 64)).size == (512, 512)
    with pytest.raises(LucidaError, match="has more than"):
        decoded(saved(tmp_path, pixels, "a.png"), (64, 64))


def test_transparency_is_kept(tmp_path):
    pixels = np.zeros((1, 3, 4), np.uint8)
    pixels[0] = (200, 100, 50, 0), (200, 100, 50, 128), (200, 100, 50, 255)
    photograph = decoded(saved(tmp_path, pixels), WHOLE)
    assert photograph.pixels[0].tolist() == pixels[0].tolist()
    pixels[0, 0] = 0
    keyed = saved(tmp_path, pixels[..., :3], transparency=(0, 0, 0))
    assert decoded(keyed, (1, 1)).pixels[0, 0, 3] == 170  # two of three pixels


def test_gray_palettes_and_16_bits_are_read(tmp_path):
    gray = np.array([[0, 0x1234, 0xFFFF]], np.uint16)
    assert decoded(saved(tmp_path, gray), WHOLE).pixels[0, :, 0].tolist() == [0, 0x12, 255]
    gray = np.array([[0, 100, 255]], np.uint8)
    assert decoded(saved(tmp_path, gray), WHOLE).pixels[0, :, 1].tolist() == [0, 100, 255]
    path = tmp_path / "palette.png"
    Image.fromarray(np.full((2, 2, 3), (10, 20, 30), np.uint8)).quantize(4).save(path)
    assert decoded(path, WHOLE).pixels[0, 0].tolist() == [10, 20, 30, 255]


def test_an_unreadable_file_is_refused_in_one_line(tmp_path):
    good = saved(tmp_path, PIXELS).read_bytes()
    cases = {"cut.png": good[:-30], "text.jpg": b"no", "empty.tif": b"", "short.webp": b"RIFF"}
    for name, data in cases.items():
        (tmp_path / name).write_bytes(data)
    cases |= {"gone.png": b"", "folder.png": b""}
    (tmp_path / "folder.png").mkdir()
    saved(tmp_path, np.zeros((2, 2), np.float32), "numbers.tif")
    for name in (*cases, "numbers.tif"):
        with pytest.raises(LucidaError) as caught:
            found_photograph(str(tmp_path / name))
        message = describe(caught.value)
        assert name in message and "\n" not in message, message


def test_a_name_with_a_null_is_refused():
    with pytest.raises(LucidaError, match="cannot be read"):
        found_photograph("a\0b.png")
